// SPDX-License-Identifier: BSD-3-Clause
// The only way in which this program uses threads: a loop over items in which each item writes to its own place. The
// body must not call MPI. It should not throw; if it does (no memory), one exception leaves the loop.
#pragma once

#include "core/thread_team.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <type_traits>
#include <vector>

namespace trime {

/// Threads that a loop will use.
inline int thread_count() {
  return omp_get_max_threads();
}

/// Sets how many threads all later loops use. @pre threads >= 1
inline void set_thread_count(int threads) {
  omp_set_num_threads(threads);
}

/// Distance in bytes between memory that different threads write to: two cache lines, since processors fetch them in
/// pairs.
inline constexpr std::size_t bytes_apart = 128;

/// @brief One T for each thread that a loop will use, apart in memory: threads that write to the same cache line wait
/// for each other.
/// @pre set_thread_count is not called while it lives, and no loop inside another one uses it
template <class T>
class PerThread {
  struct alignas(bytes_apart) Slot {
    template <class... Arguments>
    explicit Slot(Arguments&... arguments) : value(arguments...) {}
    T value;
  };
  template <class Of, class Value>
  struct Iterator {
    Of* slot;
    Value& operator*() const { return slot->value; }
    Iterator& operator++() {
      ++slot;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return slot != other.slot; }
  };

public:
  PerThread(const PerThread&) = delete;
  PerThread& operator=(const PerThread&) = delete;
  /// Each is made of the same arguments.
  template <class... Arguments>
  requires(!(... ||
             std::same_as<std::remove_cvref_t<Arguments>, PerThread>)) explicit PerThread(Arguments&&... arguments) {
    const int threads = std::max(1, thread_count());
    slots_.reserve(static_cast<std::size_t>(threads));
    for (int thread = 0; thread < threads; ++thread)
      slots_.emplace_back(arguments...);
  }
  T& operator[](int thread) { return slots_[static_cast<std::size_t>(thread)].value; }
  /// All of them, by thread.
  auto begin() { return Iterator<Slot, T>{slots_.data()}; }
  auto end() { return Iterator<Slot, T>{slots_.data() + slots_.size()}; }
  auto begin() const { return Iterator<const Slot, const T>{slots_.data()}; }
  auto end() const { return Iterator<const Slot, const T>{slots_.data() + slots_.size()}; }

private:
  std::vector<Slot> slots_;
};

/// The items [0, n) of a loop, a range for each thread. A thread that is done with its own range takes from those of
/// others. While all threads are as quick, the same items come to the same thread in loop after loop. So they are in
/// its caches, and in the memory of its socket.
class ItemRanges {
public:
  ItemRanges(std::ptrdiff_t n, int threads, std::ptrdiff_t chunk)
      : chunk_(chunk), ranges_(static_cast<std::size_t>(threads)) {
    const std::ptrdiff_t chunks = (n + chunk - 1) / chunk;
    for (int t = 0; t < threads; ++t) {
      Range& range = ranges_[static_cast<std::size_t>(t)];
      range.next.store(first_of(t, threads, chunks) * chunk, std::memory_order_relaxed);
      range.end = std::min(n, first_of(t + 1, threads, chunks) * chunk);
    }
  }

  /// Calls work(begin, end) for parts of the items until all of them are taken.
  template <class Work>
  void take(int thread, const Work& work) {
    const std::size_t first = static_cast<std::size_t>(thread), count = ranges_.size();
    for (std::size_t k = 0; k < count; ++k) {
      Range& range = ranges_[(first + k) % count];
      while (range.next.load(std::memory_order_relaxed) < range.end) {
        const std::ptrdiff_t begin = range.next.fetch_add(chunk_, std::memory_order_relaxed);
        if (begin < range.end)
          work(begin, std::min(begin + chunk_, range.end));
      }
    }
  }

private:
  /// First chunk of a thread's range. The calling thread, which begins first, has the first range.
  static std::ptrdiff_t first_of(int thread, int threads, std::ptrdiff_t chunks) {
    return (chunks * thread + threads - 1) / threads;
  }
  struct alignas(bytes_apart) Range {
    std::atomic<std::ptrdiff_t> next = 0;
    std::ptrdiff_t end = 0;
  };
  std::ptrdiff_t chunk_;
  std::vector<Range> ranges_;
};

/// The exception that leaves a loop: that of the lowest item.
class LoopError {
public:
  /// Takes what an item has just thrown.
  void take(std::ptrdiff_t item) {
    const std::lock_guard lock(mutex_);
    if (!thrown_ || item < thrower_) {
      thrower_ = item;
      thrown_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (thrown_)
      std::rethrow_exception(thrown_);
  }

private:
  std::mutex mutex_;
  std::exception_ptr thrown_;
  std::ptrdiff_t thrower_ = 0;
};

/// Calls body(item, thread) for item in [0, n), `chunk` items at a time, on any thread (see ItemRanges). Rethrows the
/// exception of the lowest item that throws, after all others are done: the same one on any number of threads.
template <class Body>
void thread_loop(std::ptrdiff_t n, int chunk, const Body& body) {
  LoopError error;
  const int threads = n > chunk ? thread_count() : 1;
  ItemRanges items(n, threads, chunk);
  on_each_thread(threads, [&](int thread) {
    items.take(thread, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      for (std::ptrdiff_t item = begin; item < end; ++item)
        try {
          body(item, thread);
        } catch (...) { // other threads may be in the loop
          error.take(item);
        }
    });
  });
  error.rethrow();
}

/// @brief As above, while the calling thread does `work`, which may call MPI but must not throw; it joins the loop
/// afterwards.
template <class Work, class Body>
void thread_loop_beside(const Work& work, std::ptrdiff_t n, const Body& body) {
  LoopError error;
  const int threads = thread_count();
  ItemRanges items(n, threads, 1);
  on_each_thread(threads, [&](int thread) {
    if (thread == 0)
      work();
    items.take(thread, [&](std::ptrdiff_t item, std::ptrdiff_t) {
      try {
        body(item, thread);
      } catch (...) {
        error.take(item);
      }
    });
  });
  error.rethrow();
}

/// Sum (mod 2^64) of term(item) over items [0, n): the same for any threads. The terms must not throw.
template <class Term>
std::uint64_t thread_sum(std::size_t n, const Term& term) {
  constexpr std::size_t few = 4096;
  PerThread<std::uint64_t> sums(std::uint64_t{0});
  thread_loop(static_cast<std::ptrdiff_t>((n + few - 1) / few), 1, [&](std::ptrdiff_t block, int thread) {
    const std::size_t begin = static_cast<std::size_t>(block) * few, end = std::min(n, begin + few);
    std::uint64_t sum = 0;
    for (std::size_t item = begin; item < end; ++item)
      sum += term(item);
    sums[thread] += sum;
  });
  std::uint64_t sum = 0;
  for (const std::uint64_t of_thread : sums)
    sum += of_thread;
  return sum;
}

} // namespace trime
