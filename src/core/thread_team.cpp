// SPDX-License-Identifier: BSD-3-Clause
#include "core/thread_team.hpp"

#include "core/processors.hpp"

#include <linux/futex.h>
#include <omp.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

namespace trime {
namespace {

using Clock = std::chrono::steady_clock;

// So long a thread waits awake: about as long as it takes to wake one that sleeps.
constexpr std::chrono::microseconds awake{20};

// A thread that reads the clock twice in a row finds no such difference, unless another program has had its core.
constexpr std::chrono::microseconds interrupted{200};

// So many waits after an interruption are asleep at once: other programs want the core.
constexpr int waits_of_crowd = 64;

constexpr int pauses_of_glance = 16;
constexpr std::size_t apart = 128; // bytes between memory that different threads write

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// A word that a thread changes while others wait for that, asleep in the kernel (futex). std::atomic::wait yields the
/// core before it sleeps; a thread that yields stands behind the other program for a whole time slice.
class Word {
public:
  std::uint32_t get() const { return value_.load(std::memory_order_acquire); }
  void set(std::uint32_t value) { value_.store(value, std::memory_order_relaxed); }
  /// Adds, mod 2^32. @return the sum
  std::uint32_t add(std::uint32_t addend) { return value_.fetch_add(addend) + addend; }
  /// Wakes all that sleep. A sleeper that counts itself too late for this sees the change before it sleeps.
  void wake() {
    if (asleep_.load() > 0)
      futex(FUTEX_WAKE_PRIVATE, INT_MAX);
  }
  /// Until the value is another one.
  void sleep_while(std::uint32_t value) {
    ++asleep_;
    while (value_.load() == value)
      futex(FUTEX_WAIT_PRIVATE, value);
    --asleep_;
  }

private:
  void futex(int what, std::uint32_t number) { syscall(SYS_futex, &value_, what, number, nullptr, nullptr, 0); }
  static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));

  alignas(apart) std::atomic<std::uint32_t> value_ = 0;
  std::atomic<int> asleep_ = 0; // threads
};

/// Waits of one thread: awake for a short while, then asleep.
class Waiter {
public:
  /// Until the word is not `value` any more.
  void wait_while(Word& word, std::uint32_t value) {
    if (crowded_ > 0)
      --crowded_;
    else if (changes_soon(word, value))
      return;
    word.sleep_while(value);
  }

private:
  bool changes_soon(const Word& word, std::uint32_t value) {
    const Clock::time_point begin = Clock::now();
    for (Clock::time_point last = begin; last - begin < awake;) {
      for (int k = 0; k < pauses_of_glance; ++k) {
        if (word.get() != value)
          return true;
        pause();
      }
      const Clock::time_point now = Clock::now();
      if (now - last > interrupted)
        crowded_ = waits_of_crowd;
      last = now;
    }
    return false;
  }

  int crowded_ = 0; // so many waits are asleep from the beginning
};

/// The place in OMP_PLACES of a thread, as OpenMP would choose it; -1 if threads are not bound.
int place_of(int thread, int threads) {
  const omp_proc_bind_t bind = omp_get_proc_bind();
  const int places = omp_get_num_places(), own = omp_get_place_num(); // binds the calling thread, too
  if (bind == omp_proc_bind_false || places == 0 || own < 0)
    return -1;
  if (bind == omp_proc_bind_master)
    return own;
  const bool is_next = bind != omp_proc_bind_spread && threads <= places;
  return (own + (is_next ? thread : static_cast<int>(static_cast<long>(thread) * places / threads))) % places;
}

thread_local bool works_in_team = false;

/// While it lives, work of this thread does not use a team.
class InTeam {
public:
  InTeam() { works_in_team = true; }
  ~InTeam() { works_in_team = false; }
  InTeam(const InTeam&) = delete;
  InTeam& operator=(const InTeam&) = delete;
};

/// The threads of one calling thread.
class Team {
public:
  explicit Team(int asked) : asked_(asked), process_(getpid()) {
    const int threads = std::max(1, std::min(asked, omp_get_thread_limit()));
    try {
      for (int thread = 1; thread < threads; ++thread)
        others_.emplace_back([this, thread, place = place_of(thread, threads)] { serve(thread, place); });
    } catch (const std::system_error&) { // no more threads: those that have come do the work
    }
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  ~Team() {
    if (getpid() != process_) { // a child of fork has none of the threads
      for (std::thread& other : others_)
        other.detach();
      return;
    }
    call(nullptr);
    for (std::thread& other : others_)
      other.join();
  }

  int asked() const { return asked_; }
  bool is_of_this_process() const { return getpid() == process_; }
  /// @pre is_of_this_process()
  void run(const TeamWork& work) {
    busy_.set(static_cast<std::uint32_t>(others_.size()));
    call(&work);
    work.run(0);
    for (std::uint32_t busy = 0; (busy = busy_.get()) != 0;)
      waiter_.wait_while(busy_, busy);
  }

private:
  /// Lets the others begin. Without work they end.
  void call(const TeamWork* work) {
    work_ = work;
    calls_.add(1);
    calls_.wake();
  }

  void serve(int thread, int place) {
    const InTeam in_team;
    if (place >= 0)
      move_to_place(place);
    Waiter waiter;
    for (std::uint32_t call = 0;; ++call) {
      waiter.wait_while(calls_, call);
      if (!work_)
        return;
      work_->run(thread);
      if (busy_.add(-1U) == 0)
        busy_.wake();
    }
  }

  const int asked_;
  const pid_t process_;
  std::vector<std::thread> others_;
  Waiter waiter_; // of the calling thread
  const TeamWork* work_ = nullptr;
  Word calls_; // so far, mod 2^32
  Word busy_;  // so many of the others
};

bool works_alone(int threads) {
  return threads == 1 || works_in_team || omp_get_active_level() >= omp_get_max_active_levels();
}

} // namespace

void run_on_team(int threads, const TeamWork& work) {
  if (works_alone(threads)) {
    work.run(0);
    return;
  }
  thread_local std::unique_ptr<Team> team;
  if (!team || team->asked() != threads || !team->is_of_this_process()) {
    team.reset();
    team = std::make_unique<Team>(threads);
  }
  const InTeam in_team;
  team->run(work);
}

} // namespace trime
