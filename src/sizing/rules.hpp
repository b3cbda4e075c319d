// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module sizing, for the automatic size field and for the limit of its growth.
#pragma once

#include "core/angle.hpp"

#include <cstddef>

namespace trime::sizing {

/// Numbers that determine how the boundary is sampled, and how balls on its medial axis are found.
struct SizingRules {
  /// [local feature size] Largest distance between two samples of the boundary.
  static constexpr double sample_spacing = 0.35;
  /// [1] Largest relative error of the field between two samples.
  static constexpr double envelope_error = 0.02;
  /// [1] Relative error by which a local feature size may be too large. The balls of a polygon that approximates a disc
  /// have almost the same centre, and a search for the nearest of them would examine all.
  static constexpr double nearest_slack = 1e-3;
  /// [1] A sample is left out if the sample before it gives the field to within this relative error.
  static constexpr double thinning_error = 0.01;
  /// [width of the container] Radius of the first ball that is tried in a sequence of rays.
  static constexpr double first_radius = 1.0 / 32;
  /// [1] Radius of the first ball for a ray, divided by the radius of the ball found for the ray before.
  static constexpr double radius_growth = 1.5;
  /// [samples] Number of samples on a line as long as the container, before more samples are added.
  static constexpr int first_samples = 32;
  /// [rad] Angle between two rays at a vertex.
  static constexpr double fan_step = 20 * degrees;
  /// [rad] A vertex that turns by less than this gets no additional rays.
  static constexpr double straight = 5 * degrees;
  /// [1] If the first ball of a ray is empty, its radius is multiplied by this factor.
  static constexpr double first_growth = 4;
  /// [radius] A ball counts as empty if the distance from its centre to the boundary is at least this share of its
  /// radius.
  static constexpr double empty_share = 1 - 1e-3;
  /// [radius] A ball counts as nearly empty, so that only noise lies in it, if the distance from its centre to the
  /// boundary is at least this share of its radius.
  static constexpr double nearly_empty_share = 0.7;

  /// [1] Largest growth of a formula or function per length, unless the user sets another: triangles follow it with a
  /// largest alpha below 1.3. Measured on 40 meshes with jumps, kinks, bands and 10^(5x), 5e3 to 1e5 points.
  static constexpr double function_gradation = 0.3;
  /// [samples] Largest number of samples in which steep places are looked for. Not measured.
  static constexpr double most_steep_samples = 1 << 20;
  /// [cells] Smallest number of cells with a sample along a side of the box around the shape. Not measured.
  static constexpr double least_steep_cells = 8;
  /// [cells] Largest number of cells with a sample along a side of the box around the shape. Not measured.
  static constexpr double most_steep_cells = 1 << 14;
  /// [places] Largest number of places from which the growth of a size is limited, except those along the boundary, in
  /// meshes with few points. Not measured.
  static constexpr double most_steep_places = 1 << 17;
  /// [places] The same number in meshes with many points. Not measured.
  static constexpr double most_places_searched = 1 << 19;
  /// [seeds] Number of seeds from which the number of these places is estimated. Not measured.
  static constexpr std::size_t estimated_seeds = 256;
  /// [1] If the estimate exceeds the largest number by this factor, the places are not searched. Not measured.
  static constexpr double surely_full = 4;
  /// [places] A tree over the places is not renewed for fewer new ones. Not measured.
  static constexpr std::size_t few_steep_places = 64;
  /// [1] A slope counts as steep if it exceeds the gradation by this relative error. Not measured.
  static constexpr double gentle_excess = 0.01;
  /// [1] A sample is covered by the places found so far if the size that they allow there is smaller by this relative
  /// error. Not measured.
  static constexpr double covered_error = 0.005;
  /// [h] Distance of the steps with which the lower edge of a steep part is followed. Not measured.
  static constexpr double front_step = 0.35;
  /// [gradation x front_step x h] A place on the edge is kept if it lowers the size there by at least this much. Not
  /// measured.
  static constexpr double front_gain = 0.5;
  /// [h] Error of the distance of a place from the edge of the steep part. Not measured.
  static constexpr double front_precision = 0.02;
  /// [gradation] Growth of a size from the places at which it is limited. Between two places the size follows the steep
  /// field a little longer, so this is below 1: then the growth stays within the gradation. Not measured.
  static constexpr double limited_slope = 0.95;
  /// [directions] A place is on the ground of a valley if the size grows too fast in this number of the eight
  /// directions. Not measured.
  static constexpr int valley_directions = 6;
  /// [h] Error of the lowest size on the ground of a valley. Not measured.
  static constexpr double valley_error = 0.03;
  /// [h] Last step of the descent to the ground of a valley. Not measured.
  static constexpr double last_valley_step = 1e-3;
  /// [h] Last step of the descent to the lowest size near a place on the edge. Not measured.
  static constexpr double last_descent = 0.07;
  /// [h] Around a place on the edge of a steep part, other places of the edge are looked for where the size is larger
  /// by at most this much. Not measured.
  static constexpr double close_to_front = 2;
  /// [rounds] Largest number of steps to the edge of a steep part. Not measured.
  static constexpr int descent_rounds = 40;
};

} // namespace trime::sizing
