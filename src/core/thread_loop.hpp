// SPDX-License-Identifier: BSD-3-Clause
// The only functions of this program that use threads. One is a loop over items
// in which each item writes to separate memory. Another makes a list with several threads, in the order of a single
// thread. The body of a loop must not call MPI. The body should not throw; if it does (for lack of memory), one
// exception leaves the loop.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <type_traits>
#include <vector>

namespace trime {

/// Returns how many threads the next loop will use.
inline int thread_count() {
  return omp_get_max_threads();
}

/// Sets how many threads all later loops use. @pre threads >= 1
inline void set_thread_count(int threads) {
  omp_set_num_threads(threads);
}

/// [bytes] Distance between memory to which different threads write: two cache lines, because processors fetch cache
/// lines in pairs.
inline constexpr std::size_t bytes_apart = 128;

/// @brief Holds one T for each thread of a loop. The objects lie far apart in memory, because threads that write to the
/// same cache line slow each other down.
/// @pre set_thread_count is not called while this object exists, and no loop inside of another loop uses it
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
  /// Makes one T for each thread, all from the same arguments.
  template <class... Arguments>
  requires(!(... ||
             std::same_as<std::remove_cvref_t<Arguments>, PerThread>)) explicit PerThread(Arguments&&... arguments) {
    const int threads = std::max(1, thread_count());
    slots_.reserve(static_cast<std::size_t>(threads));
    for (int thread = 0; thread < threads; ++thread)
      slots_.emplace_back(arguments...);
  }
  T& operator[](int thread) { return slots_[static_cast<std::size_t>(thread)].value; }
  /// Iterate over the objects of all threads.
  auto begin() { return Iterator<Slot, T>{slots_.data()}; }
  auto end() { return Iterator<Slot, T>{slots_.data() + slots_.size()}; }
  auto begin() const { return Iterator<const Slot, const T>{slots_.data()}; }
  auto end() const { return Iterator<const Slot, const T>{slots_.data() + slots_.size()}; }

private:
  std::vector<Slot> slots_;
};

/// Shares the items [0, n) of a loop among threads. Each thread has a range of items; a thread that has finished its
/// range takes items from the ranges of others. While all threads are equally fast, each thread gets the same items in
/// every loop. Then these items are in its caches and in the memory of its socket.
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

  /// Calls work(begin, end) for parts of the items until all items are taken.
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
  /// Returns the first chunk in the range of a thread. Thread 0, which begins first, has the first range.
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

/// Calls body(item, thread) for each item in [0, n), `chunk` items at a time, on any thread (see ItemRanges). After all
/// items are done, rethrows the exception of the lowest item that threw, which is the same for any number of threads.
template <class Body>
void thread_loop(std::ptrdiff_t n, int chunk, const Body& body) {
  std::exception_ptr thrown;
  std::ptrdiff_t thrower = n;
  const int threads = n > chunk ? thread_count() : 1;
  ItemRanges items(n, threads, chunk);
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    const int thread = omp_get_thread_num();
    items.take(thread, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      for (std::ptrdiff_t item = begin; item < end; ++item)
        try {
          body(item, thread);
        } catch (...) { // an exception must not leave a parallel region
#pragma omp critical(trime_thread_loop)
          if (item < thrower) {
            thrower = item;
            thrown = std::current_exception();
          }
        }
    });
  }
  if (thrown)
    std::rethrow_exception(thrown);
}

/// @brief Does the same as thread_loop, but the calling thread first does `work` while the other threads begin. `work`
/// may call MPI but must not throw.
template <class Work, class Body>
void thread_loop_beside(const Work& work, std::ptrdiff_t n, const Body& body) {
  std::exception_ptr thrown;
  ItemRanges items(n, thread_count(), 1);
#pragma omp parallel
  {
    const int thread = omp_get_thread_num();
    if (thread == 0)
      work();
    items.take(thread, [&](std::ptrdiff_t item, std::ptrdiff_t) {
      try {
        body(item, thread);
      } catch (...) {
#pragma omp critical(trime_thread_loop)
        if (!thrown)
          thrown = std::current_exception();
      }
    });
  }
  if (thrown)
    std::rethrow_exception(thrown);
}

/// Returns the sum (mod 2^64) of term(item) over the items [0, n), which does not depend on the number of threads. The
/// terms must not throw.
template <class Term>
std::uint64_t thread_sum(std::size_t n, const Term& term) {
  constexpr std::size_t few = 4096;
  std::uint64_t sum = 0;
#pragma omp parallel for schedule(static) reduction(+ : sum) if (n > few)
  for (std::size_t item = 0; item < n; ++item)
    sum += term(item);
  return sum;
}

/// @brief Calls make(k, list) for k = 0 .. n-1; `make` may append to the list. Returns all lists, joined in the order
/// of k.
/// @param chunk number of successive k that one thread takes at a time
template <class Item, class Make>
std::vector<Item> gather_in_order(std::ptrdiff_t n, std::ptrdiff_t chunk, const Make& make) {
  std::vector<std::vector<Item>> lists(static_cast<std::size_t>((n + chunk - 1) / chunk));
  thread_loop(std::ssize(lists), 1, [&](std::ptrdiff_t c, int) {
    for (std::ptrdiff_t k = c * chunk; k < std::min(n, (c + 1) * chunk); ++k)
      make(k, lists[static_cast<std::size_t>(c)]);
  });
  if (lists.size() == 1)
    return std::move(lists.front());
  std::size_t size = 0;
  for (const std::vector<Item>& list : lists)
    size += list.size();
  std::vector<Item> all;
  all.reserve(size);
  for (const std::vector<Item>& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

} // namespace trime
