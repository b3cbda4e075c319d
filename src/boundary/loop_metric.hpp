// SPDX-License-Identifier: BSD-3-Clause
// Measures one loop of the boundary in units of the local element size: the coordinate t along the loop is the integral
// of ds/h.
#pragma once

#include "boundary/boundary_sizes.hpp"

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <optional>
#include <vector>

namespace trime::boundary {

/// Properties of the curve between two points of a loop, compared with the straight chord between them.
struct PartSummary {
  double turn = 0;          ///< [radians] signed turn between the ends, without the turns at junctions that are ends
  double half_turn_t = 0;   ///< coordinate t at which half of the total unsigned turn is reached
  double sharpest_turn = 0; ///< largest unsigned turn of a junction strictly between the ends
  LocalIndex sharpest = -1; ///< index of the piece that starts at the sharpest junction
  double deviation =
      0; ///< largest distance to the line through the ends, over piece ends and arc points strictly between
  bool leaves_disc =
      false; ///< whether a piece end or arc point strictly between lies outside the diametral circle of the chord
};

/// A place on a loop: the arc length from the start of one of its pieces.
struct LoopPlace {
  LocalIndex piece;
  double along;
};

class LoopMetric {
public:
  /// Measures one loop of the boundary with all threads, and keeps a reference to it.
  /// @throws GeometryError if the size is so small that it needs more than 2^27 samples
  LoopMetric(const geometry::Boundary& boundary, std::size_t loop, const BoundarySizes& sizes);

  /// Returns the sizes at t, by linear interpolation between places that are half a size apart. t may be up to one
  /// round of the loop too small or too large.
  SizePair sizes(double t) const;
  double size(double t) const { return sizes(t).size; }
  /// Returns the length of the whole loop in units of t. In the functions below, coordinates are taken modulo this
  /// length, and points are shifted by the loop's winding.
  double total() const { return knots_.back().t; }
  /// Returns the coordinate t of the start of piece i.
  double piece_t(std::size_t i) const { return piece_t_[i]; }
  /// Returns the signed turn at the start of piece i in radians.
  double turn(std::size_t i) const { return turn_[i]; }
  /// Returns the first piece that starts at t or later, or the number of pieces if there is no such piece.
  /// @pre 0 <= t < total()
  LocalIndex first_junction_from(double t) const;
  const geometry::Loop& loop() const { return loop_; }
  geometry::Vec2 point(double t) const;
  /// Returns the piece and the arc length of point(t). The start of a piece belongs to this piece.
  /// @pre 0 <= t < total()
  LoopPlace place(double t) const;
  /// Returns the arc length between t0 <= t1 <= t0 + total().
  double arc_length(double t0, double t1) const { return arc(t1) - arc(t0); }
  /// Returns the first t between t0 and t1 (in either direction) at which the distance from `center` reaches `radius`.
  /// @pre the point at t0 is nearer to `center` than `radius`
  std::optional<double> first_at_radius(double t0, double t1, geometry::Vec2 center, double radius) const;
  /// Counts the junctions strictly between t0 < t1 <= t0 + total() that turn by more than `turn` radians, or where two
  /// parts of the shape meet.
  LocalIndex corners_between(double t0, double t1, double turn) const;
  /// Length and turn of a part of the loop that lies on one piece.
  struct OnePiece {
    double length = 0;
    double turn = 0; ///< [radians] not negative
  };
  /// Returns length and turn between 0 <= t0 < t1 <= t0 + total() if both lie on one piece; otherwise nothing.
  std::optional<OnePiece> on_one_piece(double t0, double t1) const;
  /// Returns whether all of the loop between t0 and t1 lies on one piece. Faster than on_one_piece.
  bool is_on_one_piece(double t0, double t1) const { return piece_of_way(t0, t1) >= 0; }
  /// Returns the properties of the curve between t0 < t1 <= t0 + total(), whose ends became the sites a and b.
  PartSummary summarize(double t0, double t1, geometry::Vec2 a, geometry::Vec2 b) const;

private:
  struct Knot {
    double t;
    double arc; // arc length from the start of the loop
    LocalIndex piece;
    double s; // arc length from the start of the piece
    SizePair sizes;
  };
  struct Turn {
    double t;
    geometry::Vec2 position;
    double amount;       // signed turn in radians
    LocalIndex junction; // index of the piece that starts there; -1 at a point of an arc
  };
  template <class Visit>
  void for_each_turn(double t0, double t1, const Visit& visit) const;
  /// The knots of some consecutive pieces, except those at their starts; t and arc are counted from the start of each
  /// piece.
  struct Run {
    std::vector<Knot> knots;
    std::vector<std::size_t> ends; // index behind the last knot of each piece
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
  std::vector<Knot> knots_;                 // ascending in t; the last knot closes the loop
  std::vector<LocalIndex> first_in_bucket_; // divides the range of t into many equal intervals: the first knot in or
                                            // after each interval, and the end
  double buckets_per_t_ = 0;
  std::vector<double> piece_t_; // t of the start of each piece, and of the end of the loop
  std::vector<double> turn_;    // signed turn at the start of each piece, radians
};

} // namespace trime::boundary
