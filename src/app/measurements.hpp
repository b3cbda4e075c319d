// SPDX-License-Identifier: BSD-3-Clause
// Combines the times and counters that the ranks have measured in each phase of a run.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/timer.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trime::app {

/// Sum, minimum and maximum of a counter over all ranks.
struct Spread {
  std::int64_t sum = 0, min = 0, max = 0;
};

/// The sums, minima and maxima of all counters.
class CounterSpreads {
public:
  const Spread& operator[](Counter counter) const { return spreads_[static_cast<std::size_t>(counter)]; }
  Spread& operator[](Counter counter) { return spreads_[static_cast<std::size_t>(counter)]; }

private:
  std::array<Spread, counter_count> spreads_{};
};

/// The times of one section of the timers over all ranks, and its counters.
struct Phase {
  std::string name;
  std::int64_t calls = 0;            ///< number of calls on the rank with the most calls
  double min = 0, mean = 0, max = 0; ///< seconds
  CounterSpreads counters{};
};

/// The combined measurements of all ranks.
struct Measurements {
  std::vector<Phase>
      phases; ///< the sections of the timers, then "other" for the remaining time; the means add up to `total`
  CounterSpreads counters; ///< counters of the whole run
  double total = 0;        ///< seconds, mean over ranks
  int ranks = 1;
  std::int64_t peak_memory = 0, memory_sum = 0; ///< bytes: largest value of one rank, and sum over all ranks

  double mean(Counter counter) const { return static_cast<double>(counters[counter].sum) / ranks; }
  /// Returns the largest value of a rank divided by the mean; 1 if nothing was counted.
  double imbalance(Counter counter) const {
    return counters[counter].sum > 0 ? static_cast<double>(counters[counter].max) / mean(counter) : 1;
  }
  /// Returns the share of a phase in the total time; 0 if there is no such phase.
  double share(const std::string& phase) const;
};

/// Combines the measurements of all ranks.
/// @note Collective: three calls, however many phases and counters there are.
Measurements gather_measurements(TimerTable& timers, const comm::Communicator& comm);

} // namespace trime::app
