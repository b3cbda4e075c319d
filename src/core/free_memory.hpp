// SPDX-License-Identifier: BSD-3-Clause
// How much memory a run needs, and memory that was freed, back to the system: the C library keeps some for later.
#pragma once

#include <string>

namespace trime {

/// What a run needs at its peak, over all ranks, beside the libraries, the shape and the size field. It is a little
/// more than is measured: 130 on the square, 140 where the size varies.
inline constexpr double bytes_per_point = 150;
/// The same on each rank, for every point of the whole mesh: where all tiles are. Measured with 10^6 points: 0.07 on
/// the disc, 0.15 where the size varies.
inline constexpr double bytes_per_point_on_each_rank = 0.15;
/// The same for each piece of the shape's boundary: while the shape is read. Measured: 205 with 10^6 segments.
inline constexpr double bytes_per_piece = 230;
/// The same on the rank that simplifies the boundary for all. Measured with 10^6 segments: 80 where most of them are
/// far below the triangles, 370 where all have to be looked at.
inline constexpr double bytes_per_simplified_piece = 400;
/// The program with its libraries.
inline constexpr double bytes_per_process = 32 * 0x1p20;

/// Advice for a user whose run has no memory left.
std::string out_of_memory_text();

/// @brief Returns freed memory, for the end of a stage whose arrays the next does not need. A few ms; does nothing
/// where the C library has no such call, and where simulated ranks share one heap.
void return_free_memory();

} // namespace trime
