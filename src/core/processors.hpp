// SPDX-License-Identifier: BSD-3-Clause
// The processors that this process may use, and where its threads start on them.
#pragma once

#include <vector>

namespace trime {

/// Returns the numbers of the processors that this process may use (all its places, if OMP_PROC_BIND or OMP_PLACES bind
/// threads), ascending. Returns {0} if the system does not know.
std::vector<int> usable_processors();

/// @brief Starts the threads of all later loops (thread_loop.hpp). If two threads start on one processor, moves one of
/// them to a free processor; the search begins at the `from`-th usable one. Does nothing if there are too few
/// processors, or if OpenMP settings or the launcher bind the threads.
///
/// Why: the system starts a thread where its process runs if the other processors are busy, as they are while MPI
/// starts. It leaves it there for tens of milliseconds, during which two threads share one processor. Threads that were
/// moved are not bound: the system may move them again.
/// @pre threads >= 1, from >= 0. Cost: about 0.1 ms for each thread, 4 ms where threads must move.
void spread_threads(int threads, int from);

} // namespace trime
