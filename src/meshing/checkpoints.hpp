// SPDX-License-Identifier: BSD-3-Clause
// The interface through which a run writes its checkpoints, and the state from which a run continues without a change
// of its result. Checkpoints contain this state and the sites; sizes, boundary and layout follow from the config, and
// are computed again.
#pragma once

#include "core/state_fields.hpp"
#include "sites/site_state.hpp"
#include "trime/core/error.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::meshing {

/// The part of the state that is the same on every rank.
struct RunState {
  StateNumbers numbers; ///< numbers of all classes that have a function visit()
  std::vector<sweep::SweepRecord> history;
};

/// A run that was read from a checkpoint. All members are the same on every rank. For the same arguments, `load`
/// returns the same sites on every rank.
struct SavedRun {
  RunState state;
  sites::SavedTiles tiles;
  sites::SiteLoader load;
};

/// Names the request of a rank at the end of a sweep. If ranks have different requests, the one latest in this list
/// counts.
enum class CheckpointWish : int {
  none,
  write, ///< write a checkpoint, then continue
  stop,  ///< write a checkpoint, then stop
};

/// Thrown on all ranks together when the run has stopped at a checkpoint (exit code 75).
class StoppedAtCheckpoint : public Error {
public:
  explicit StoppedAtCheckpoint(const std::string& message) : Error(ExitCode::checkpointed, message) {}
};

/// @brief Decides when checkpoints are written, and writes them. A class that implements this interface must not change
/// the mesh.
class Checkpoints {
public:
  virtual ~Checkpoints() = default;
  /// Returns the request of this rank. Each rank calls it once per sweep.
  virtual CheckpointWish wish() = 0;
  /// Returns the common request of all ranks before the clean-up, after which no checkpoint can be requested.
  /// Collective.
  /// @param stands true if the run has just been restarted from a checkpoint of this moment. Then none is written,
  /// because the run would stop here at each restart
  /// @throws StoppedAtCheckpoint if a checkpoint of this moment exists, and a signal has asked to stop
  virtual CheckpointWish wish_before_cleanup(bool stands) = 0;
  /// @brief Writes a checkpoint. Collective.
  /// @param activity activity of the owned tiles, see SavedTiles
  /// @throws StoppedAtCheckpoint if the checkpoint was written and the request was to stop; otherwise the run continues
  /// @throws FileError if the checkpoint could not be written, and a signal ends the run
  virtual void write(CheckpointWish wish, const RunState& state, const sites::SiteState& sites,
                     std::span<const std::uint64_t> activity) = 0;
};

} // namespace trime::meshing
