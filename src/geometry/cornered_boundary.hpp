// SPDX-License-Identifier: BSD-3-Clause
// Turns points on a boundary into corners of it, one after the other.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace trime::geometry {

/// @brief A boundary whose pieces are divided at given points. Each loop is a linked list of pieces and parts of
/// pieces.
///
/// A tree finds the given pieces near a point; a sorted map finds the part of a piece at the point. So adding F points
/// to M pieces takes O((F + M) log(F + M)) time.
class CorneredBoundary {
public:
  /// @param pieces tree of the pieces of `boundary`
  /// @param tolerance largest distance from a curve at which a point counts as lying on it
  /// @pre `boundary` and `pieces` outlive this object
  CorneredBoundary(const Boundary& boundary, const PieceTree& pieces, double tolerance);

  /// @brief Divides the piece nearest to p at p. If the end of a piece is equally near, moves this end to p instead.
  /// @pre p, or a periodic image of p, lies on a given piece; no earlier point is within the tolerance of p
  void add_corner(Vec2 p);
  /// Returns the boundary with a corner at each of the added points. Cost: O(pieces).
  Boundary result() const;
  /// Returns how many distances from points to pieces were computed so far.
  std::int64_t distances() const { return distances_; }

private:
  /// The parts of a given piece, sorted by the position along it at which they begin.
  using Parts = std::multimap<double, std::size_t>;
  /// A piece, or a part of one.
  struct Link {
    Piece piece;
    std::size_t before, after; // neighbours along the loop
    std::size_t origin;        // index of the given piece
    Parts::iterator place;     // entry of the part in Parts, if the given piece was divided
  };
  struct Nearest {
    double distance;
    std::size_t link;
    Vec2 image; // periodic image of the point
  };

  void look_near(std::size_t origin, Vec2 image, Nearest& best);
  void look_at(std::size_t link, Vec2 image, Nearest& best);
  std::vector<Vec2> shifts_of(std::size_t origin) const;
  double along(std::size_t origin, Vec2 p) const;
  void divide(std::size_t link, Vec2 p);

  const Boundary& boundary_;
  const PieceTree& tree_;
  const double tolerance_;
  std::vector<Vec2> images_;        // shifts to the periodic images of a point that may touch the container
  std::vector<const Piece*> given_; // given pieces, loop by loop
  std::vector<Link> links_;         // pieces and parts of pieces; the first ones are the pieces of given_
  std::unordered_map<std::size_t, Parts> parts_; // the parts of each divided piece
  std::int64_t distances_ = 0;
};

/// Returns the shifts from a point to its periodic images in the container and next to it; {0, 0} is the first.
std::vector<Vec2> images_of(const Periods& periods);

} // namespace trime::geometry
