// SPDX-License-Identifier: BSD-3-Clause
// Hands the state of a run to those who keep its checkpoints.
#pragma once

#include "meshing/checkpoints.hpp"
#include "meshing/run_context.hpp"

#include <functional>

namespace trime::meshing {

/// Where in a stage a checkpoint was taken.
enum class RunPoint {
  moved,   ///< after a move, before what is done at the new places
  relaxed, ///< after the last sorting of the last stage
};

/// @throws FileError as StateFields
RunPoint point_of(const SavedRun& saved);

/// Adds what the run as a whole must keep to the state of its sweeps.
class CheckpointWriter {
public:
  /// @param checkpoints null: none are written @param visit_run shows the numbers of the run. Keeps all.
  CheckpointWriter(const RunContext& run, Checkpoints* checkpoints, std::function<void(StateFields&)> visit_run)
      : run_(run), checkpoints_(checkpoints), visit_run_(std::move(visit_run)) {}

  /// Returns the wish of this rank: a CheckpointWish.
  int wish() const { return checkpoints_ ? static_cast<int>(checkpoints_->wish()) : 0; }
  /// Returns the common wish of all ranks before the clean-up, see Checkpoints. Collective.
  int wish_before_cleanup(bool stands) const {
    return checkpoints_ ? static_cast<int>(checkpoints_->wish_before_cleanup(stands)) : 0;
  }
  /// @brief Writes one. @param wish of all ranks @param activity of the owned tiles. Collective.
  /// @throws as Checkpoints::write
  void write(RunPoint point, int wish, RunState state, const sites::SiteState& sites,
             std::span<const std::uint64_t> activity) const;

private:
  const RunContext& run_;
  Checkpoints* checkpoints_;
  std::function<void(StateFields&)> visit_run_;
};

} // namespace trime::meshing
