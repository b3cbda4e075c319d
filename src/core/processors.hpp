// SPDX-License-Identifier: BSD-3-Clause
// Finds the processors and the memory that the machine gives to this process, and the places where its threads start.
// The C library keeps some freed memory for later; this gives it back to the system.
#pragma once

#include <string>
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

/// [bytes] Peak memory of a run for each point, over all ranks, without libraries, shape and size field. It is slightly
/// more than was measured: 130 on the square, 140 where the size varies.
inline constexpr double bytes_per_point = 150;
/// [bytes] Memory that each rank needs for each point of the whole mesh, because it holds the table of all tiles.
/// Measured with 10^6 points: 0.07 on the disc, 0.15 where the size varies.
inline constexpr double bytes_per_point_on_each_rank = 0.15;
/// [bytes] Memory that each rank needs for each piece of the shape's boundary while it reads the shape. Measured: 205
/// with 10^6 segments.
inline constexpr double bytes_per_piece = 230;
/// [bytes] Memory for each piece on the rank that simplifies the boundary for all ranks. Measured with 10^6 segments:
/// 80 where most of them are much smaller than the triangles, 370 where all must be examined.
inline constexpr double bytes_per_simplified_piece = 400;
/// [bytes] Memory of the program with its libraries.
inline constexpr double bytes_per_process = 32 * 0x1p20;

/// Returns the message for a user whose run has no memory left.
std::string out_of_memory_text();

/// @brief Returns freed memory to the system in a few ms. Called at the end of a stage whose arrays the next one does
/// not need. Does nothing where the C library has no such call, and where simulated ranks share one heap.
void return_free_memory();

} // namespace trime
