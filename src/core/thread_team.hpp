// SPDX-License-Identifier: BSD-3-Clause
// The threads that thread_loop.hpp uses. A thread that waits sleeps after some microseconds. OpenMP lets it turn round
// for milliseconds, and takes the core from the thread that it waits for if another program uses the cores, too.
#pragma once

namespace trime {

/// What each thread of a team does.
class TeamWork {
public:
  virtual void run(int thread) const = 0; ///< must not throw

protected:
  TeamWork() = default;
  TeamWork(const TeamWork&) = default;
  ~TeamWork() = default;
};

/// @brief Runs the work on this thread (number 0) and on up to `threads` - 1 others, which are started once and then
/// kept for the calling thread. Returns when all are done. Inside of such work, and inside of a parallel region of
/// OpenMP that allows no further one, this thread works alone. The threads are those that OMP_THREAD_LIMIT allows and
/// that the system starts; they go to the places of OMP_PLACES if OMP_PROC_BIND says so.
/// @pre threads >= 1
void run_on_team(int threads, const TeamWork& work);

/// Calls body(thread) as above.
template <class Body>
void on_each_thread(int threads, const Body& body) {
  struct Call final : TeamWork {
    explicit Call(const Body& to_call) : called(to_call) {}
    void run(int thread) const override { called(thread); }
    const Body& called;
  };
  run_on_team(threads, Call(body));
}

} // namespace trime
