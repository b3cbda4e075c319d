// SPDX-License-Identifier: BSD-3-Clause
// When checkpoints are written, and into which files: by interval, signal, stop file and time limit.
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

/// The arguments of the keeper. @pre all outlive it
struct KeeperContext {
  const comm::Communicator& comm;
  io::MeshFileOptions output; ///< directory, name, and the object that notes temporary files
  SignalRequests& signals;
  TimerTable& timers;
  Log& log;
};

/// @brief Only the clock and files of rank 0 count; the ranks agree on their wish in the reduction of each sweep. If a
/// checkpoint cannot be written, the program warns and the run continues; it ends only where a signal would have ended
/// it.
///
/// The phase says what may be called; calls that change it check it:
/// - sweeping: at first. find, then wish after each sweep, and write if the ranks agree on a wish.
/// - ending: after wish_before_cleanup. write at most once: then a signal or the time limit ends the run at once.
/// - done: after go_to_the_end. Signals have no effect from here on. Only remove_all.
/// A stop that could not be carried out, since its checkpoint was not written, is not wished again by rank 0.
class CheckpointKeeper final : public meshing::Checkpoints {
public:
  /// @param time_limit seconds since the start of the program; 0: none
  CheckpointKeeper(const KeeperContext& context, const CheckpointOptions& options, double time_limit,
                   checkpoint::Origin origin);

  /// @brief The checkpoint to go on from, if any. Of `auto` the newest that is whole; those that are not are warned of.
  /// @param restart a path, `auto`, or empty
  /// @throws FileError on all ranks if the file named cannot be used; ConfigError if it is of another config: says
  /// which key differs. Collective.
  std::optional<meshing::SavedRun> find(const std::string& restart);
  /// From here on the run goes on to its end, whatever signals ask for: to be called before files are written, so that
  /// no rank leaves while others write them. Collective.
  void go_to_the_end();
  /// The mesh is written, and the checkpoints are of no more use. Collective.
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
  std::int64_t number_ = -1; // number of the last checkpoint; -1 if not known yet
  Phase phase_ = Phase::sweeping;
  bool found_stop_file_ = false; // on rank 0; it counts until a checkpoint stops the run
  bool stops_no_more_ = false;   // a stop has failed
  double asked_ = 0, sweep_ = 0, written_ = 0, longest_writing_ = 0,
         looked_ = -1e9; // seconds of rank 0
  std::string reason_;   // reason for the last wish of rank 0
};

} // namespace trime::app
