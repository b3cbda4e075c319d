// SPDX-License-Identifier: BSD-3-Clause
// The one way in which this program uses threads: a loop over items whose results go to places of their own.
// The body must not call MPI. It should not throw; what it throws all the same (no memory) leaves the loop as one
// exception.
#pragma once

#include <omp.h>

#include <cstddef>
#include <cstdint>
#include <exception>

namespace trime {

/// Threads that a loop will use.
inline int thread_count() {
  return omp_get_max_threads();
}

/// Sets how many threads all later loops use. @pre threads >= 1
inline void set_thread_count(int threads) {
  omp_set_num_threads(threads);
}

/// Calls body(item, thread) for item in [0, n), dynamically, `chunk` items at a time. Rethrows the exception of the
/// lowest item that throws, after all others are done: the same one on any number of threads.
template <class Body>
void thread_loop(std::ptrdiff_t n, int chunk, const Body& body) {
  std::exception_ptr thrown;
  std::ptrdiff_t thrower = n;
#pragma omp parallel for schedule(dynamic, chunk) if (n > chunk)
  for (std::ptrdiff_t item = 0; item < n; ++item)
    try {
      body(item, omp_get_thread_num());
    } catch (...) { // an exception must not cross the end of a parallel region
#pragma omp critical(trime_thread_loop)
      if (item < thrower) {
        thrower = item;
        thrown = std::current_exception();
      }
    }
  if (thrown)
    std::rethrow_exception(thrown);
}

/// @brief The same while the calling thread does `work`, which may call MPI but must not throw; it joins the loop
/// afterwards.
template <class Work, class Body>
void thread_loop_beside(const Work& work, std::ptrdiff_t n, const Body& body) {
  std::exception_ptr thrown;
#pragma omp parallel
  {
#pragma omp master
    work();
#pragma omp for schedule(dynamic, 1)
    for (std::ptrdiff_t item = 0; item < n; ++item)
      try {
        body(item, omp_get_thread_num());
      } catch (...) {
#pragma omp critical(trime_thread_loop)
        if (!thrown)
          thrown = std::current_exception();
      }
  }
  if (thrown)
    std::rethrow_exception(thrown);
}

/// Sum (mod 2^64) of term(item) over items [0, n): the same for any threads. The terms must not throw.
template <class Term>
std::uint64_t thread_sum(std::size_t n, const Term& term) {
  constexpr std::size_t few = 4096;
  std::uint64_t sum = 0;
#pragma omp parallel for schedule(static) reduction(+ : sum) if (n > few)
  for (std::size_t item = 0; item < n; ++item)
    sum += term(item);
  return sum;
}

} // namespace trime
