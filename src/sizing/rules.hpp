// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module sizing, for the automatic size field.
#pragma once

#include "core/angle.hpp"

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
};

} // namespace trime::sizing
