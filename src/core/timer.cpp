// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/timer.hpp"

#include <algorithm>
#include <chrono>

namespace trime {
namespace {

enum class Kind { sum, peak };

struct Description {
  CounterName name;
  Kind kind;
};

/// In the order of the enum.
constexpr std::array<Description, counter_count> descriptions{{
    {{"messages", "messages"}, Kind::sum},
    {{"bytes", "bytes"}, Kind::sum},
    {{"collectives", "calls"}, Kind::sum},
    {{"wait_ns", "ns"}, Kind::sum},
    {{"neighbours", "ranks"}, Kind::peak},
    {{"sites_started", "sites"}, Kind::sum},
    {{"points", "sites"}, Kind::peak},
    {{"densest_tile", "sites"}, Kind::peak},
    {{"ghosts", "sites"}, Kind::peak},
    {{"sites_migrated", "sites"}, Kind::sum},
    {{"passes", "passes"}, Kind::sum},
    {{"sites_swept", "sites"}, Kind::sum},
    {{"sites_slept", "sites"}, Kind::sum},
    {{"sites_moved", "sites"}, Kind::sum},
    {{"stars_by_emptiness", "stars"}, Kind::sum},
    {{"stars_rebuilt", "stars"}, Kind::sum},
    {{"fetch_rounds", "rounds"}, Kind::sum},
    {{"cleanup_rounds", "rounds"}, Kind::sum},
    {{"patches", "patches"}, Kind::sum},
    {{"sites_extracted", "sites"}, Kind::sum},
    {{"grid_bytes", "bytes"}, Kind::peak},
    {{"boundary_bytes", "bytes"}, Kind::peak},
    {{"size_bytes", "bytes"}, Kind::peak},
    {{"rank_bytes", "bytes"}, Kind::peak},
}};

} // namespace

CounterName name_of(Counter counter) {
  return descriptions[static_cast<std::size_t>(counter)].name;
}

bool is_peak(Counter counter) {
  return descriptions[static_cast<std::size_t>(counter)].kind == Kind::peak;
}

CounterValues& CounterValues::operator+=(const CounterValues& other) {
  for (std::size_t k = 0; k < counter_count; ++k)
    values_[k] =
        is_peak(static_cast<Counter>(k)) ? std::max(values_[k], other.values_[k]) : values_[k] + other.values_[k];
  return *this;
}

void Counters::add_message(int to, std::int64_t bytes) {
  add(Counter::messages);
  add(Counter::bytes, bytes);
  if (neighbours_.empty() || neighbours_.back() < to) {
    neighbours_.push_back(to);
    return;
  }
  const auto at = std::lower_bound(neighbours_.begin(), neighbours_.end(), to);
  if (*at != to)
    neighbours_.insert(at, to);
}

CounterValues Counters::take() {
  note(Counter::neighbours, static_cast<std::int64_t>(neighbours_.size()));
  neighbours_.clear();
  CounterValues taken;
  std::swap(taken, values_);
  return taken;
}

namespace {

double steady_seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

double (*clock_in_use)() = steady_seconds;

} // namespace

double wall_seconds() {
  return clock_in_use();
}

void set_wall_clock(double (*seconds)()) {
  clock_in_use = seconds ? seconds : steady_seconds;
}

void TimerTable::add(const std::string& name, double seconds, const CounterValues& counts) {
  for (Section& section : sections_)
    if (section.name == name) {
      section.seconds += seconds;
      ++section.calls;
      section.counts += counts;
      return;
    }
  sections_.push_back({name, seconds, 1, counts});
}

} // namespace trime
