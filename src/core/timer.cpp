// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/timer.hpp"

namespace trime {

void TimerTable::add(const std::string& name, double seconds) {
  for (Section& section : sections_)
    if (section.name == name) {
      section.seconds += seconds;
      ++section.calls;
      return;
    }
  sections_.push_back({name, seconds, 1});
}

} // namespace trime
