// SPDX-License-Identifier: BSD-3-Clause
// What "the same bits" rests on: IEEE doubles, one rounding an operation, to nearest, with small numbers kept.
#pragma once

#include <cfloat>
#include <string>

#ifdef __FAST_MATH__
#error "TriMe-MPI must not be compiled with -ffast-math or -Ofast: its meshes would depend on the compiler."
#endif

namespace trime {

static_assert(FLT_EVAL_METHOD == 0, "doubles must be computed as doubles: on i386 compile with -mfpmath=sse -msse2");

/// @brief What is wrong with the arithmetic of the calling thread; empty: nothing. Flags of the compiler and libraries
/// that were loaded may change it (icpx has fast maths by default, some libraries flush small numbers to zero).
std::string arithmetic_fault();

} // namespace trime
