// SPDX-License-Identifier: BSD-3-Clause
// Options: which corners, islands, lakes and narrow parts of the boundary the mesh keeps. Plain data.
#pragma once

namespace trime::boundary {

/// How the mesher treats parts of the outside that are narrower than the triangles: slits, cracks, walls.
enum class NarrowOutside {
  keep,  ///< moves their sides apart where these are nearer than a third of the local size
  close, ///< makes them a part of the shape
};

/// Which corners, islands, lakes and narrow parts of the shape the mesh keeps.
struct FeatureOptions {
  double corner_angle = 30;  ///< degrees: a vertex of the boundary that turns by more is a corner
  bool keep_all = false;     ///< keeps every corner, island, lake and narrow part, however small
  bool refine_narrow = true; ///< lowers a uniform size where the shape is narrower than the triangles
  double tolerance = 0.1;    ///< in local sizes: how far chords may pass from corners that they leave out
  double within = 0.5;       ///< in local sizes: how far simplified curves may lie from the given ones
  NarrowOutside narrow =
      NarrowOutside::keep; ///< narrow gaps next to components with a perimeter below 5 h are always closed
};

} // namespace trime::boundary
