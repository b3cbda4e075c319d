// SPDX-License-Identifier: BSD-3-Clause
// The shape that is meshed: parts joined by a region expression, its exact boundary, inside test and distance; and the
// seam for shapes of a user's own.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/geometry/part.hpp"
#include "trime/geometry/region.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trime::geometry {

/// @brief A shape given by a function: derive from it to mesh a shape of one's own, see Part::implicit and traced().
/// Called concurrently, and must give the same bits on every rank.
class Shape {
public:
  virtual ~Shape() = default;
  /// @brief Negative inside, positive outside, finite in the whole container. Only the zero set becomes the shape; near
  /// it the function should be Lipschitz with about the same constant everywhere, best of all the distance itself.
  virtual double signed_distance(Vec2 p) const = 0;
};

/// @brief The boundary of a region: the parts' boundaries, cut at their crossings, and of those the pieces with the
/// region on one side only.
///
/// No grid and no tracing: crossings are computed to a lattice step, everything else is combinatorial. Features smaller
/// than a few lattice steps vanish. Loops are ordered by their lexicographically smallest start, where each begins;
/// tags follow that order from 1. In a periodic container the region is where any image of its parts lies, and loops
/// are unrolled (see Loop). Piece::part is an index into part_names: `parts`, then `domain` if the region has it.
/// O(M log M) for M pieces.
/// @throws GeometryError if the region is empty, leaves the container, or its boundary touches itself, or if a part
/// sticks out of a periodic side by more than one period
Boundary make_boundary(const Region& region, std::span<const Part> parts, const Frame& frame);

/// Nearest piece of a boundary: boxes around runs of consecutive pieces, in a binary hierarchy.
class PieceTree {
public:
  PieceTree() = default;
  /// O(M) time, about 60 bytes per piece.
  explicit PieceTree(const Boundary& boundary);
  /// @brief Distance from p to the nearest piece or image of one, infinity without pieces; O(log M) for curves,
  /// thread-safe.
  double distance(Vec2 p) const;

private:
  static constexpr std::size_t run_length = 4;
  struct Item {
    Vec2 a, b;
    LocalIndex arc; ///< into arcs_, or -1 for a segment
  };
  double squared_distance_to_run(std::size_t run, Vec2 p) const;
  void search(Vec2 p, double& best) const;

  Periods periods_;
  std::vector<Item> items_;
  std::vector<Piece> arcs_;
  std::vector<Box> boxes_; // heap order: the root is 1, the children of k are 2k and 2k+1; the runs are the leaves
};

/// Parts joined by a region. Immutable after construction; all queries are thread-safe.
class RegionShape final : public Shape {
public:
  /// @brief Parses the region and makes the boundary.
  /// @param parts named differently, none of them `domain`; see Region::parse for `region`
  /// @throws ConfigError for the region, or for names; GeometryError see make_boundary
  RegionShape(std::vector<Part> parts, std::string_view region, const Frame& frame);

  const Frame& frame() const { return frame_; }
  const Boundary& boundary() const { return boundary_; }
  /// The parts as given, then the container under the name `domain`.
  const std::vector<Part>& parts() const { return parts_; }
  const Region& region() const { return region_; }

  /// @brief Exact for lattice points; a point on the boundary may get either answer.
  bool inside(Vec2 p) const;
  /// @brief Distance to the nearest point of the boundary, to within rounding.
  double distance_to_boundary(Vec2 p) const { return tree_.distance(p); }
  /// Negative inside.
  double signed_distance(Vec2 p) const override {
    return inside(p) ? -distance_to_boundary(p) : distance_to_boundary(p);
  }

private:
  Frame frame_;
  std::vector<Part> parts_;
  std::vector<std::vector<Vec2>> shifts_; // of the images of each part
  Region region_;
  Boundary boundary_;
  PieceTree tree_;
};

/// @brief A shape of one's own, traced: the region that consists of it alone. See Part::implicit for cost and errors.
RegionShape traced(const Shape& shape, const Frame& frame, const std::string& name = "shape");

} // namespace trime::geometry
