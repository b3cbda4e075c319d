// SPDX-License-Identifier: BSD-3-Clause
// Samples the boundary and its local feature sizes. Each sample gives a cone; the lower envelope of all cones is the
// automatic size field.
#pragma once

#include "cones/cone_tree.hpp"
#include "sizing/piece_locator.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"

#include <optional>
#include <vector>

namespace trime::sizing {

/// A boundary point, and a unit vector normal to the boundary there that points to one of its sides.
struct NormalRay {
  geometry::Vec2 origin, normal;
  int side; ///< 0 to the left of the boundary, 1 to the right
};

/// [degrees] A medial point is dropped as noise if the directions to its two nearest boundary points differ by a
/// smaller angle. The medial axis ends in a corner that turns by at least this angle.
inline constexpr double separation_degrees = 60;

/// Appends the rays to both sides at a point of a smooth curve with this unit tangent.
void append_rays(geometry::Vec2 p, geometry::Vec2 tangent, std::vector<NormalRay>& rays);
/// Appends the rays at a vertex with these tangents before and after it: several rays on the side to which the vertex
/// points.
void append_rays(geometry::Vec2 p, geometry::Vec2 before, geometry::Vec2 after, std::vector<NormalRay>& rays);
/// Returns whether the medial axis ends in a vertex with these tangents.
bool axis_ends_at(geometry::Vec2 before, geometry::Vec2 after);

/// @brief Returns the centre of the largest empty ball that touches the boundary at the origin of the ray, on the ray's
/// side. Returns nothing if the ball is larger than the diagonal of the container, if its centre lies outside of the
/// container, or if it is noise. Takes about 4 queries of the nearest boundary point.
/// @param radius in: the first radius to try; out: the radius of the ball
std::optional<geometry::Vec2> medial_point(const NormalRay& ray, const PieceLocator& boundary, const Images& images,
                                           double& radius);

/// @brief Returns cones (b, lfs(b)) with a local feature size of at least `feature_floor`, so dense that the envelope
/// has an error of a few per cent. Cones that other cones cover completely at the slope `gradation` are left out;
/// periodic images within reach are included. Cost: O(n log n) for n samples, shared by ranks and threads. Collective.
/// @pre feature_floor > 0, gradation > 0, the boundary has a piece
std::vector<cones::Cone> boundary_features(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                           const Images& images, double feature_floor, double gradation);

} // namespace trime::sizing
