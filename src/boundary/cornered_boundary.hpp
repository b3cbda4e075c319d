// SPDX-License-Identifier: BSD-3-Clause
// Turns points on a boundary into corners, one after the other.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace trime::boundary {

/// @brief The given pieces, and the parts into which points have divided them, in one ring for each loop.
///
/// The pieces near a point are found in a tree of the given pieces, and parts of a piece by their place along it. So F
/// points on M pieces take O((F + M) log(F + M)).
class CorneredBoundary {
public:
  /// @param pieces tree of the pieces of `boundary` @param tolerance how far from a curve a point on it may lie
  /// @pre `boundary` and `pieces` outlive it
  CorneredBoundary(const geometry::Boundary& boundary, const geometry::PieceTree& pieces, double tolerance);

  /// @brief Divides the nearest piece at p, or moves its end to p if the end is equally near.
  /// @pre p, or an image of it, lies on a given piece; no earlier point is within the tolerance of p
  void add_corner(geometry::Vec2 p);
  /// Returns the boundary with a corner at each of the points. O(pieces)
  geometry::Boundary result() const;
  /// Number of distances from points to pieces that were computed so far.
  std::int64_t distances() const { return distances_; }

private:
  /// The parts of a given piece, by the place along it where they begin.
  using Parts = std::multimap<double, std::size_t>;
  /// A piece, or a part of one.
  struct Link {
    geometry::Piece piece;
    std::size_t before, after; // neighbours along the loop
    std::size_t origin;        // the given piece
    Parts::iterator place;     // its part, if the given piece was divided
  };
  struct Nearest {
    double distance;
    std::size_t link;
    geometry::Vec2 image; // image of the point
  };

  void look_near(std::size_t origin, geometry::Vec2 image, Nearest& best);
  void look_at(std::size_t link, geometry::Vec2 image, Nearest& best);
  std::vector<geometry::Vec2> shifts_of(std::size_t origin) const;
  double along(std::size_t origin, geometry::Vec2 p) const;
  void divide(std::size_t link, geometry::Vec2 p);

  const geometry::Boundary& boundary_;
  const geometry::PieceTree& tree_;
  const double tolerance_;
  std::vector<geometry::Vec2> images_;           // shifts to images of a point that may touch the container
  std::vector<const geometry::Piece*> given_;    // given pieces, loop by loop
  std::vector<Link> links_;                      // the first ones belong to given_
  std::unordered_map<std::size_t, Parts> parts_; // parts of the divided pieces
  std::int64_t distances_ = 0;
};

/// Returns the shifts to the images of a point in the container and next to it, {0, 0} first.
std::vector<geometry::Vec2> images_of(const geometry::Periods& periods);

} // namespace trime::boundary
