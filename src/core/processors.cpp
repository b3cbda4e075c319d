// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/processors.hpp"

#include <omp.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>

namespace trime {
namespace {

constexpr int most_turns = 10000; // then a thread that is late comes when the system lets it

/// Nothing if the system does not tell, as where it has more processors than a set has room for.
std::optional<cpu_set_t> usable_set() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0)
    return std::nullopt;
  return set;
}

} // namespace

std::vector<int> usable_processors() {
  const std::optional<cpu_set_t> set = usable_set();
  const auto all = static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  std::vector<int> processors;
  for (int cpu = 0; cpu < (set ? CPU_SETSIZE : all); ++cpu)
    if (!set || CPU_ISSET(cpu, &*set))
      processors.push_back(cpu);
  return processors;
}

void spread_threads(int threads, int first) {
  const std::optional<cpu_set_t> all = usable_set();
  const std::vector<int> processors = usable_processors();
  if (!all || first + threads > static_cast<int>(processors.size()) || omp_get_proc_bind() != omp_proc_bind_false)
    return;
  std::atomic<int> placed = 0;
#pragma omp parallel num_threads(threads)
  {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processors[static_cast<std::size_t>(first + omp_get_thread_num())], &one);
    if (sched_setaffinity(0, sizeof one, &one) == 0) // the thread moves at once
      sched_setaffinity(0, sizeof *all, &*all);
    ++placed;
    for (int turn = 0; turn < most_turns && placed < omp_get_num_threads(); ++turn)
      sched_yield(); // one that has not run yet may wait for this processor
  }
}

} // namespace trime
