// SPDX-License-Identifier: BSD-3-Clause
// Cuts a loop into stretches between its corners, and decides where shells (sites at equal distances from a sharp
// corner) lie.
#pragma once

#include "boundary/loop_metric.hpp"

#include <vector>

namespace trime::boundary {

/// A junction of two pieces that certainly becomes a site.
struct LoopCorner {
  double t;
  geometry::Vec2 position;
  bool sharp;
  double wedge;                      // Piece::wedge
  std::vector<double> ahead, behind; // coordinates t of the shells on the two sides, from the corner outwards; not
                                     // reduced modulo the loop's length
};

/// A stretch between two fixed places. The sites on a stretch divide the integral of ds/h into equal shares.
struct Stretch {
  double from, to;
  long intervals;                 // number of intervals; 0 if not known yet
  bool ragged = false;            // if true, a shortest path chooses the sites instead
  const LoopCorner* at = nullptr; // the corner at which the stretch starts; null if it does not start at a corner
};

/// All stretches of a loop. Movable, but not copyable.
struct LoopStretches {
  LoopStretches() = default;
  LoopStretches(LoopStretches&&) = default;
  std::vector<LoopCorner> corners;
  std::vector<Stretch> list; // the stretches in order along the loop; they point to elements of `corners`
};

/// Cuts a loop into stretches, by all threads. If `tolerance` is above 0, corners that turn by more than `corner_angle`
/// degrees may be left out.
LoopStretches cut_into_stretches(const LoopMetric& metric, double corner_angle, double tolerance);

} // namespace trime::boundary
