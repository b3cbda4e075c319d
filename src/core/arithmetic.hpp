// SPDX-License-Identifier: BSD-3-Clause
// Tests the arithmetic that "the same bits" needs: IEEE doubles, each operation rounded once to nearest, denormal
// numbers kept.
#pragma once

#include <cfloat>
#include <string>

#ifdef __FAST_MATH__
#error "TriMe-MPI must not be compiled with -ffast-math or -Ofast: its meshes would depend on the compiler."
#endif

namespace trime {

static_assert(FLT_EVAL_METHOD == 0, "doubles must be computed as doubles: on i386 compile with -mfpmath=sse -msse2");

/// @brief Describes what is wrong with the arithmetic of the calling thread; empty if nothing is wrong. Compiler flags
/// and loaded libraries may change the arithmetic: icpx has fast maths by default, and some libraries flush small
/// numbers to zero.
std::string arithmetic_fault();

} // namespace trime
