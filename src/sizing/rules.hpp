// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the automatic size field.
#pragma once

#include "core/angle.hpp"

namespace trime::sizing {

/// The numbers of sizing: how the boundary is sampled, and how balls on its medial axis are found.
struct SizingRules {
  /// [local feature size] Samples with medial points are so far apart at most.
  static constexpr double sample_spacing = 0.35;
  /// [1] The field between two samples may be off by this share.
  static constexpr double envelope_error = 0.02;
  /// [1] A local feature size may be too large by this share: the balls of a polygon like a disc all have nearly one
  /// centre, and a search for the nearest of them would look at all.
  static constexpr double nearest_slack = 1e-3;
  /// [1] A sample is left out if the one before gives the field to within this share.
  static constexpr double thinning_error = 0.01;
  /// [width of the container] First radius that is tried along a run of rays.
  static constexpr double first_radius = 1.0 / 32;
  /// [1] The first ball that a ray tries is so much larger than the ball of the ray before.
  static constexpr double radius_growth = 1.5;
  /// [samples] Along a line as long as the container, before any are added.
  static constexpr int first_samples = 32;
  /// [rad] Between the rays from a vertex.
  static constexpr double fan_step = 20 * degrees;
  /// [rad] A vertex that turns by less needs no fan of rays.
  static constexpr double straight = 5 * degrees;
  /// [1] A first ball that is empty grows by this factor.
  static constexpr double first_growth = 4;
  /// [radius] The centre of a ball is so far from the boundary if the ball is empty.
  static constexpr double empty_share = 1 - 1e-3;
  /// [radius] The same for a ball with nothing but noise in it.
  static constexpr double nearly_empty_share = 0.7;
};

} // namespace trime::sizing
