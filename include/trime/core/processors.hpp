// SPDX-License-Identifier: BSD-3-Clause
// The processors that this process may use, and where its threads start on them.
#pragma once

#include <vector>

namespace trime {

/// Numbers of the processors that this process may use, all its places where OMP_PROC_BIND or OMP_PLACES bind threads;
/// ascending. {0} if the system does not tell.
std::vector<int> usable_processors();

/// @brief Starts the threads of the loops to come (thread_loop.hpp); those that start where another one of them runs go
/// to processors where none does, looked for from the `from`-th usable one on. Nothing happens where there are too few
/// processors, or where threads are bound from outside.
///
/// The system starts a thread where its process runs if the other processors are busy at that moment, as they are while
/// MPI starts, and leaves it there for tens of milliseconds, in which two threads take turns. Those that move stay free
/// to go elsewhere afterwards.
/// @pre threads >= 1, from >= 0. Cost: about 0.1 ms for each thread, 4 ms where threads have to
/// go apart.
void spread_threads(int threads, int from);

} // namespace trime
