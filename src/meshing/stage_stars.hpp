// SPDX-License-Identifier: BSD-3-Clause
// The stars of the sites of a stage, and the meshes that a run shows before it is done.
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

/// @brief Builds, certifies and completes stars. Owns the cap: the largest circumradius of the first search for
/// triangles. All calls are collective, except begin_stage.
class StageStars {
public:
  explicit StageStars(const RunContext& run) : run_(run) {}

  /// @param points points of the stage, over all ranks
  void begin_stage(GlobalId points);
  const delaunay::StarBuilder& builder() const { return *builder_; }

  delaunay::StarPass compute(sites::Stage& stage, sites::Wanted wanted) const;
  /// Certifies the stars of the inner sites. Most of them have not changed in the last moves.
  /// @param reach limits the sites whose stars may certify a star, because the clean-up may have moved boundary sites
  /// into discs of chords
  void certify(sites::Stage& stage, sweep::LemmaReach reach) const;
  /// @brief Computes the stars of all sites. If few are uncertain, it uses the empty-circumcircle test, otherwise the
  /// lemma for most of them. If a fan is incomplete, the cap may have been too low (next to a void), so it is doubled
  /// for these sites a few times. The certificate finds fans that are still incomplete. @param reach as in certify
  /// @throws GeometryError on all ranks if triangles reach around a periodic container
  void complete(sites::Stage& stage, sweep::LemmaReach reach);

  /// Returns `reach`, or LemmaReach::nowhere if the options forbid that stars certify each other.
  sweep::LemmaReach allowed(sweep::LemmaReach reach) const;

private:
  void certify_all(sites::Stage& stage, sweep::LemmaReach reach) const;
  void set_cap(double factor);
  void check_periods(const sites::Stage& stage) const;

  const RunContext& run_;
  GlobalId points_ = 0;   // number at the beginning of the stage
  double cap_factor_ = 0; // cap over h
  std::unique_ptr<delaunay::StarBuilder> builder_;
};

/// Counts the triangulations of a run, and shows to the observer those that MeshOptions::snapshot_interval asks for.
class Snapshots {
public:
  /// Keeps references to all arguments. @param observer may be empty: then nothing is shown
  Snapshots(const RunContext& run, const MeshedBoundary& boundary, const StageStars& stars,
            const SnapshotObserver& observer)
      : run_(run), boundary_(boundary), stars_(stars), observer_(observer) {}

  /// Counts a new triangulation, and shows it if it is due. The run continues as if it had not been shown. Collective.
  void take(const sites::Stage& stage);
  /// Number of triangulations so far: the first of each stage, and one for each move.
  int triangulations() const { return triangulations_; }
  /// Visits the members that a checkpoint keeps.
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
