// SPDX-License-Identifier: BSD-3-Clause
// One loop of the boundary measured in local element sizes: the coordinate t along it is the integral of ds/h.
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
  double turn = 0;          ///< net turn between the ends, radians, junctions at the ends not counted
  double half_turn_t = 0;   ///< where half of the total (unsigned) turn is reached
  double sharpest_turn = 0; ///< largest unsigned turn of a junction strictly between
  LocalIndex sharpest = -1; ///< that junction: index of the piece that starts there
  double deviation = 0;     ///< largest distance of a piece end or arc point strictly between from the chord's line
  bool leaves_disc = false; ///< a piece end or arc point strictly between lies outside the chord's diametral disc
};

/// A place on a loop: arc length from the start of one of its pieces.
struct LoopPlace {
  LocalIndex piece;
  double along;
};

class LoopMetric {
public:
  /// Measures one loop of the boundary with all threads, and keeps a reference to it. @throws GeometryError if the size
  /// asks for more than 2^27 samples
  LoopMetric(const geometry::Boundary& boundary, std::size_t loop, const BoundarySizes& sizes);

  /// The sizes at t, linear between places half a size apart; t up to one turn ahead or behind.
  SizePair sizes(double t) const;
  double size(double t) const { return sizes(t).size; }
  /// Length of the whole loop in t; coordinates below are taken modulo it, points move on by the winding.
  double total() const { return knots_.back().t; }
  /// t of the start of piece i.
  double piece_t(std::size_t i) const { return piece_t_[i]; }
  /// Signed turn at the start of piece i, radians.
  double turn(std::size_t i) const { return turn_[i]; }
  /// The first piece that starts at t or behind it, 0 <= t < total(); the number of pieces if none does.
  LocalIndex first_junction_from(double t) const;
  const geometry::Loop& loop() const { return loop_; }
  geometry::Vec2 point(double t) const;
  /// Where point(t) lies; the start of a piece belongs to that piece. @pre 0 <= t < total()
  LoopPlace place(double t) const;
  /// Arc length between t0 <= t1 <= t0 + total().
  double arc_length(double t0, double t1) const { return arc(t1) - arc(t0); }
  /// The first t on the way from t0 to t1 (either direction) at which the distance from `center` reaches `radius`.
  /// @pre the point at t0 is nearer than `radius`
  std::optional<double> first_at_radius(double t0, double t1, geometry::Vec2 center, double radius) const;
  /// Junctions strictly between t0 < t1 <= t0 + total() that turn by more than `turn` radians, or where
  /// parts of the shape meet.
  LocalIndex corners_between(double t0, double t1, double turn) const;
  /// A way that lies within one piece: no junction strictly between.
  struct OnePiece {
    double length = 0;
    double turn = 0; ///< radians, not negative
  };
  /// The way between 0 <= t0 < t1 <= t0 + total() if one piece holds all of it.
  std::optional<OnePiece> on_one_piece(double t0, double t1) const;
  /// Does one piece hold all of it? Faster.
  bool is_on_one_piece(double t0, double t1) const { return piece_of_way(t0, t1) >= 0; }
  /// The curve between t0 < t1 <= t0 + total(), whose ends became the sites a and b.
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
    double amount;       // signed, radians
    LocalIndex junction; // index of the piece that starts there; -1 for a part of an arc
  };
  template <class Visit>
  void for_each_turn(double t0, double t1, const Visit& visit) const;
  /// Knots of some pieces behind their starts, t and arc from the start of each piece.
  struct Run {
    std::vector<Knot> knots;
    std::vector<std::size_t> ends; // of the knots of each piece
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
  std::vector<Knot> knots_; // ascending in t; the last closes the loop
  std::vector<LocalIndex>
      first_in_bucket_; // the first knot in each bucket of equal lengths of t or behind it, and the end
  double buckets_per_t_ = 0;
  std::vector<double> piece_t_; // pieces + 1
  std::vector<double> turn_;    // signed turn at the start of each piece, radians
};

} // namespace trime::boundary
