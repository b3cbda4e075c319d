// SPDX-License-Identifier: BSD-3-Clause
// Options of the mesher, and its result. Plain data.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/cleanup/cleanup_counts.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/region_loss.hpp"
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

/// Options for making one mesh.
struct MeshOptions {
  /// Number of points. Exactly one of points and edge_length must be set, unless the sizes are absolute: then
  /// edge_length must be empty, and points is a limit.
  std::optional<GlobalId> points;
  std::optional<double> edge_length; ///< target edge length; if the size varies, its mean
  /// If true, the size field gives lengths, and no factor is applied. A mesh that would have more than `points` points
  /// is refused with a ConfigError.
  bool absolute_sizes = false;
  sweep::Method method = sweep::Method::hybrid;
  std::uint64_t seed = 1;
  int max_sweeps = 500;

  std::optional<int> cells_x, cells_y;      ///< cells of the grid over the container; empty: about 3.3 points per cell
  std::optional<double> min_size, max_size; ///< lower and upper bound on the target edge length h
  /// Largest growth of h per unit of distance in the mesh as it is written, around narrow places, too. A steeper size
  /// is lowered around its small values. Empty: the size is used as it is, and grows by 0.2 around narrow places.
  std::optional<double> gradation;
  /// A mesh with a shorter edge fails a check. Sizes are raised around places where edges would be shorter, and the
  /// shape is simplified there; if that is not enough, the mesh is made again.
  std::optional<double> shortest_edge;
  boundary::FeatureOptions features; ///< which corners, islands and lakes the mesh keeps

  start::Start start = start::Start::automatic; ///< how the first points are placed; automatic: a lattice for a uniform
                                                ///< size field, otherwise coarse to fine
  /// Share of the points that are placed before the first sweep. The other points are inserted in later stages, into
  /// the triangles that are largest compared with h. Empty: all points are placed at the beginning, in the way that
  /// `start` names.
  std::optional<double> initial_fraction;
  std::optional<double>
      stop_tolerance; ///< least gain of quality in six sweeps, below which a stage ends; empty: default of the method
  /// Exponent of 1/h in the weight of the Voronoi cells. With 4 the distance between points is proportional to h; other
  /// values serve comparisons.
  int density_exponent = 4;
  sweep::StarTests star_tests; ///< slow options for tests
  double worst_alpha =
      5; ///< a triangle with a larger alpha, R/(2r), fails a check, unless it lies at a corner below 60 degrees
  bool cleanup = true; ///< whether the worst triangles are improved after the sweeps
  /// If true, the clean-up divides triangles with two boundary edges, where the corner has 60 degrees or more.
  bool split_ears = false;
  /// 0: no snapshots; -2: one snapshot of the first triangulation; n > 0: snapshots of the first and of every n-th
  /// triangulation.
  int snapshot_interval = 0;
};

/// A region of the mesh.
struct RegionSummary {
  std::int64_t triangles = 0;
  double area = 0;       ///< area of its triangles
  double given_area = 0; ///< its area in the shape as it was given
};

/// The mesh, and everything that the report of a run prints about it.
struct MeshResult {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
  mesh::Checks checks;
  std::vector<sweep::SweepRecord> history;
  int triangulations = 0; ///< how often sites were triangulated: once per stage, and once after every move of all sites
  sweep::StopReason stop_reason = sweep::StopReason::sweep_cap;
  GlobalId requested_points = 0; ///< number of points that the user asked for; 0 if an edge length was given
  double edge_length = 0; ///< for a uniform size h; otherwise the edge length of equilateral triangles that would fill
                          ///< the shape with as many points
  std::string start_reason; ///< the chosen start and the reason for it, in one line
  std::string count_reason; ///< the reason why there are fewer points than requested; empty if the difference is small
  std::vector<polygon::LoopSummary> loops; ///< the loops of the mesh boundary, ordered by tag
  cleanup::CleanupCounts cleanup;
  GlobalId corners = 0;
  int components = 0, holes = 0;
  double shape_area = 0; ///< area of the meshed shape, without dropped islands but with filled lakes
  boundary::FeatureReport features;
  std::vector<RegionSummary> regions; ///< in the order of geometry::Regions::names; empty if there is only one
  std::vector<geometry::RegionLoss> region_losses; ///< in the order of loser, winner and reason, each at most once
};

} // namespace trime::meshing
