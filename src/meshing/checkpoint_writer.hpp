// SPDX-License-Identifier: BSD-3-Clause
// Collects the state of a run, and passes it to the object that writes its checkpoints.
#pragma once

#include "meshing/checkpoints.hpp"
#include "meshing/run_context.hpp"

#include <functional>

namespace trime::meshing {

/// The moment in a stage at which a checkpoint was taken.
enum class RunPoint {
  moved,   ///< after a move, before the stars at the new places are computed
  relaxed, ///< after the last sorting of the sites in the last stage
};

/// Returns the moment at which a checkpoint was taken.
/// @throws FileError if the checkpoint does not contain it
RunPoint point_of(const SavedRun& saved);

/// Adds the state of the whole run to the state of its sweeps, and writes both.
class CheckpointWriter {
public:
  /// Keeps references to all arguments.
  /// @param checkpoints if null, no checkpoint is written
  /// @param visit_run visits the numbers of the run
  CheckpointWriter(const RunContext& run, Checkpoints* checkpoints, std::function<void(StateFields&)> visit_run)
      : run_(run), checkpoints_(checkpoints), visit_run_(std::move(visit_run)) {}

  /// Returns the CheckpointWish (request) of this rank as an integer.
  int wish() const { return checkpoints_ ? static_cast<int>(checkpoints_->wish()) : 0; }
  /// Returns the common request of all ranks before the clean-up, see Checkpoints. Collective.
  int wish_before_cleanup(bool stands) const {
    return checkpoints_ ? static_cast<int>(checkpoints_->wish_before_cleanup(stands)) : 0;
  }
  /// @brief Writes a checkpoint. Collective.
  /// @param wish the common request of all ranks
  /// @param activity activity of the owned tiles, see SavedTiles
  /// @throws the errors of Checkpoints::write
  void write(RunPoint point, int wish, RunState state, const sites::SiteState& sites,
             std::span<const std::uint64_t> activity) const;

private:
  const RunContext& run_;
  Checkpoints* checkpoints_;
  std::function<void(StateFields&)> visit_run_;
};

} // namespace trime::meshing
