// SPDX-License-Identifier: BSD-3-Clause
// Computes the stars of the sites in a stage, and extracts the meshes that a run shows before its end (snapshots).
#pragma once

#include "core/state_fields.hpp"
#include "delaunay/star_builder.hpp"
#include "meshing/meshed_boundary.hpp"
#include "meshing/run_context.hpp"
#include "sites/stage.hpp"
#include "sweep/site_classes.hpp"
#include "trime/meshing/mesher.hpp"

#include <memory>

namespace trime::meshing {

/// @brief Computes, certifies and completes stars. Owns the cap, which is the largest circumradius in the first search
/// for triangles. All functions except begin_stage are collective.
class StageStars {
public:
  explicit StageStars(const RunContext& run) : run_(run) {}

  /// Begins a stage.
  /// @param points number of points of the stage, over all ranks
  void begin_stage(GlobalId points);
  const delaunay::StarBuilder& builder() const { return *builder_; }
  /// Returns true if a stage with a few per cent more or fewer points has the same builder.
  bool is_usual() const;

  delaunay::StarPass compute(sites::Stage& stage, sites::Wanted wanted) const;
  /// Certifies the stars of the inner sites. Most of these have not changed in the last moves.
  /// @param reach limits which stars may be certified by the stars around them, because the clean-up may have moved
  /// boundary sites into diametral circles of boundary edges
  void certify(sites::Stage& stage, sweep::LemmaReach reach) const;
  /// @brief Computes the stars of all sites. If few stars are uncertain, it uses the empty-circumcircle test; otherwise
  /// it uses the Delaunay lemma for most of them. If triangles are missing at a site, the cap may have been too small
  /// (next to a void), so it is doubled for such sites a few times. If triangles are still missing after that, the
  /// certificate reports it.
  /// @param reach as in certify
  /// @throws GeometryError on all ranks if triangles reach around a periodic container
  void complete(sites::Stage& stage, sweep::LemmaReach reach);

  /// Returns `reach`, or LemmaReach::nowhere if the options forbid that stars are certified by the stars around them.
  sweep::LemmaReach allowed(sweep::LemmaReach reach) const;

private:
  void certify_all(sites::Stage& stage, sweep::LemmaReach reach) const;
  void set_cap(double factor);
  void check_periods(const sites::Stage& stage) const;

  const RunContext& run_;
  GlobalId points_ = 0;   // number of points at the beginning of the stage
  double cap_factor_ = 0; // cap of a star divided by h
  std::unique_ptr<delaunay::StarBuilder> builder_;
};

/// Counts the triangulations of a run, and passes those that MeshOptions::snapshot_interval asks for to the observer.
class Snapshots {
public:
  /// Keeps references to all arguments.
  /// @param observer may be empty: then nothing is shown
  Snapshots(const RunContext& run, const MeshedBoundary& boundary, const StageStars& stars,
            const SnapshotObserver& observer)
      : run_(run), boundary_(boundary), stars_(stars), observer_(observer) {}

  /// Counts a new triangulation, and shows it if it is due. Showing it does not change the run. Collective.
  void take(const sites::Stage& stage);
  /// Returns the number of triangulations so far: one at the start of each stage, and one after each move.
  int triangulations() const { return triangulations_; }
  /// Visits the members that are stored in a checkpoint.
  void visit(StateFields& fields) { fields.field("triangulations", triangulations_); }

private:
  bool is_wanted() const;

  const RunContext& run_;
  const MeshedBoundary& boundary_;
  const StageStars& stars_;
  const SnapshotObserver& observer_;
  int triangulations_ = 0;
};

} // namespace trime::meshing
