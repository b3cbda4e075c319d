// SPDX-License-Identifier: BSD-3-Clause
// What a user asks of the mesher, and what comes back beside the mesh. Plain data.
#pragma once

#include "trime/boundary/feature_options.hpp"
#include "trime/boundary/feature_summary.hpp"
#include "trime/boundary/fixed_point.hpp"
#include "trime/cleanup/cleanup_counts.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/mesh/validity.hpp"
#include "trime/polygon/loop_summary.hpp"
#include "trime/start/start_choice.hpp"
#include "trime/sweep/star_tests.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::meshing {

struct MeshOptions {
  std::optional<GlobalId> points;    ///< exactly one of points and edge_length is set
  std::optional<double> edge_length; ///< target edge length (uniform size)
  sweep::Method method = sweep::Method::hybrid;
  std::uint64_t seed = 1;
  int max_sweeps = 500;

  geometry::Box container{{0, 0}, {1, 1}};  ///< which of its sides are periodic, Boundary::periods says
  std::optional<int> cells_x, cells_y;      ///< container grid; empty: about 3.3 points a cell
  std::optional<double> min_size, max_size; ///< absolute bounds on h
  boundary::FeatureOptions features;        ///< which corners, islands and lakes the mesh keeps
  /// @brief Kept bit for bit (on the lattice) and never moved. On the boundary (to within 1e-10 of the container) they
  /// become corners; outside of the shape they are a GeometryError.
  std::vector<boundary::FixedPoint> fixed_points;

  start::Start start = start::Start::automatic; ///< lattice for a uniform size field, else coarse to fine
  /// Share of the points placed before the first sweep; the others are inserted in stages where the triangles are
  /// largest for their place. Empty: all at once, in the way that `start` names.
  std::optional<double> initial_fraction;
  std::optional<double> stop_tolerance; ///< empty: the default of the method
  /// Exponent of 1/h in the weight of the Voronoi cells: 4 keeps the spacing proportional to h; others are for
  /// comparisons.
  int density_exponent = 4;
  sweep::StarTests star_tests; ///< slow
  double worst_alpha = 5;      ///< a worse triangle away from corners below 60 degrees fails a check of the mesh
  bool cleanup = true;         ///< mend the worst triangles after the sweeps
  /// 0: none; -2: a snapshot of the first triangulation; n > 0: of the first and of every n-th.
  int snapshot_interval = 0;
};

struct MeshResult {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
  mesh::Checks checks;
  std::vector<sweep::SweepRecord> history;
  int triangulations = 0; ///< sites were triangulated so often: once a stage, and once after every move
  sweep::StopReason stop_reason = sweep::StopReason::sweep_cap;
  GlobalId requested_points = 0; ///< 0 if an edge length was asked for
  double edge_length = 0;        ///< uniform size: h; graded: edge length of as many equal triangles
  std::string start_reason;      ///< which start was chosen and why, one line
  std::string count_reason;      ///< why there are fewer points than requested; empty if they are nearly as many
  std::vector<polygon::LoopSummary> loops; ///< by tag
  cleanup::CleanupCounts cleanup;
  GlobalId corners = 0;
  int components = 0, holes = 0;
  double shape_area = 0; ///< of what is meshed: without islands, with lakes that were dropped
  boundary::FeatureReport features;
};

} // namespace trime::meshing
