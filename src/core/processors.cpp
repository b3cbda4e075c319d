// SPDX-License-Identifier: BSD-3-Clause
#include "core/processors.hpp"

#include "core/thread_team.hpp"

#include <omp.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>

namespace trime {
namespace {

constexpr int most_processors = 1 << 20; // that are looked for
constexpr int most_naps = 200;           // then a thread that is late comes when the system lets it

/// A set of processors with room for as many as the system has.
class ProcessorSet {
public:
  explicit ProcessorSet(int room) : room_(room), bytes_(CPU_ALLOC_SIZE(room)), set_(CPU_ALLOC(room)) {
    if (set_)
      CPU_ZERO_S(bytes_, set_.get());
  }
  /// Gets the mask of the calling thread. @return false if the system does not know it, or has more processors
  bool read() { return set_ && sched_getaffinity(0, bytes_, set_.get()) == 0; }
  /// Makes it that of the calling thread, which moves there at once.
  bool apply() const { return set_ && sched_setaffinity(0, bytes_, set_.get()) == 0; }
  void add(int processor) {
    if (set_)
      CPU_SET_S(static_cast<std::size_t>(processor), bytes_, set_.get());
  }
  std::vector<int> list() const {
    std::vector<int> processors;
    for (int k = 0; set_ && k < room_; ++k)
      if (CPU_ISSET_S(static_cast<std::size_t>(k), bytes_, set_.get()))
        processors.push_back(k);
    return processors;
  }
  int room() const { return room_; }

private:
  struct Free {
    void operator()(cpu_set_t* set) const { CPU_FREE(set); }
  };
  int room_;
  std::size_t bytes_;
  std::unique_ptr<cpu_set_t, Free> set_;
};

/// Processors of the calling thread; empty if the system does not know them.
ProcessorSet set_of_thread() {
  for (int room = CPU_SETSIZE; room <= most_processors; room *= 2)
    if (ProcessorSet set(room); set.read())
      return set;
  return ProcessorSet(CPU_SETSIZE);
}

bool are_bound() {
  return omp_get_proc_bind() != omp_proc_bind_false;
}

/// Until all of a team have come here. @return whether they have. Asleep: who waits for them awake may keep the
/// processor that they need.
bool wait_for_all(std::atomic<int>& come, int threads) {
  ++come;
  for (int nap = 0; nap < most_naps && come < threads; ++nap)
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  return come >= threads;
}

/// For each thread the processor to which it should move; -1: it stays, since no other thread uses its processor.
std::vector<int> ways_apart(const std::vector<int>& processors, const std::vector<int>& at, int from) {
  std::vector<int> taken = at, ways(at.size(), -1);
  const std::size_t n = processors.size();
  for (std::size_t thread = 0, next = 0; thread < at.size(); ++thread) {
    const auto own = at.begin() + static_cast<std::ptrdiff_t>(thread);
    if (std::find(at.begin(), own, *own) == own)
      continue;
    for (; next < n; ++next) {
      const int processor = processors[(static_cast<std::size_t>(from) + next) % n];
      if (std::find(taken.begin(), taken.end(), processor) == taken.end()) {
        taken.push_back(ways[thread] = processor);
        break;
      }
    }
  }
  return ways;
}

std::vector<int> processors_of_place(int place) {
  std::vector<int> processors(static_cast<std::size_t>(std::max(0, omp_get_place_num_procs(place))));
  if (!processors.empty())
    omp_get_place_proc_ids(place, processors.data());
  return processors;
}

} // namespace

std::vector<int> usable_processors() {
  std::vector<int> processors;
  if (are_bound())
    for (int place = 0; place < omp_get_num_places(); ++place) {
      const std::vector<int> of_place = processors_of_place(place);
      processors.insert(processors.end(), of_place.begin(), of_place.end());
    }
  else
    processors = set_of_thread().list();
  std::sort(processors.begin(), processors.end());
  processors.erase(std::unique(processors.begin(), processors.end()), processors.end());
  return processors.empty() ? std::vector<int>{0} : processors;
}

void spread_threads(int threads, int from) {
  const ProcessorSet all = set_of_thread();
  const std::vector<int> processors = all.list();
  if (threads == 1 || threads > static_cast<int>(processors.size()) || are_bound())
    return;
  std::vector<int> at(static_cast<std::size_t>(threads), -1);
  std::atomic<int> started = 0, placed = 0;
  on_each_thread(threads, [&](int number) {
    const auto thread = static_cast<std::size_t>(number);
    at[thread] = sched_getcpu();
    if (!wait_for_all(started, threads))
      return;
    if (const int way = ways_apart(processors, at, from)[thread]; way >= 0) {
      ProcessorSet one(all.room());
      one.add(way);
      if (one.apply())
        all.apply();
    }
    wait_for_all(placed, threads);
  });
}

bool move_to_place(int place) {
  const std::vector<int> processors = processors_of_place(place);
  if (processors.empty())
    return false;
  ProcessorSet set(std::max(CPU_SETSIZE, 1 + *std::max_element(processors.begin(), processors.end())));
  for (const int processor : processors)
    set.add(processor);
  return set.apply();
}

} // namespace trime
