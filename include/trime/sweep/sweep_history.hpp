// SPDX-License-Identifier: BSD-3-Clause
// The methods that move points, options for tests of the sweeps, and the record of each sweep of a run. Plain data.
#pragma once

#include "trime/core/types.hpp"

#include <string>

namespace trime::sweep {

/// @brief The methods that move points. `distmesh`: each edge acts like a bar that pushes its two ends apart. `cvd`:
/// each point moves to the centroid of its Voronoi cell. `hybrid`: bars until the median of alpha stalls, then
/// centroids, and finally steps that make the triangles more equilateral.
enum class Method { distmesh, cvd, hybrid };

/// @brief Why the sweeps of the last stage ended. `converged`: no point moved by more than 0.005 h. `quality_stalled`:
/// six sweeps improved the mesh too little. `sweep_cap`: MeshOptions::max_sweeps was reached.
enum class StopReason { converged, quality_stalled, sweep_cap };
/// Returns "converged", "quality stalled" or "sweep cap".
std::string to_string(StopReason reason);

/// The record of a triangulation whose quality was measured, and of the moves since the record before it.
struct SweepRecord {
  int sweep = 0;
  GlobalId points = 0;
  int stage = 0; ///< number of the stage: a level of the coarse-to-fine start, or an insertion of points
  bool by_bars =
      false; ///< true if the next move uses the bar rule of DistMesh, false if it uses Voronoi cells or triangles
  double median_alpha = 1, mean_alpha = 1, max_alpha = 1;
  double max_move = 0;     ///< longest move, divided by the local h
  double moving_share = 0; ///< share of the sites that moved more than 0.005 h
  GlobalId rebuilt_stars = 0, pushed = 0, deleted = 0;
  double seconds = 0; ///< time since the start of the run; after a restart it continues from the last record. Differs
                      ///< between equal runs
};

/// Options for tests of the sweeps. Except for `sleepless`, they do not change the mesh.
struct StarTests {
  /// Compares the neighbours of every site after every sweep with newly computed ones.
  /// @throws InternalError if any two differ
  bool verify = false;
  /// Certifies every star in every sweep by the empty-circumcircle test instead of the faster local Delaunay test.
  bool by_emptiness = false;
  /// Lets all tiles and sites take part in every sweep, also those where nothing moves. The mesh may differ, because
  /// without this option small changes of an update rule's scale do not wake resting sites.
  bool sleepless = false;
};

} // namespace trime::sweep
