// SPDX-License-Identifier: BSD-3-Clause
// What a user asks of the mesher, and what comes back beside the mesh. Plain data.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/mesh/validity.hpp"
#include "trime/meshing/feature_summary.hpp"
#include "trime/meshing/fixed_point.hpp"
#include "trime/meshing/loop_summary.hpp"
#include "trime/meshing/start_choice.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::meshing {

/// How points move: repulsive bars; centroids of Voronoi cells; bars until the median of alpha stalls, then centroids,
/// and at last towards equilateral triangles (TriangleRule).
enum class Method { distmesh, cvd, hybrid };

struct MeshOptions {
  geometry::Box container{{0, 0}, {1, 1}};
  /// For the frame in which a shape is made. From there on the periods of its boundary are the only ones that count.
  bool periodic_x = false, periodic_y = false;
  std::optional<int> cells_x, cells_y; ///< container grid; empty: about 3.3 points a cell
  Method method = Method::hybrid;
  std::optional<GlobalId> points;    ///< exactly one of points and edge_length is set
  std::optional<double> edge_length; ///< target edge length (uniform size)
  double corner_angle = 30;          ///< degrees
  bool keep_features = false;        ///< keeps every corner, island and lake, however small
  double feature_tolerance = 0.1;    ///< in local sizes: how far chords may pass from corners that they leave out
  std::uint64_t seed = 1;
  int max_sweeps = 500;
  std::optional<double> stop_tolerance; ///< empty: the default of the method
  Start start = Start::automatic;       ///< lattice for a uniform size field, else coarse to fine
  /// Share of the points placed before the first sweep; the others are inserted in stages where the triangles are
  /// largest for their place. Empty: all at once, in the way that `start` names.
  std::optional<double> initial_fraction;
  std::optional<double> min_size, max_size; ///< absolute bounds on h
  /// Exponent of 1/h in the weight of the Voronoi cells: 4 keeps the spacing proportional to h (see CvdRule); others
  /// are for comparisons.
  int density_exponent = 4;
  bool cleanup = true; ///< mend the worst triangles after the sweeps
  /// Compare every star after every sweep with one that is computed anew: slow, for tests. @throws InternalError
  bool verify_stars = false;
  /// Certify every star of every sweep by emptiness, and none by those around it: slow, for tests; the same mesh.
  bool stars_by_emptiness = false;
  /// @brief Kept bit for bit (on the lattice) and never moved. On the boundary (to within 1e-10 of the container) they
  /// become corners; outside of the shape they are a GeometryError.
  std::vector<FixedPoint> fixed_points;
  /// 0: none; -2: a snapshot of the first triangulation; n > 0: of the first and of every n-th.
  int snapshot_interval = 0;
};

enum class StopReason { converged, quality_stalled, sweep_cap };
/// "converged", "quality stalled", "sweep cap".
std::string to_string(StopReason reason);

/// One line of history: a triangulation whose quality was measured, and what the moves since the last one did.
struct SweepRecord {
  int sweep = 0;
  GlobalId points = 0;
  int stage = 0;        ///< of the point scheme: a level of the coarse-to-fine start, or an insertion
  bool by_bars = false; ///< the move after this triangulation is that of DistMesh, else of cells or triangles
  double median_alpha = 1, mean_alpha = 1, max_alpha = 1;
  double max_move = 0;     ///< longest move over local h
  double moving_share = 0; ///< share of the sites that moved more than 0.005 h
  GlobalId rebuilt_stars = 0, pushed = 0, deleted = 0;
  double seconds = 0; ///< since the start of the run; differs from run to run
};

/// What the clean-up of the worst triangles did, over all ranks.
struct CleanupCounts {
  std::int64_t patches = 0;                          ///< surroundings of bad triangles on which changes were tried
  std::int64_t better = 0;                           ///< of these kept
  std::int64_t moved = 0, inserted = 0, deleted = 0; ///< sites in what was kept; a site may move more than once
  std::int64_t on_boundary = 0;                      ///< of these sites, those on the boundary
  std::int64_t left = 0;                             ///< bad places where nothing helped

  void add(const CleanupCounts& other);
};

struct MeshResult {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
  mesh::Checks checks;
  std::vector<SweepRecord> history;
  int triangulations = 0; ///< sites were triangulated so often: once a stage, and once after every move
  StopReason stop_reason = StopReason::sweep_cap;
  GlobalId requested_points = 0;  ///< 0 if an edge length was asked for
  double edge_length = 0;         ///< uniform size: h; graded: edge length of as many equal triangles
  std::string start_reason;       ///< which start was chosen and why, one line
  std::string count_reason;       ///< why there are fewer points than requested; empty if they are nearly as many
  std::vector<LoopSummary> loops; ///< by tag
  CleanupCounts cleanup;
  GlobalId corners = 0;
  int components = 0, holes = 0;
  double shape_area = 0; ///< of what is meshed: without islands, with lakes that were dropped
  FeatureReport features;
};

} // namespace trime::meshing
