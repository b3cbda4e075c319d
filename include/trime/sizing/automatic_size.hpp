// SPDX-License-Identifier: BSD-3-Clause
// The automatic size field: small where the boundary has small features, and growing from there at most at a given
// rate.
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
  double gradation = 0.1; ///< K >= 0, the growth of the size per length; see AutomaticSize. 0 makes it uniform
  /// Length below which features are not resolved, > 0: the local feature size is never taken smaller. It is needed
  /// because at a corner of a polygon the medial axis meets the boundary and the local feature size is 0. A good value
  /// is half the mean edge length of the mesh.
  double feature_floor = 0;
  geometry::Box container;           ///< where the field is defined; outside, the nearest point counts
  double period_x = 0, period_y = 0; ///< the container's side if it is periodic in that direction, else 0
};

/// @brief The feature floor for a mesh with this number of points or this edge length: half the mean edge length. A
/// mesh cannot show smaller features.
/// @return half the edge length if it is given, else 0.5 sqrt(2/sqrt(3) area/points): the edges of equilateral
/// triangles, two for each point
double feature_floor(std::optional<GlobalId> points, std::optional<double> edge_length, double area);

class Images;

/// @brief s(x) = min over boundary points b of K |x - b| + lfs(b), at most the container's width + height.
///
/// lfs(b), the local feature size, is the distance from b to the medial axis of the boundary, but at least the feature
/// floor. The axis has an inner and an outer part. The outer part counts only inside the container: a shape near the
/// border of the container is not near to anything there. Medial points that see their two nearest boundary points at
/// less than 60 degrees are noise of the boundary and are dropped. Medial points are centres of balls that are shrunk
/// until they touch the boundary on two sides (Ma, Bae, Choi 2012). There is one ball for each side of a boundary
/// sample, and more around corners. The distance of samples follows the local feature size.
///
/// The field is kept in a quadtree. A cell holds the few cones K |x - b| + lfs(b) that make the field in it, within 1 %
/// and exactly at its corners. A cell so small that the field changes by less than 1 % is bilinear.
///
/// K bounds exactly the gradient of s, of the values at corners, and of cells with cones. In a bilinear cell either
/// component of the gradient is at most K; along a diagonal it can be up to sqrt(2) K long. Where cells meet the field
/// may jump by that 1 %.
class AutomaticSize final : public SizeField {
public:
  /// @brief Takes O(n log n + cells) time for n boundary samples. Ranks and threads share the work, and all ranks get
  /// the same bits. Collective.
  /// @pre gradation > 0, feature_floor > 0, the boundary has a loop
  AutomaticSize(const comm::Communicator& comm, const geometry::Boundary& boundary,
                const AutomaticSizeOptions& options);
  ~AutomaticSize() override;

  /// Takes about 15 ns for points row by row and 60 ns for random points; does not allocate.
  double size(geometry::Vec2 p) const override;
  double least() const;   ///< no value of the field is smaller
  double largest() const; ///< no value of the field is larger
  std::size_t memory_bytes() const override;

private:
  std::unique_ptr<const Images> images_;
  std::unique_ptr<const cones::SizeQuadtree> tree_;
};

/// @brief Makes the automatic size field, or a uniform one if the gradation is 0 or there is no boundary. Collective.
/// @throws ConfigError for a negative gradation, a feature floor that is not positive, or an empty container
std::unique_ptr<SizeField> make_automatic_size(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                               const AutomaticSizeOptions& options);

} // namespace trime::sizing
