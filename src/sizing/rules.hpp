// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module sizing, for the automatic size field.
#pragma once

#include "core/angle.hpp"

namespace trime::sizing {

/// Numbers that say how the boundary is sampled, and how balls on its medial axis are found.
struct SizingRules {
  /// [local feature size] Largest distance between samples with medial points.
  static constexpr double sample_spacing = 0.35;
  /// [1] Largest relative error of the field between two samples.
  static constexpr double envelope_error = 0.02;
  /// [1] Share by which a local feature size may be too large. The balls of a disc-like polygon have almost one centre,
  /// and a search for the nearest of them would examine all.
  static constexpr double nearest_slack = 1e-3;
  /// [1] A sample is left out if the one before gives the field to within this share.
  static constexpr double thinning_error = 0.01;
  /// [width of the container] First radius that is tried along a run of rays.
  static constexpr double first_radius = 1.0 / 32;
  /// [1] Radius of the first ball of a ray over the radius of the ball of the ray before.
  static constexpr double radius_growth = 1.5;
  /// [samples] Number along a line as long as the container, before samples are added.
  static constexpr int first_samples = 32;
  /// [rad] Angle between the rays from a vertex.
  static constexpr double fan_step = 20 * degrees;
  /// [rad] A vertex that turns by less needs no fan of rays.
  static constexpr double straight = 5 * degrees;
  /// [1] A first ball that is empty grows by this factor.
  static constexpr double first_growth = 4;
  /// [radius] A ball counts as empty if its centre is at least this far from the boundary.
  static constexpr double empty_share = 1 - 1e-3;
  /// [radius] A ball counts as nearly empty, with only noise in it, if its centre is at least this far from the
  /// boundary.
  static constexpr double nearly_empty_share = 0.7;
};

} // namespace trime::sizing
