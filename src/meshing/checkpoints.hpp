// SPDX-License-Identifier: BSD-3-Clause
// The interface through which a run has its checkpoints kept, and the state that a run needs to continue as if nothing
// had happened, except its sites. Whatever follows from the config alone is computed again: sizes, boundary, layout.
#pragma once

#include "core/state_fields.hpp"
#include "sites/site_state.hpp"
#include "trime/core/error.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::meshing {

/// State that is the same on every rank.
struct RunState {
  StateNumbers numbers; ///< numbers of the classes that have a function visit()
  std::vector<sweep::SweepRecord> history;
};

/// A run that was read from a checkpoint. All members are the same on every rank, and so are the sites that `load`
/// gives for the same arguments.
struct SavedRun {
  RunState state;
  sites::SavedTiles tiles;
  sites::SiteLoader load;
};

/// What a rank wants at the end of a sweep. If ranks have different wishes, the last of them in this list counts.
enum class CheckpointWish : int {
  none,
  write, ///< write, then continue
  stop,  ///< write, then stop
};

/// Thrown on all ranks together when the run has stopped at a checkpoint (exit code 75).
class StoppedAtCheckpoint : public Error {
public:
  explicit StoppedAtCheckpoint(const std::string& message) : Error(ExitCode::checkpointed, message) {}
};

/// @brief Decides when checkpoints are written, and writes them. It must not change the mesh.
class Checkpoints {
public:
  virtual ~Checkpoints() = default;
  /// Returns the wish of this rank. Each rank calls it once per sweep.
  virtual CheckpointWish wish() = 0;
  /// Returns the common wish of all ranks before the clean-up; it is the last question for a wish. Collective.
  /// @param stands true if the run has just been restarted from a checkpoint of this moment; then none is written, or
  /// the run would never get beyond it
  /// @throws StoppedAtCheckpoint if there is a checkpoint, and a signal has asked to stop
  virtual CheckpointWish wish_before_cleanup(bool stands) = 0;
  /// @brief Writes a checkpoint. Collective. @param activity see SavedTiles, of the owned tiles
  /// @throws StoppedAtCheckpoint if the wish was to stop and the checkpoint was written; otherwise the run continues
  /// @throws FileError if there is no checkpoint, and a signal ends the run
  virtual void write(CheckpointWish wish, const RunState& state, const sites::SiteState& sites,
                     std::span<const std::uint64_t> activity) = 0;
};

} // namespace trime::meshing
