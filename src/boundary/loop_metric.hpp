// SPDX-License-Identifier: BSD-3-Clause
// Measures one loop of the boundary in local element sizes: the coordinate t along it is the integral of ds/h.
#pragma once

#include "boundary/boundary_sizes.hpp"

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <optional>
#include <vector>

namespace trime::boundary {

/// The part of the loop between two of its points.
struct PartSummary {
  double turn = 0;          ///< [radians] net turn between the ends, without junctions at the ends
  double half_turn_t = 0;   ///< where half of the total (unsigned) turn is reached
  double sharpest_turn = 0; ///< largest unsigned turn of a junction strictly between
  LocalIndex sharpest = -1; ///< index of the piece that starts at that junction
  double deviation = 0;     ///< largest distance of a piece end or arc point strictly between from the chord's line
  bool leaves_disc = false; ///< a piece end or arc point strictly between lies outside the chord's diametral disc
};

/// A place on a loop, as arc length from the start of one of its pieces.
struct LoopPlace {
  LocalIndex piece;
  double along;
};

class LoopMetric {
public:
  /// Measures one loop of the boundary with all threads, and keeps a reference to it. @throws GeometryError if the size
  /// asks for more than 2^27 samples
  LoopMetric(const geometry::Boundary& boundary, std::size_t loop, const BoundarySizes& sizes);

  /// Returns the sizes at t, by linear interpolation between places half a size apart. t may be up to one turn ahead or
  /// behind.
  SizePair sizes(double t) const;
  double size(double t) const { return sizes(t).size; }
  /// Returns the length of the whole loop in t. Coordinates below are taken modulo it, and points are shifted by the
  /// winding.
  double total() const { return knots_.back().t; }
  /// Returns t of the start of piece i.
  double piece_t(std::size_t i) const { return piece_t_[i]; }
  /// Returns the signed turn at the start of piece i in radians.
  double turn(std::size_t i) const { return turn_[i]; }
  /// Returns the first piece that starts at t or behind it, or the number of pieces if no piece does. @pre 0 <= t <
  /// total()
  LocalIndex first_junction_from(double t) const;
  const geometry::Loop& loop() const { return loop_; }
  geometry::Vec2 point(double t) const;
  /// Returns the place of point(t). The start of a piece belongs to that piece. @pre 0 <= t < total()
  LoopPlace place(double t) const;
  /// Returns the arc length between t0 <= t1 <= t0 + total().
  double arc_length(double t0, double t1) const { return arc(t1) - arc(t0); }
  /// Returns the first t on the way from t0 to t1 (in either direction) at which the distance from `center` reaches
  /// `radius`.
  /// @pre the point at t0 is nearer than `radius`
  std::optional<double> first_at_radius(double t0, double t1, geometry::Vec2 center, double radius) const;
  /// Counts the junctions strictly between t0 < t1 <= t0 + total() that turn by more than `turn` radians, or where
  /// parts of the shape meet.
  LocalIndex corners_between(double t0, double t1, double turn) const;
  /// A way within one piece, without a junction strictly between its ends.
  struct OnePiece {
    double length = 0;
    double turn = 0; ///< [radians] not negative
  };
  /// Returns the way between 0 <= t0 < t1 <= t0 + total() if one piece holds all of it.
  std::optional<OnePiece> on_one_piece(double t0, double t1) const;
  /// Returns whether one piece holds the whole way. Faster than on_one_piece.
  bool is_on_one_piece(double t0, double t1) const { return piece_of_way(t0, t1) >= 0; }
  /// Summarizes the curve between t0 < t1 <= t0 + total(), whose ends became the sites a and b.
  PartSummary summarize(double t0, double t1, geometry::Vec2 a, geometry::Vec2 b) const;

private:
  struct Knot {
    double t;
    double arc; // arc length from the start of the loop
    LocalIndex piece;
    double s; // arc length in the piece
    SizePair sizes;
  };
  struct Turn {
    double t;
    geometry::Vec2 position;
    double amount;       // signed turn in radians
    LocalIndex junction; // index of the piece that starts there; -1 for a part of an arc
  };
  template <class Visit>
  void for_each_turn(double t0, double t1, const Visit& visit) const;
  /// The knots of some pieces behind their starts, with t and arc counted from the start of each piece.
  struct Run {
    std::vector<Knot> knots;
    std::vector<std::size_t> ends; // end of the knots of each piece
  };
  class Walk;
  SizePair add_piece(LocalIndex i, SizePair sizes, Walk& walk, std::vector<Knot>& knots) const;
  void join(const std::vector<Run>& runs, SizePair at_start);
  void sort_into_buckets();
  std::size_t bucket_of(double t) const;
  double arc(double t) const;
  LocalIndex piece_of_way(double t0, double t1) const;
  LocalIndex knot_before(double t) const;

  const geometry::Loop& loop_;
  geometry::Periods periods_;
  std::vector<Knot> knots_;                 // ascending in t; the last closes the loop
  std::vector<LocalIndex> first_in_bucket_; // first knot in or behind each of many equal intervals of t, and the end
  double buckets_per_t_ = 0;
  std::vector<double> piece_t_; // t of the start of each piece, and of the end
  std::vector<double> turn_;    // signed turn at the start of each piece, radians
};

} // namespace trime::boundary
