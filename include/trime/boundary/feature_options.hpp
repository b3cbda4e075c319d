// SPDX-License-Identifier: BSD-3-Clause
// Which features of the boundary a user wants to see in the mesh. Plain data.
#pragma once

namespace trime::boundary {

/// Which corners, islands and lakes of the shape the mesh keeps.
struct FeatureOptions {
  double corner_angle = 30; ///< degrees: a vertex of the boundary that turns by more is a corner
  bool keep_all = false;    ///< keeps every corner, island and lake, however small
  bool refine_narrow = true; ///< a uniform size is lowered where the shape is narrower than the triangles
  double tolerance = 0.1;   ///< in local sizes: how far chords may pass from corners that they leave out
};

} // namespace trime::boundary
