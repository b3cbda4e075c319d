// SPDX-License-Identifier: BSD-3-Clause
// Holds the requests that signals have made: signal handlers set them, and the run reads them once per sweep.
#pragma once

#include <atomic>

namespace trime::app {

/// @brief The requests on this rank. All calls are safe in a signal handler. Launchers pass some signals to all ranks
/// and others to one rank only, so the ranks afterwards agree on what to do.
class SignalRequests {
public:
  void ask_to_write() noexcept { write_ = true; }
  void ask_to_stop() noexcept { stop_ = true; }
  /// Notes a signal that would normally end the program: the run must stop, with a checkpoint or without.
  void ask_to_end() noexcept {
    end_ = true;
    stop_ = true;
  }
  bool asks_to_write() const noexcept { return write_; }
  bool asks_to_stop() const noexcept { return stop_; }
  bool asks_to_end() const noexcept { return end_; }
  /// Notes that the requested checkpoint is written.
  void forget_writing() noexcept { write_ = false; }
  /// Withdraws the request to stop, because no checkpoint could be written and the run goes on. If a signal to end the
  /// program has arrived meanwhile, the request stays.
  void forget_stopping() noexcept {
    stop_ = false;
    if (end_)
      stop_ = true;
  }

  /// Sets whether a run that must end may first write a checkpoint. A run can write such a checkpoint only during the
  /// sweeps, and only if checkpoints are configured.
  void set_stops_in_order(bool stops) noexcept { stops_in_order_ = stops; }
  bool stops_in_order() const noexcept { return stops_in_order_; }
  /// Notes that no further checkpoint will be written.
  /// @param stands whether there is a checkpoint of this part of the run
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
