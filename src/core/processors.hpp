// SPDX-License-Identifier: BSD-3-Clause
// Finds the processors and the memory that the system gives to this process, and places threads on processors. Also
// returns freed memory, which the C library would keep, to the system.
#pragma once

#include <string>
#include <vector>

namespace trime {

/// Returns the numbers of the processors that this process may use, ascending. If OMP_PROC_BIND or OMP_PLACES binds
/// threads, these are the processors of all threads. Returns {0} if the system does not know.
std::vector<int> usable_processors();

/// @brief Starts the threads of all later loops (thread_loop.hpp). If two threads start on the same processor, moves
/// one of them to a free processor; the search begins at the `from`-th usable processor. Does nothing if there are too
/// few processors, or if OpenMP settings or the launcher bind the threads.
///
/// Why: the system starts a thread on the processor of its process if the other processors are busy, as they are while
/// MPI starts. The thread stays there for tens of milliseconds, during which two threads share one processor. Threads
/// that were moved are not bound: the system may move them again.
/// @pre threads >= 1, from >= 0. Cost: about 0.1 ms for each thread, and 4 ms if threads must move.
void spread_threads(int threads, int from);

/// [bytes] Peak memory of a run for each point, over all ranks, without libraries, shape and size field. The value is
/// slightly above the measured ones: 130 on the square, 140 if the size varies.
inline constexpr double bytes_per_point = 150;
/// [bytes] Memory that each rank needs for each point of the whole mesh, because each rank holds the table of all
/// tiles. Measured with 10^6 points: 0.07 on the disc, 0.15 if the size varies.
inline constexpr double bytes_per_point_on_each_rank = 0.15;
/// [bytes] Memory that each rank needs for each piece of the shape's boundary while it reads the shape. Measured: 205
/// with 10^6 segments.
inline constexpr double bytes_per_piece = 230;
/// [bytes] Memory for each piece on the rank that simplifies the boundary for all ranks. Measured with 10^6 segments:
/// 80 if most of them are much shorter than the triangles, 370 if all must be examined.
inline constexpr double bytes_per_simplified_piece = 400;
/// [bytes] Memory of the program together with its libraries.
inline constexpr double bytes_per_process = 32 * 0x1p20;

/// Returns the error message for a run that has no memory left.
std::string out_of_memory_text();

/// @brief Returns freed memory to the system; takes a few ms. Called at the end of a stage whose arrays the next stage
/// does not need. Does nothing if the C library has no such function, or if simulated ranks share one heap.
void return_free_memory();

} // namespace trime
