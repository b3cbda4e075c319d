// SPDX-License-Identifier: BSD-3-Clause
// The requests that signals have made: handlers set them, and the run looks at them once per sweep.
#pragma once

#include <atomic>

namespace trime::app {

/// @brief The requests on this rank. All calls are safe in a signal handler. Launchers pass some signals to all ranks
/// and others to one, so the ranks agree on what to do.
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

  /// Sets whether a run that must end may stop at a checkpoint first: only during the sweeps, if checkpoints are
  /// configured.
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
