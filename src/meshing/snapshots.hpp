// SPDX-License-Identifier: BSD-3-Clause
// The meshes that a run shows before it is done.
#pragma once

#include "core/state_fields.hpp"
#include "meshing/meshed_boundary.hpp"
#include "meshing/stage_stars.hpp"
#include "trime/meshing/mesher.hpp"

namespace trime::meshing {

/// Counts the triangulations of a run, and shows to the observer those that MeshOptions::snapshot_interval asks for.
class Snapshots {
public:
  /// Keeps the references. @param observer may be empty: then nothing is shown
  Snapshots(const RunContext& run, const MeshedBoundary& boundary, const StageStars& stars,
            const SnapshotObserver& observer)
      : run_(run), boundary_(boundary), stars_(stars), observer_(observer) {}

  /// A triangulation was made. The run goes on as if it had not been shown. Collective.
  void take(const sites::Stage& stage);
  /// The first of each stage, and one for each move.
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
