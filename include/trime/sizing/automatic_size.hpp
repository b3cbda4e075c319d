// SPDX-License-Identifier: BSD-3-Clause
// The automatic size field: small where the boundary has small features, and growing from there with the distance, at
// most at a given rate.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <optional>

namespace trime::cones {
class SizeQuadtree;
}

namespace trime::sizing {

/// Options of the automatic size field.
struct AutomaticSizeOptions {
  double gradation = 0.1; ///< K >= 0: how much the size may grow per unit of distance; 0 makes the size uniform
  /// Length below which features of the boundary are not resolved, > 0: no local feature size is smaller. This lower
  /// bound is needed because the local feature size is 0 at a corner of a polygon, where the medial axis meets the
  /// boundary. A good value is half the mean edge length of the mesh.
  double feature_floor = 0;
  geometry::Box container; ///< where the field is defined; a point outside has the size of the nearest point inside
  double period_x = 0,
         period_y = 0; ///< length of the container's side if it is periodic in that direction, otherwise 0
};

/// @brief Returns the feature floor for a mesh with this number of points or this edge length: half the mean edge
/// length, because a mesh cannot show smaller features.
/// @return half the edge length if it is given, otherwise 0.5 sqrt(2/sqrt(3) area/points). The second formula assumes
/// equilateral triangles, two for each point
double feature_floor(std::optional<GlobalId> points, std::optional<double> edge_length, double area);

class Images;

/// @brief The size at x is the minimum over all boundary points b of K |x - b| + lfs(b), and at most the container's
/// width + height.
///
/// lfs(b), the local feature size, is the distance from b to the medial axis of the boundary, but at least the feature
/// floor. The medial axis has an inner and an outer part. The outer part is used only inside the container, because a
/// shape near the border of the container has no neighbour there. A medial point is dropped as noise of the boundary if
/// it sees its two nearest boundary points at an angle of less than 60 degrees. Medial points are the centres of balls
/// that are shrunk until they touch the boundary on two sides (Ma, Bae, Choi 2012). Each boundary sample has one ball
/// on each side, and more around corners. The distance between samples follows the local feature size.
///
/// The field is stored in a quadtree. A cell stores the few cones K |x - b| + lfs(b) that give the field in it, within
/// 1 % and exactly at its corners. A cell that is so small that the field changes by less than 1 % is bilinear.
///
/// The gradient is at most K: for s itself, between corners of cells, and inside cells with cones. In a bilinear cell
/// each component of the gradient is at most K, so along a diagonal it can reach sqrt(2) K. Where two cells meet, the
/// field may jump by the 1 % above.
class AutomaticSize final : public SizeField {
public:
  /// @brief Builds the field in O(n log n + cells) time for n boundary samples. Ranks and threads share the work, and
  /// all ranks get the same bits. Collective.
  /// @pre gradation > 0, feature_floor > 0, the boundary has a loop
  AutomaticSize(const comm::Communicator& comm, const geometry::Boundary& boundary,
                const AutomaticSizeOptions& options);
  ~AutomaticSize() override;

  /// Returns the size at p. Takes about 15 ns if points are passed row by row, and 60 ns for random points; does not
  /// allocate.
  double size(geometry::Vec2 p) const override;
  double largest_growth() const override { return gradation_; }
  double least() const;   ///< lower bound on all values of the field
  double largest() const; ///< upper bound on all values of the field
  std::size_t memory_bytes() const override;

private:
  std::unique_ptr<const Images> images_;
  std::unique_ptr<const cones::SizeQuadtree> tree_;
  double gradation_;
};

/// @brief Makes the automatic size field, or a uniform one if the gradation is 0 or there is no boundary. Collective.
/// @throws ConfigError for a negative gradation, a feature floor that is not positive, or an empty container
std::unique_ptr<SizeField> make_automatic_size(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                               const AutomaticSizeOptions& options);

} // namespace trime::sizing
