// SPDX-License-Identifier: BSD-3-Clause
// Cuts a loop into stretches between its corners, with shells at sharp corners, before sites are laid.
#pragma once

#include "boundary/loop_metric.hpp"

#include <vector>

namespace trime::boundary {

/// A junction that certainly becomes a site.
struct LoopCorner {
  double t;
  geometry::Vec2 position;
  bool sharp;
  std::vector<double> ahead, behind; // t of the shells on its two arms, from the corner outwards; unwrapped
};

/// A stretch between two fixed places that is divided at equal quantiles.
struct Stretch {
  double from, to;
  long intervals;                 // 0 if not known yet
  bool ragged = false;            // if true, its sites are chosen and are not quantiles
  const LoopCorner* at = nullptr; // the corner where it starts; null if it does not start at a corner
};

/// All stretches of a loop. It may be moved, but not copied.
struct LoopStretches {
  LoopStretches() = default;
  LoopStretches(LoopStretches&&) = default;
  std::vector<LoopCorner> corners;
  std::vector<Stretch> list; // in order along the loop; points to corners
};

/// Cuts a loop, by all threads. Corners that turn by more than `corner_angle` degrees may be left out if `tolerance` is
/// above 0.
LoopStretches cut_into_stretches(const LoopMetric& metric, double corner_angle, double tolerance);

} // namespace trime::boundary
