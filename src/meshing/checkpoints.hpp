// SPDX-License-Identifier: BSD-3-Clause
// The interface through which a run has its checkpoints kept.
#pragma once

#include "meshing/run_state.hpp"
#include "sites/site_state.hpp"
#include "trime/core/error.hpp"

#include <cstdint>
#include <span>

namespace trime::meshing {

/// The wish at the end of a sweep. If ranks have different wishes, the last one in this list counts.
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
  /// Returns the wish of this rank. Called once per sweep; local.
  virtual CheckpointWish wish() = 0;
  /// Returns the common wish of all ranks before the clean-up; after that nobody asks for wishes. Collective.
  /// @param stands the run goes on from a checkpoint of this very moment: then none is wanted, or it would never get on
  /// @throws StoppedAtCheckpoint if there is one, and a signal has asked to stop
  virtual CheckpointWish wish_before_cleanup(bool stands) = 0;
  /// @brief Writes one. @param activity of the owned tiles. Collective.
  /// @throws StoppedAtCheckpoint if the wish was to stop, and there is one now; else the run goes on
  /// @throws FileError if there is no checkpoint, and a signal ends the run
  virtual void write(CheckpointWish wish, const RunState& state, const sites::SiteState& sites,
                     std::span<const std::uint64_t> activity) = 0;
};

} // namespace trime::meshing
