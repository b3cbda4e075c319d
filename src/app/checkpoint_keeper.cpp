// SPDX-License-Identifier: BSD-3-Clause
#include "app/checkpoint_keeper.hpp"

#include "app/checkpoint_names.hpp"
#include "app/config_difference.hpp"
#include "comm/agree.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

namespace trime::app {
namespace {

using meshing::CheckpointWish;

constexpr double look_interval = 1; // [s] a stop file is looked for so often: file systems of many nodes are slow

bool exists(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0;
}

} // namespace

CheckpointKeeper::CheckpointKeeper(const KeeperContext& context, const CheckpointOptions& options, double time_limit,
                                   checkpoint::Origin origin)
    : context_(context), options_(options), time_limit_(time_limit), origin_(std::move(origin)) {}

std::string CheckpointKeeper::path(std::int64_t number) const {
  return checkpoint_path(context_.output, static_cast<int>(number % options_.keep) + 1);
}

/// Checkpoints of this name, as rank 0 finds them; an earlier run may have kept more. What cannot be read comes first:
/// it may have been the newest.
std::vector<std::string> CheckpointKeeper::newest_first() const {
  std::vector<std::pair<std::int64_t, std::string>> found;
  for (const std::string& file : checkpoint_files(context_.output)) {
    const std::int64_t number = checkpoint::checkpoint_number(file);
    found.emplace_back(number < 0 ? std::numeric_limits<std::int64_t>::max() : number, file);
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::string> files;
  for (const auto& [number, file] : found)
    files.push_back(file);
  return files;
}

/// On all ranks together.
checkpoint::Found CheckpointKeeper::named(const std::string& file) const {
  try {
    return checkpoint::read_checkpoint(file, context_.comm);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}; '--restart auto' takes the newest complete checkpoint {}, and starts from the "
                                "beginning if there is no checkpoint",
                                error.what(), context_.output.path(".checkpoint-K.h5")));
  }
}

std::optional<meshing::SavedRun> CheckpointKeeper::find(const std::string& restart) {
  if (restart.empty())
    return std::nullopt;
  if (restart != "auto")
    return checked(named(restart), restart);
  std::string list;
  comm::run_agreed(context_.comm, [&] {
    if (context_.comm.is_root())
      for (const std::string& file : newest_first())
        list += file + "\n";
  });
  list = context_.comm.broadcast(list);
  for (std::size_t at = 0, end; at < list.size(); at = end + 1) {
    end = list.find('\n', at);
    const std::string file = list.substr(at, end - at);
    try {
      return checked(checkpoint::read_checkpoint(file, context_.comm), file);
    } catch (const FileError& error) { // on all ranks together
      context_.log.warning("{}; this checkpoint is ignored", error.what());
    }
  }
  context_.log.summary("restart: there is no checkpoint of {}; the run starts from the beginning",
                       context_.output.path(""));
  return std::nullopt;
}

/// Throws on all ranks unless the checkpoint belongs to this config.
meshing::SavedRun CheckpointKeeper::checked(checkpoint::Found found, const std::string& file) {
  if (const std::vector<std::string> keys = differing_keys(found.title.origin.config, origin_.config); !keys.empty())
    throw ConfigError(fmt::format(
        "{} comes from a run with another config: {}; start from the beginning without --restart, or use that config",
        file, fmt::join(keys, "; ")));
  if (found.title.origin.program != origin_.program)
    throw FileError(fmt::format(
        "{} was written by {}, and this is {}: expected the same program, since another one may make a different mesh",
        file, found.title.origin.program, origin_.program));
  number_ = found.title.number;
  context_.log.summary("restart: from {}", file);
  return std::move(found.run);
}

void CheckpointKeeper::go_to_the_end() {
  phase_ = Phase::done;
  alarm(0);
  context_.signals.set_last(false);
  context_.comm.barrier(); // a rank that has left before keeps the others from writing
}

void CheckpointKeeper::remove_all() {
  TRIME_ASSERT(phase_ == Phase::done, "checkpoints may be removed only after go_to_the_end()");
  alarm(0);
  context_.signals.set_last(false);
  if (found_stop_file_)
    remove_stop_file(); // found when nothing was left to stop
  if (number_ < 0)      // this run has neither read nor written any
    return;
  if (context_.comm.is_root())
    for (const std::string& file : checkpoint_files(context_.output))
      unlink(file.c_str()); // a mesh that is written needs none
}

/// The last checkpoint stands: a signal ends the run at once from now on, and so does the time limit.
void CheckpointKeeper::end_in_time() {
  context_.signals.set_last(true);
  if (time_limit_ > 0)
    alarm(static_cast<unsigned>(std::fmax(1, std::ceil(time_limit_ - context_.timers.total()))));
}

// --- when ------------------------------------------------------------------------------------------------------------

/// Once found it counts until a checkpoint stops the run: the wish of the last sweep of a stage is not carried out.
bool CheckpointKeeper::finds_stop_file() {
  if (found_stop_file_)
    return true;
  const double now = context_.timers.total();
  if (options_.stop_file.empty() || now < looked_ + look_interval)
    return false;
  looked_ = now;
  return found_stop_file_ = exists(options_.stop_file);
}

CheckpointWish CheckpointKeeper::wish_of_root() {
  const double now = context_.timers.total();
  sweep_ = asked_ > 0 ? std::fmax(now - asked_, sweep_ / 2) : 0; // the start of a stage is forgotten after a while
  asked_ = now;
  if (!stops_no_more_ && time_limit_ > 0 && now + 2 * sweep_ + longest_writing_ >= time_limit_) {
    reason_ = "the time limit is near";
    return CheckpointWish::stop;
  }
  if (!stops_no_more_ && finds_stop_file()) {
    reason_ = "found " + options_.stop_file;
    return CheckpointWish::stop;
  }
  return options_.interval > 0 && now - written_ >= options_.interval ? CheckpointWish::write : CheckpointWish::none;
}

CheckpointWish CheckpointKeeper::wish() {
  TRIME_ASSERT(phase_ == Phase::sweeping, "wish() may be called only during the sweeps");
  SignalRequests& signals = context_.signals;
  signals.set_stops_in_order(is_configured());
  const CheckpointWish of_root = context_.comm.is_root() ? wish_of_root() : CheckpointWish::none;
  if (signals.asks_to_stop())
    return CheckpointWish::stop;
  return std::max(of_root, signals.asks_to_write() ? CheckpointWish::write : CheckpointWish::none);
}

/// With an interval or a limit, one is written at any rate: the clean-up may take long.
CheckpointWish CheckpointKeeper::wish_before_cleanup(bool stands) {
  looked_ = -look_interval; // the last look
  CheckpointWish mine = wish();
  if (is_configured())
    mine = std::max(mine, CheckpointWish::write);
  const auto all = static_cast<CheckpointWish>(context_.comm.max(std::int64_t{static_cast<int>(mine)}));
  phase_ = Phase::ending;
  if (stands) {
    end_in_time();
    if (context_.comm.max(std::int64_t{context_.signals.asks_to_stop()}) > 0)
      stop_at(path(number_));
    return CheckpointWish::none;
  }
  if (all == CheckpointWish::none)
    context_.signals.set_last(false);
  return all;
}

// --- writing ---------------------------------------------------------------------------------------------------------

/// The first one of a run comes after those that older runs have left.
void CheckpointKeeper::set_number() {
  std::int64_t newest = 0;
  comm::run_agreed(context_.comm, [&] {
    if (!context_.comm.is_root())
      return;
    std::error_code error;
    std::filesystem::create_directories(context_.output.directory, error); // otherwise writing will report the problem
    for (const std::string& file : newest_first())
      newest = std::max(newest, checkpoint::checkpoint_number(file));
  });
  number_ = context_.comm.max(newest);
}

/// On all ranks together: a run that was asked to stop goes on, since a mesh is worth more than an end without one.
void CheckpointKeeper::tell_unwritten(CheckpointWish wish, const std::string& reason) {
  SignalRequests& signals = context_.signals;
  const char* advice = "free some space in output.directory, or make it writable";
  if (wish == CheckpointWish::stop && context_.comm.max(std::int64_t{signals.asks_to_end()}) > 0)
    throw FileError(fmt::format("checkpoint failed: {}; a signal ends the run, and its work is lost. Next time {}, or "
                                "send USR1: if a checkpoint fails then, the run continues",
                                reason, advice));
  signals.forget_writing();
  if (phase_ == Phase::ending)
    signals.set_last(false);
  if (wish != CheckpointWish::stop) {
    context_.log.warning("checkpoint failed: {}; the run continues; {}", reason, advice);
    return;
  }
  signals.forget_stopping();
  stops_no_more_ = true; // else each sweep would try again, and fail
  context_.log.warning("checkpoint failed: {}; the run does not stop{}, but continues to its end. To stop it at a "
                       "checkpoint, {}, then send USR1",
                       reason, reason_.empty() ? "" : " (" + reason_ + ")", advice);
  reason_.clear();
}

void CheckpointKeeper::write(CheckpointWish wish, const meshing::RunState& state, const sites::SiteState& sites,
                             std::span<const std::uint64_t> activity) {
  TRIME_ASSERT(phase_ != Phase::done, "no checkpoint may be written after go_to_the_end()");
  const double begin = context_.timers.total();
  if (number_ < 0)
    set_number();
  const std::string file = path(number_ + 1);
  try {
    checkpoint::write_checkpoint(file, context_.output.run_files, {origin_, number_ + 1}, state, sites, activity);
  } catch (const FileError& error) { // on all ranks together
    written_ = context_.timers.total();
    tell_unwritten(wish, error.what());
    return;
  }
  ++number_;
  context_.signals.forget_writing();
  written_ = context_.timers.total();
  longest_writing_ = std::max(longest_writing_, written_ - begin);
  context_.log.info("checkpoint: {}, {:.2g} s", file, written_ - begin);
  if (wish != CheckpointWish::stop) {
    if (phase_ == Phase::sweeping)
      return;
    end_in_time();
    if (context_.comm.max(std::int64_t{context_.signals.asks_to_stop()}) == 0) // since the wish, and nobody looks again
      return;
  }
  stop_at(file);
}

/// Removes the file, so that the next run does not stop because of it.
void CheckpointKeeper::remove_stop_file() const {
  if (unlink(options_.stop_file.c_str()) != 0 && errno != ENOENT)
    context_.log.warning("cannot remove the stop file {}: {}; remove it, otherwise it stops the next run, too",
                         options_.stop_file, std::strerror(errno));
}

/// On all ranks together.
void CheckpointKeeper::stop_at(const std::string& file) const {
  if (context_.comm.is_root() && !options_.stop_file.empty())
    remove_stop_file();
  throw meshing::StoppedAtCheckpoint(fmt::format("stopped at the checkpoint {}{}; continue with --restart {}", file,
                                                 reason_.empty() ? "" : " (" + reason_ + ")", file));
}

} // namespace trime::app
