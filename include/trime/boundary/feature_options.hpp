// SPDX-License-Identifier: BSD-3-Clause
// Options: which corners, islands, lakes and narrow parts of the boundary the mesh keeps. Plain data.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <optional>

namespace trime::boundary {

/// How the mesher treats parts of the outside that are narrower than the triangles: slits, cracks, walls.
enum class NarrowOutside {
  keep,  ///< moves their sides apart where these are nearer than a third of the local size
  close, ///< makes them a part of the shape
};

/// What becomes of narrow parts of the shape, or of the outside, that join or separate what is larger than the
/// triangles.
enum class Connections {
  keep, ///< the size is lowered there, and parts that are narrower than 0.35 of it are widened
  cut,  ///< they are cut like dead ends, and a warning says so
};

/// Which components of the simplified shape are meshed.
enum class Components {
  all,
  largest, ///< the one with the largest area
  at,      ///< the one that holds a place
};

/// Which corners, islands, lakes and narrow parts of the shape the mesh keeps.
struct FeatureOptions {
  double corner_angle = 30;  ///< degrees: a vertex of the boundary that turns by more is a corner
  bool keep_all = false;     ///< keeps every corner, island, lake and narrow part, however small
  bool refine_narrow = true; ///< lowers a uniform size where the shape is narrower than the triangles
  double tolerance = 0.1;    ///< in local sizes: how far chords may pass from corners that they leave out
  double within = 0.5;       ///< in local sizes: how far simplified curves may lie from the given ones
  Connections connect = Connections::keep;
  Components components = Components::all;
  geometry::Vec2 component_place; ///< for Components::at
  std::optional<double> max_loss; ///< share of the area: if more is lost, the mesh counts as incomplete
  NarrowOutside narrow =
      NarrowOutside::keep; ///< narrow gaps next to components with a perimeter below 5 h are always closed
};

} // namespace trime::boundary
