// SPDX-License-Identifier: BSD-3-Clause
// Points of the medial axis by shrinking balls (Ma, Bae, Choi 2012), one for each ray from the boundary.
#pragma once

#include "sizing/images.hpp"
#include "sizing/piece_locator.hpp"

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

} // namespace trime::sizing
