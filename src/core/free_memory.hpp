// SPDX-License-Identifier: BSD-3-Clause
// Says how much memory a run needs, and returns freed memory to the system, because the C library keeps some for later.
#pragma once

#include <string>

namespace trime {

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
