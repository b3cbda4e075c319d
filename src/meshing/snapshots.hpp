// SPDX-License-Identifier: BSD-3-Clause
// Shows intermediate meshes of a run to the caller.
#pragma once

#include "core/state_fields.hpp"
#include "meshing/meshed_boundary.hpp"
#include "meshing/stage_stars.hpp"
#include "trime/meshing/mesher.hpp"

namespace trime::meshing {

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
