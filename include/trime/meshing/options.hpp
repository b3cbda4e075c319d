// SPDX-License-Identifier: BSD-3-Clause
// Options of the mesher, and its result. Plain data.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/cleanup/cleanup_counts.hpp"
#include "trime/core/types.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/polygon/loop_summary.hpp"
#include "trime/start/start_choice.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::meshing {

/// Options of one mesh.
struct MeshOptions {
  std::optional<GlobalId> points;    ///< exactly one of points and edge_length is set
  std::optional<double> edge_length; ///< target edge length (uniform size)
  sweep::Method method = sweep::Method::hybrid;
  std::uint64_t seed = 1;
  int max_sweeps = 500;

  std::optional<int> cells_x, cells_y;      ///< container grid; empty: about 3.3 points a cell
  std::optional<double> min_size, max_size; ///< absolute bounds on h
  boundary::FeatureOptions features;        ///< which corners, islands and lakes the mesh keeps

  start::Start start = start::Start::automatic; ///< lattice for a uniform size field, else coarse to fine
  /// Share of the points that are placed before the first sweep. The others are inserted in stages, where triangles are
  /// largest for their place. Empty: all points are placed at once, as `start` says.
  std::optional<double> initial_fraction;
  std::optional<double> stop_tolerance; ///< empty: default of the method
  /// Exponent of 1/h in the weight of the Voronoi cells: 4 keeps the spacing proportional to h; other values are for
  /// comparisons.
  int density_exponent = 4;
  sweep::StarTests star_tests; ///< slow options for tests
  double worst_alpha = 5;      ///< a worse triangle away from corners below 60 degrees fails a check of the mesh
  bool cleanup = true;         ///< improve the worst triangles after the sweeps
  /// 0: no snapshots; -2: a snapshot of the first triangulation; n > 0: of the first and of every n-th.
  int snapshot_interval = 0;
};

/// The mesh and everything that the run reports about it.
struct MeshResult {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
  mesh::Checks checks;
  std::vector<sweep::SweepRecord> history;
  int triangulations = 0; ///< how often sites were triangulated: once per stage, and once after every move
  sweep::StopReason stop_reason = sweep::StopReason::sweep_cap;
  GlobalId requested_points = 0; ///< 0 if an edge length was asked for
  double edge_length = 0;        ///< uniform size: h; otherwise edge length of as many equal triangles
  std::string start_reason;      ///< which start was chosen and why, in one line
  std::string count_reason;      ///< why there are fewer points than requested; empty if they are nearly as many
  std::vector<polygon::LoopSummary> loops; ///< ordered by tag
  cleanup::CleanupCounts cleanup;
  GlobalId corners = 0;
  int components = 0, holes = 0;
  double shape_area = 0; ///< area of the meshed shape: without dropped islands, with dropped lakes
  boundary::FeatureReport features;
};

} // namespace trime::meshing
