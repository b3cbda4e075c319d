// SPDX-License-Identifier: BSD-3-Clause
// Combines what the ranks have measured and counted in each phase of a run.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/timer.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trime::app {

/// A counter over the ranks.
struct Spread {
  std::int64_t sum = 0, min = 0, max = 0;
};

/// All counters over the ranks.
class CounterSpreads {
public:
  const Spread& operator[](Counter counter) const { return spreads_[static_cast<std::size_t>(counter)]; }
  Spread& operator[](Counter counter) { return spreads_[static_cast<std::size_t>(counter)]; }

private:
  std::array<Spread, counter_count> spreads_{};
};

/// A section of the timers over the ranks.
struct Phase {
  std::string name;
  std::int64_t calls = 0;            ///< number of calls on the rank with most
  double min = 0, mean = 0, max = 0; ///< seconds
  CounterSpreads counters{};
};

/// The combined measurements of the ranks.
struct Measurements {
  std::vector<Phase> phases; ///< sections, then "other": the means add up to the total
  CounterSpreads counters;   ///< counters of the whole run
  double total = 0;          ///< seconds, mean over ranks
  int ranks = 1;
  std::int64_t peak_memory = 0, memory_sum = 0; ///< bytes: largest of a rank, and of all ranks together

  double mean(Counter counter) const { return static_cast<double>(counters[counter].sum) / ranks; }
  /// Largest over mean, 1 where nothing was counted.
  double imbalance(Counter counter) const {
    return counters[counter].sum > 0 ? static_cast<double>(counters[counter].max) / mean(counter) : 1;
  }
  /// Returns the share of a phase in the total, 0 if there was no such phase.
  double share(const std::string& phase) const;
};

/// @note Collective: three calls, however many phases and counters there are.
Measurements gather_measurements(TimerTable& timers, const comm::Communicator& comm);

} // namespace trime::app
