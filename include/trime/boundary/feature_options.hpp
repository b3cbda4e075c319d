// SPDX-License-Identifier: BSD-3-Clause
// Which features of the boundary a user wants to see in the mesh. Plain data.
#pragma once

namespace trime::boundary {

/// What becomes of parts of the outside that are narrower than the triangles: slits, cracks, walls.
enum class NarrowOutside {
  keep,  ///< their sides are moved apart where they are nearer than a third of the local size
  close, ///< they become a part of the shape
};

/// Which corners, islands, lakes and narrow parts of the shape the mesh keeps.
struct FeatureOptions {
  double corner_angle = 30;  ///< degrees: a vertex of the boundary that turns by more is a corner
  bool keep_all = false;     ///< keeps every corner, island, lake and narrow part, however small
  bool refine_narrow = true; ///< a uniform size is lowered where the shape is narrower than the triangles
  double tolerance = 0.1;    ///< in local sizes: how far chords may pass from corners that they leave out
  double within = 0.5;       ///< in local sizes: how far simplified curves may lie from the given ones
  NarrowOutside narrow = NarrowOutside::keep; ///< beside components of less than 5 h perimeter they close anyway
};

} // namespace trime::boundary
