// SPDX-License-Identifier: BSD-3-Clause
// What a run asks of those who keep its checkpoints.
#pragma once

#include "meshing/run_state.hpp"
#include "sites/site_state.hpp"
#include "trime/core/error.hpp"

#include <cstdint>
#include <span>

namespace trime::meshing {

/// What is wanted at the end of a sweep; where ranks want different things, the last of them counts.
enum class CheckpointWish : int {
  none,
  write, ///< and go on
  stop,  ///< write, then stop
};

/// The run has stopped at a checkpoint, on all ranks together (exit 75).
class StoppedAtCheckpoint : public Error {
public:
  explicit StoppedAtCheckpoint(const std::string& message) : Error(ExitCode::checkpointed, message) {}
};

/// @brief Writes checkpoints, and says when. None of it may change anything about the mesh.
class Checkpoints {
public:
  virtual ~Checkpoints() = default;
  /// What this rank wants. Asked once a sweep, local.
  virtual CheckpointWish wish() = 0;
  /// What all ranks together want before the clean-up, after which no wish is asked for. Collective.
  /// @param stands the run goes on from a checkpoint of this very moment: then none is wanted, or it would never get on
  /// @throws StoppedAtCheckpoint if there is one, and a signal has asked to stop
  virtual CheckpointWish wish_before_cleanup(bool stands) = 0;
  /// @brief Writes one. @param activity of the owned tiles. Collective.
  /// @throws StoppedAtCheckpoint if the wish was to stop, and there is one now; else the run goes on
  /// @throws FileError if there is none, and a signal ends the run
  virtual void write(CheckpointWish wish, const RunState& state, const sites::SiteState& sites,
                     std::span<const std::uint64_t> activity) = 0;
};

} // namespace trime::meshing
