// SPDX-License-Identifier: BSD-3-Clause
// The processors that this process may use, and where its threads start on them.
#pragma once

#include <vector>

namespace trime {

/// @brief Numbers of the processors that this process may use, ascending; all of the system if it does not tell.
std::vector<int> usable_processors();

/// @brief Starts the threads of the loops to come (thread_loop.hpp) and brings each to a processor of its own, counted
/// from the `first`-th usable one. Nothing happens where there are too few, or where OMP_PROC_BIND binds threads.
///
/// The system starts a thread where its process runs if the other processors are busy at that moment, as they are while
/// MPI starts, and leaves it there for tens of milliseconds, in which two threads take turns. The threads are not
/// bound: who binds them does so from outside (mpirun, OMP_PROC_BIND).
/// @pre threads >= 1, first >= 0. Cost: about 0.1 ms for each thread.
void spread_threads(int threads, int first);

} // namespace trime
