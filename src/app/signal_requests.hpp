// SPDX-License-Identifier: BSD-3-Clause
// What signals have asked of a run: set by handlers, looked at once a sweep.
#pragma once

#include <atomic>

namespace trime::app {

/// @brief Of this rank. All calls are safe in a signal handler. Launchers hand some signals on to all ranks, others to
/// one: what the ranks do about them they agree on.
class SignalRequests {
public:
  void ask_to_write() noexcept { write_ = true; }
  void ask_to_stop() noexcept { stop_ = true; }
  /// By a signal that would end the program: it stops with a checkpoint or without.
  void ask_to_end() noexcept {
    end_ = true;
    stop_ = true;
  }
  bool asks_to_write() const noexcept { return write_; }
  bool asks_to_stop() const noexcept { return stop_; }
  bool asks_to_end() const noexcept { return end_; }
  /// A checkpoint is written.
  void forget_writing() noexcept { write_ = false; }
  /// None could be written, and the run goes on; not if a signal that ends it has come meanwhile.
  void forget_stopping() noexcept {
    stop_ = false;
    if (end_)
      stop_ = true;
  }

  /// May a run that is told to end stop at a checkpoint first? Only during the sweeps, if checkpoints are configured.
  void set_stops_in_order(bool stops) noexcept { stops_in_order_ = stops; }
  bool stops_in_order() const noexcept { return stops_in_order_; }
  /// No further checkpoint will be written. @param stands there is one for this part of the run
  void set_last(bool stands) noexcept {
    no_more_ = true;
    stands_ = stands;
    stops_in_order_ = false;
  }
  bool writes_no_more() const noexcept { return no_more_; }
  bool last_stands() const noexcept { return stands_; }

private:
  std::atomic<bool> write_{false}, stop_{false}, end_{false}, stops_in_order_{false}, no_more_{false}, stands_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

} // namespace trime::app
