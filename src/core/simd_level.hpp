// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of the machine: a test of what "the same bits" needs (IEEE doubles, each operation rounded once to
// nearest, denormal numbers kept), and the vector instructions that kernels with several builds may use. Every build
// gives the same bits, only the time differs.
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

/// The name of a function in a source that is compiled for several levels: `name` with the level TRIME_LEVEL behind it.
#define TRIME_AT_LEVEL(name) TRIME_JOIN(name, TRIME_LEVEL)
#define TRIME_JOIN(name, level) TRIME_JOIN_TEXT(name, level)
#define TRIME_JOIN_TEXT(name, level) name##_##level

namespace trime {

/// Levels of vector instructions in rising order: those of every processor of the platform; AVX2; AVX-512 with F, DQ,
/// VL and BW.
enum class SimdLevel { portable, avx2, avx512 };

/// @brief Returns the highest level of this machine, which is determined once. The environment variable TRIME_SIMD
/// (portable, avx2 or avx512) lowers it; a level that the machine does not have, and any other value, is ignored.
SimdLevel simd_level();

/// Returns the one of three values that belongs to a level.
template <class T>
T of_level(SimdLevel level, T portable, T avx2, T avx512) {
  return level == SimdLevel::portable ? portable : level == SimdLevel::avx2 ? avx2 : avx512;
}

/// @brief Lowers the level for tests and comparisons; levels above that of the machine have no effect. Must not be
/// called while other threads compute.
void limit_simd_level(SimdLevel limit);

} // namespace trime
