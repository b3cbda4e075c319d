// SPDX-License-Identifier: BSD-3-Clause
// How much memory a run needs, and memory that was freed, back to the system: the C library keeps some for later.
#pragma once

#include <string>

namespace trime {

/// Memory of a run at its peak, over all ranks, without libraries, shape and size field. It is a little more than was
/// measured: 130 on the square, 140 where the size varies.
inline constexpr double bytes_per_point = 150;
/// Memory of each rank for every point of the whole mesh: the table of all tiles. Measured with 10^6 points: 0.07 on
/// the disc, 0.15 where the size varies.
inline constexpr double bytes_per_point_on_each_rank = 0.15;
/// Memory of each rank for each piece of the shape's boundary, while the shape is read. Measured: 205 with 10^6
/// segments.
inline constexpr double bytes_per_piece = 230;
/// Memory for each piece on the rank that simplifies the boundary for all. Measured with 10^6 segments: 80 where most
/// of them are much smaller than the triangles, 370 where all must be examined.
inline constexpr double bytes_per_simplified_piece = 400;
/// The program with its libraries.
inline constexpr double bytes_per_process = 32 * 0x1p20;

/// Advice for a user whose run has no memory left.
std::string out_of_memory_text();

/// @brief Returns freed memory, for the end of a stage whose arrays the next does not need. A few ms; does nothing
/// where the C library has no such call, and where simulated ranks share one heap.
void return_free_memory();

} // namespace trime
