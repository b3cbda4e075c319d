// SPDX-License-Identifier: BSD-3-Clause
// A boundary on which points become corners, one after the other.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace trime::boundary {

/// @brief The pieces as they are given, and what points have made of them, in one ring for each loop.
///
/// A point finds the pieces near it in a tree of those that were given, and in each of these the parts near it by where
/// they lie along it: F points on M pieces take O((F + M) log(F + M)).
class CorneredBoundary {
public:
  /// @param pieces of `boundary` @param tolerance how far from a curve a point on it may lie
  /// @pre `boundary` and `pieces` outlive it
  CorneredBoundary(const geometry::Boundary& boundary, const geometry::PieceTree& pieces, double tolerance);

  /// @brief The nearest piece of all is divided at p, or its end moved there if that is as near.
  /// @pre p, or an image of it, lies on a piece that was given; no point before it was as near as the tolerance
  void add_corner(geometry::Vec2 p);
  /// The boundary with a corner at each of the points. O(pieces)
  geometry::Boundary result() const;
  /// Distances from points to pieces that were computed so far.
  std::int64_t distances() const { return distances_; }

private:
  /// The parts of a given piece by where they begin along it.
  using Parts = std::multimap<double, std::size_t>;
  /// A piece, or a part of one.
  struct Link {
    geometry::Piece piece;
    std::size_t before, after; // along the loop
    std::size_t origin;        // the piece that was given
    Parts::iterator place;     // if that was divided
  };
  struct Nearest {
    double distance;
    std::size_t link;
    geometry::Vec2 image; // of the point
  };

  void look_near(std::size_t origin, geometry::Vec2 image, Nearest& best);
  void look_at(std::size_t link, geometry::Vec2 image, Nearest& best);
  std::vector<geometry::Vec2> shifts_of(std::size_t origin) const;
  double along(std::size_t origin, geometry::Vec2 p) const;
  void divide(std::size_t link, geometry::Vec2 p);

  const geometry::Boundary& boundary_;
  const geometry::PieceTree& tree_;
  const double tolerance_;
  std::vector<geometry::Vec2> images_;           // shifts under which a point may be seen from the container
  std::vector<const geometry::Piece*> given_;    // loop by loop
  std::vector<Link> links_;                      // the first ones are those of given_
  std::unordered_map<std::size_t, Parts> parts_; // of the pieces that were divided
  std::int64_t distances_ = 0;
};

/// The shifts under which a point may be seen from the container and next to it, {0, 0} first.
std::vector<geometry::Vec2> images_of(const geometry::Periods& periods);

} // namespace trime::boundary
