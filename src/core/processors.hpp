// SPDX-License-Identifier: BSD-3-Clause
// The processors that this process may use, and where its threads start on them.
#pragma once

#include <vector>

namespace trime {

/// Returns the numbers of the processors that this process may use (all its places, if OMP_PROC_BIND or OMP_PLACES bind
/// threads), ascending. Returns {0} if the system does not know.
std::vector<int> usable_processors();

/// @brief Starts the threads of the loops to come (thread_loop.hpp). A thread that starts where another one of them
/// runs goes to a processor where none does, looked for from the `from`-th usable one on. Nothing happens where there
/// are too few processors, or where threads are bound from outside.
///
/// Why: the system starts a thread where its process runs if the other processors are busy, as they are while MPI
/// starts. It leaves it there for tens of milliseconds, in which two threads take turns. Threads that move stay free to
/// go elsewhere afterwards.
/// @pre threads >= 1, from >= 0. Cost: about 0.1 ms for each thread, 4 ms where threads have to
/// go apart.
void spread_threads(int threads, int from);

/// Binds the calling thread to the processors of a place of OpenMP (OMP_PLACES). @return false if it cannot
bool move_to_place(int place);

} // namespace trime
