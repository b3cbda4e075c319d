// SPDX-License-Identifier: BSD-3-Clause
// Decides when checkpoints are written, and into which files: by interval, signal, stop file and time limit.
#pragma once

#include "app/options.hpp"
#include "app/signal_requests.hpp"
#include "checkpoint/checkpoint_file.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/io/mesh_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace trime::app {

/// The objects that CheckpointKeeper uses.
/// @pre all references outlive the keeper
struct KeeperContext {
  const comm::Communicator& comm;
  io::MeshFileOptions
      output; ///< directory and name of the files, and the object that keeps the names of temporary files
  SignalRequests& signals;
  TimerTable& timers;
  Log& log;
};

/// @brief Writes the checkpoints of a run. Only the clock and files of rank 0 count; the ranks agree on a request in
/// the reduction of each sweep. If a checkpoint cannot be written, the program warns and the run continues, unless a
/// signal has asked it to end.
///
/// The member phase_ says which calls are allowed, and each call checks it:
/// * sweeping: the first phase. Call find, then wish after each sweep, and write if the ranks agree on a request.
/// * ending: begins with wish_before_cleanup. Call write at most once; afterwards a signal or the time limit ends the
///   run at once.
/// * done: begins with go_to_the_end. Signals have no effect. Only remove_all may be called.
/// If a checkpoint at which the run should stop cannot be written, rank 0 does not ask again to stop there.
class CheckpointKeeper final : public meshing::Checkpoints {
public:
  /// @param time_limit seconds since the start of the program; 0: no limit
  CheckpointKeeper(const KeeperContext& context, const CheckpointOptions& options, double time_limit,
                   checkpoint::Origin origin);

  /// @brief Returns the checkpoint from which the run continues, if there is one. For `auto` this is the newest
  /// complete checkpoint; incomplete ones give a warning.
  /// @param restart a path, `auto`, or empty for no checkpoint
  /// @throws FileError on all ranks if the named file cannot be used; ConfigError if the checkpoint belongs to another
  /// config, with the key that differs
  /// @note Collective.
  std::optional<meshing::SavedRun> find(const std::string& restart);
  /// From now on the run goes on to its end, regardless of signals. Must be called before files are written, so that no
  /// rank leaves while other ranks write. Collective.
  void go_to_the_end();
  /// Removes all checkpoints of the run, which are not needed once the mesh is written. Collective.
  void remove_all();

  meshing::CheckpointWish wish() override;
  meshing::CheckpointWish wish_before_cleanup(bool stands) override;
  void write(meshing::CheckpointWish wish, const meshing::RunState& state, const sites::SiteState& sites,
             std::span<const std::uint64_t> activity) override;

private:
  enum class Phase { sweeping, ending, done };

  bool is_configured() const { return options_.interval > 0 || time_limit_ > 0 || !options_.stop_file.empty(); }
  meshing::CheckpointWish wish_of_root();
  bool finds_stop_file();
  std::string path(std::int64_t number) const;
  std::vector<std::string> newest_first() const;
  checkpoint::Found named(const std::string& file) const;
  meshing::SavedRun checked(checkpoint::Found found, const std::string& file);
  void set_number();
  void tell_unwritten(meshing::CheckpointWish wish, const std::string& reason);
  void end_in_time();
  void remove_stop_file() const;
  [[noreturn]] void stop_at(const std::string& file) const;

  const KeeperContext context_;
  const CheckpointOptions options_;
  const double time_limit_;
  const checkpoint::Origin origin_;
  std::int64_t number_ = -1; // number of the last checkpoint; -1 until it is known
  Phase phase_ = Phase::sweeping;
  bool found_stop_file_ = false; // whether rank 0 has found the stop file; stays true until a checkpoint stops the run
  bool stops_no_more_ = false;   // true after a checkpoint at which the run should stop could not be written
  double asked_ = 0, sweep_ = 0, written_ = 0, longest_writing_ = 0,
         looked_ = -1e9; // times in seconds on rank 0
  std::string reason_;   // reason for the last request of rank 0
};

} // namespace trime::app
