// SPDX-License-Identifier: BSD-3-Clause
// A loop cut into stretches between its corners, with shells at sharp ones, before sites are laid.
#pragma once

#include "boundary/loop_metric.hpp"

#include <vector>

namespace trime::boundary {

/// A junction that is a site for certain.
struct LoopCorner {
  double t;
  geometry::Vec2 position;
  bool sharp;
  std::vector<double> ahead, behind; // t of the shells on its two arms, from the corner outward; unwrapped
};

/// A stretch between two fixed places that is divided at equal quantiles.
struct Stretch {
  double from, to;
  long intervals;                 // 0: not known yet
  bool ragged = false;            // its sites are chosen, not quantiles
  const LoopCorner* at = nullptr; // the corner where it starts, if it does at one
};

/// All of a loop. May be moved, not copied.
struct LoopStretches {
  LoopStretches() = default;
  LoopStretches(LoopStretches&&) = default;
  std::vector<LoopCorner> corners;
  std::vector<Stretch> list; // in order along the loop; they keep pointers to corners
};

/// All threads work. Corners that turn by more than `corner_angle` degrees may be left out if `tolerance` is above 0.
LoopStretches cut_into_stretches(const LoopMetric& metric, double corner_angle, double tolerance);

} // namespace trime::boundary
