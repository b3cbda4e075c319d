// SPDX-License-Identifier: BSD-3-Clause
// The one way in which this program uses threads: a loop over items whose results go to places of their own.
// The body must not throw, allocate in its inner part, or call MPI.
#pragma once

#include <omp.h>

#include <cstddef>

namespace trime {

/// Threads that a loop will use.
inline int thread_count() {
  return omp_get_max_threads();
}

/// Sets how many threads all later loops use. @pre threads >= 1
inline void set_thread_count(int threads) {
  omp_set_num_threads(threads);
}

/// Calls body(item, thread) for item in [0, n), dynamically, `chunk` items at a time.
template <class Body>
void thread_loop(std::ptrdiff_t n, int chunk, const Body& body) {
#pragma omp parallel for schedule(dynamic, chunk) if (n > chunk)
  for (std::ptrdiff_t item = 0; item < n; ++item)
    body(item, omp_get_thread_num());
}

} // namespace trime
