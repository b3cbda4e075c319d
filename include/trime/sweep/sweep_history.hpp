// SPDX-License-Identifier: BSD-3-Clause
// The methods that move points, options for tests of the sweeps, and the history of a run. Plain data.
#pragma once

#include "trime/core/types.hpp"

#include <string>

namespace trime::sweep {

/// @brief The methods that move points. `distmesh`: edges are bars that repel. `cvd`: each point goes to the centroid
/// of its Voronoi cell. `hybrid`: bars until the median of alpha stalls, then centroids, and finally towards
/// equilateral triangles.
enum class Method { distmesh, cvd, hybrid };

/// @brief Why the sweeps of the last stage ended. Converged: no point moved by more than 0.005 h. Quality stalled: six
/// sweeps improved the mesh too little. Sweep cap: MeshOptions::max_sweeps was reached.
enum class StopReason { converged, quality_stalled, sweep_cap };
/// Returns "converged", "quality stalled" or "sweep cap".
std::string to_string(StopReason reason);

/// One line of history: a triangulation whose quality was measured, and the effect of the moves since the last one.
struct SweepRecord {
  int sweep = 0;
  GlobalId points = 0;
  int stage = 0; ///< stage of the run: a level of the coarse-to-fine start, or an insertion
  bool by_bars =
      false; ///< the move after this triangulation uses the rule of DistMesh, else that of cells or triangles
  double median_alpha = 1, mean_alpha = 1, max_alpha = 1;
  double max_move = 0;     ///< longest move, divided by the local h
  double moving_share = 0; ///< share of the sites that moved more than 0.005 h
  GlobalId rebuilt_stars = 0, pushed = 0, deleted = 0;
  double seconds =
      0; ///< time since the start; after a restart it continues from the last record. Differs from run to run
};

/// Options for tests of the sweeps. The mesh is the same with each of them, with the exception of `sleepless`.
struct StarTests {
  /// Compares every star after every sweep with one that is computed from scratch. @throws InternalError if one differs
  bool verify = false;
  /// Certifies every star of every sweep by the empty-circle test, and not by the stars around it.
  bool by_emptiness = false;
  /// Keeps all tiles and sites awake in every sweep. The mesh may differ where a scale of the rule changes so little
  /// that it does not wake all sites.
  bool sleepless = false;
};

} // namespace trime::sweep
