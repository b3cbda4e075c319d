// SPDX-License-Identifier: BSD-3-Clause
#include "app/measurements.hpp"

#include "app/machine.hpp"

#include <algorithm>
#include <cmath>

namespace trime::app {
namespace {

constexpr double microsecond = 1e-6;

/// Values of this rank that become sums and extremes over all ranks in one reduction. Values are read back in the order
/// in which they were put in.
class Reduction {
public:
  void add_sum(std::int64_t value) { sums_.push_back(value); }
  void add_largest(double value) { largest_.push_back(value); }
  void add_spread(std::int64_t value) {
    add_sum(value);
    add_largest(static_cast<double>(value)); // exact below 2^53
    add_largest(static_cast<double>(-value));
  }
  void reduce(const comm::Communicator& comm) { comm.sum_and_max(sums_, largest_); }

  std::int64_t sum() { return sums_[next_sum_++]; }
  double largest() { return largest_[next_largest_++]; }
  Spread spread() {
    Spread spread{sum(), 0, std::llround(largest())};
    spread.min = -std::llround(largest());
    return spread;
  }

private:
  std::vector<std::int64_t> sums_;
  std::vector<double> largest_;
  std::size_t next_sum_ = 0, next_largest_ = 0;
};

void add(const CounterValues& counts, Reduction& reduction) {
  for (std::size_t k = 0; k < counter_count; ++k)
    reduction.add_spread(counts[static_cast<Counter>(k)]);
}

CounterSpreads read_counters(Reduction& reduction) {
  CounterSpreads counters;
  for (std::size_t k = 0; k < counter_count; ++k)
    counters[static_cast<Counter>(k)] = reduction.spread();
  return counters;
}

void add(const TimerTable::Section& own, Reduction& reduction) {
  reduction.add_sum(std::llround(own.seconds / microsecond));
  reduction.add_largest(static_cast<double>(own.calls));
  reduction.add_largest(own.seconds);
  reduction.add_largest(-own.seconds);
  add(own.counts, reduction);
}

Phase read_phase(const std::string& name, int ranks, Reduction& reduction) {
  Phase phase{name};
  phase.mean = static_cast<double>(reduction.sum()) * microsecond / ranks;
  phase.calls = std::llround(reduction.largest());
  phase.max = reduction.largest();
  phase.min = -reduction.largest();
  phase.counters = read_counters(reduction);
  return phase;
}

/// The sections of rank 0, as this rank has them, and the rest.
std::vector<TimerTable::Section> agreed_sections(TimerTable& timers, const comm::Communicator& comm) {
  std::string names;
  for (const TimerTable::Section& section : timers.sections())
    names += section.name + "\n";
  names = comm.broadcast(std::move(names));
  std::vector<TimerTable::Section> agreed;
  for (std::size_t at = 0, end = 0; at < names.size(); at = end + 1) {
    end = names.find('\n', at);
    agreed.push_back({names.substr(at, end - at)});
  }
  TimerTable::Section rest{"other", timers.total(), 1, timers.outside()};
  for (const TimerTable::Section& section : timers.sections()) {
    const auto known = std::ranges::find(agreed, section.name, &TimerTable::Section::name);
    if (known == agreed.end()) {
      rest.counts += section.counts;
      continue;
    }
    *known = section;
    rest.seconds -= section.seconds;
  }
  agreed.push_back(std::move(rest));
  return agreed;
}

} // namespace

double Measurements::share(const std::string& phase) const {
  const auto found = std::ranges::find(phases, phase, &Phase::name);
  return found == phases.end() || total <= 0 ? 0 : found->mean / total;
}

Measurements gather_measurements(TimerTable& timers, const comm::Communicator& comm) {
  const std::vector<TimerTable::Section> sections = agreed_sections(timers, comm);
  Reduction reduction;
  CounterValues whole;
  for (const TimerTable::Section& section : sections) {
    add(section, reduction);
    whole += section.counts;
  }
  add(whole, reduction);
  reduction.add_spread(comm::is_simulated() ? peak_memory() / comm.size() : peak_memory()); // or of all ranks together
  reduction.reduce(comm);
  Measurements measured;
  measured.ranks = comm.size();
  for (const TimerTable::Section& section : sections) {
    measured.phases.push_back(read_phase(section.name, comm.size(), reduction));
    measured.total += measured.phases.back().mean;
  }
  measured.counters = read_counters(reduction);
  const Spread memory = reduction.spread();
  measured.peak_memory = memory.max;
  measured.memory_sum = memory.sum;
  return measured;
}

} // namespace trime::app
