// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/timer.hpp"

#include <chrono>

namespace trime {
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
