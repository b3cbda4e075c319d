// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of the machine. Meshes with the same bits on every machine need IEEE doubles, operations that round
// once to nearest, and denormal numbers; a function tests this. Another one finds the vector instructions (SIMD level)
// for kernels that are compiled several times. The level changes only the time, not the bits.
#pragma once

#include <cfloat>
#include <string>

#ifdef __FAST_MATH__
#error "TriMe-MPI must not be compiled with -ffast-math or -Ofast: its meshes would depend on the compiler."
#endif

namespace trime {

static_assert(FLT_EVAL_METHOD == 0, "doubles must be computed as doubles: on i386 compile with -mfpmath=sse -msse2");

/// @brief Describes what is wrong with the floating-point arithmetic of the calling thread; empty if nothing is wrong.
/// Compiler flags and loaded libraries may change the arithmetic: icpx uses fast maths by default, and some libraries
/// flush small numbers to zero.
std::string arithmetic_fault();

} // namespace trime

/// The name of a function in a source that is compiled for several SIMD levels: `name` followed by TRIME_LEVEL.
#define TRIME_AT_LEVEL(name) TRIME_JOIN(name, TRIME_LEVEL)
#define TRIME_JOIN(name, level) TRIME_JOIN_TEXT(name, level)
#define TRIME_JOIN_TEXT(name, level) name##_##level

namespace trime {

/// Levels of vector instructions, ascending: those of every processor of the platform; AVX2; AVX-512 with F, DQ, VL and
/// BW.
enum class SimdLevel { portable, avx2, avx512 };

/// @brief Returns the highest SIMD level of this machine, which is determined once. The environment variable TRIME_SIMD
/// (portable, avx2 or avx512) lowers it; levels that the machine does not have, and other values, are ignored.
SimdLevel simd_level();

/// Returns the one of three values that belongs to a SIMD level.
template <class T>
T of_level(SimdLevel level, T portable, T avx2, T avx512) {
  return level == SimdLevel::portable ? portable : level == SimdLevel::avx2 ? avx2 : avx512;
}

/// @brief Lowers the SIMD level for tests and comparisons; a level above that of the machine has no effect. Must not be
/// called while other threads compute.
void limit_simd_level(SimdLevel limit);

} // namespace trime
