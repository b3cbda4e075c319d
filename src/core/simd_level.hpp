// SPDX-License-Identifier: BSD-3-Clause
// Chooses the vector instructions of kernels that are compiled several times. Every build gives the same bits; only the
// time differs.
#pragma once

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
