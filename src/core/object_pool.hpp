// SPDX-License-Identifier: BSD-3-Clause
// Objects that are not thread-safe, for use by many threads: each call borrows one.
#pragma once

#include "core/thread_loop.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace trime {

/// @brief As many equal objects as the process could use threads. They lie in separate cache lines. Borrowing is
/// thread-safe and takes no lock.
template <class T>
class ObjectPool {
  struct alignas(64) Entry {
    template <class... Arguments>
    explicit Entry(Arguments&&... arguments) : object(std::forward<Arguments>(arguments)...) {}
    std::atomic_flag taken = ATOMIC_FLAG_INIT;
    T object;
  };

public:
  /// A borrowed object; the pool has it back when the loan ends.
  class Loan {
  public:
    explicit Loan(Entry& entry) : entry_(entry) {}
    ~Loan() { entry_.taken.clear(std::memory_order_release); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    T& operator*() const { return entry_.object; }

  private:
    Entry& entry_;
  };

  /// Makes the objects. @param check called with each of them; it may throw
  template <class Check, class... Arguments>
  void fill(const Check& check, const Arguments&... arguments) {
    const std::size_t count =
        std::clamp<std::size_t>(std::max<std::size_t>(thread_count(), std::thread::hardware_concurrency()), 1, 256);
    for (std::size_t k = 0; k < count; ++k) {
      entries_.push_back(std::make_unique<Entry>(arguments...));
      check(entries_.back()->object);
    }
  }

  const T& first() const { return entries_.front()->object; }

  /// Borrows an object. If all are taken, because there are more threads than objects, it waits until one is free.
  /// @pre the pool has been filled
  Loan take() const {
    // A thread comes back to the object that it had last, so that objects rarely wander between caches.
    static std::atomic<std::size_t> threads{0};
    thread_local const std::size_t home = threads.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t k = home;; ++k) {
      Entry& entry = *entries_[k % entries_.size()];
      if (!entry.taken.test_and_set(std::memory_order_acquire))
        return Loan(entry);
      if (k - home >= entries_.size())
        std::this_thread::yield();
    }
  }

private:
  std::vector<std::unique_ptr<Entry>> entries_;
};

} // namespace trime
