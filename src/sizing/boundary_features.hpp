// SPDX-License-Identifier: BSD-3-Clause
// Samples of a boundary with their local feature sizes, the cones whose lower envelope is the automatic size field.
// They come from points of the medial axis, found by shrinking balls (Ma, Bae, Choi 2012), one for each ray from the
// boundary.
#pragma once

#include "cones/cone_tree.hpp"
#include "sizing/piece_locator.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"

#include <optional>
#include <vector>

namespace trime::sizing {

/// A boundary point and a unit vector normal to the boundary there, to one of its sides.
struct NormalRay {
  geometry::Vec2 origin, normal;
  int side; ///< 0 to the left of the boundary, 1 to the right
};

/// Least angle, in degrees, at which a medial point sees its two nearest boundary points; below it is noise. A corner
/// that turns by at least this much has an axis that ends in it.
inline constexpr double separation_degrees = 60;

/// Rays from the middle of a smooth curve with this unit tangent, to both sides.
void append_rays(geometry::Vec2 p, geometry::Vec2 tangent, std::vector<NormalRay>& rays);
/// Rays from a vertex with these tangents before and after it: a fan on the side that it points to.
void append_rays(geometry::Vec2 p, geometry::Vec2 before, geometry::Vec2 after, std::vector<NormalRay>& rays);
/// Does an axis end in a vertex with these tangents?
bool axis_ends_at(geometry::Vec2 before, geometry::Vec2 after);

/// @brief Centre of the largest empty ball that touches the boundary at the ray's origin, on the ray's side; nothing if
/// it is larger than the container's diagonal, lies outside of the container, or is noise.
/// About 4 queries of the nearest boundary point.
/// @param radius in: the first radius to try; out: that of the ball
std::optional<geometry::Vec2> medial_point(const NormalRay& ray, const PieceLocator& boundary, const Images& images,
                                           double& radius);

/// @brief Cones (b, lfs(b)) with lfs at least `feature_floor`, so dense that the envelope is right to a few per cent;
/// those that others cover completely, at slope `gradation`, are left out; periodic images within reach included.
/// O(n log n) for n samples, shared by ranks and threads. Collective.
/// @pre feature_floor > 0, gradation > 0, the boundary has a piece
std::vector<cones::Cone> boundary_features(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                           const Images& images, double feature_floor, double gradation);

} // namespace trime::sizing
