// SPDX-License-Identifier: BSD-3-Clause
// Which vector instructions the kernels with several builds may use: every build gives the same bits, only the time
// differs.
#pragma once

/// What a source that is built for several levels defines: `name` with the level that TRIME_LEVEL stands for.
#define TRIME_AT_LEVEL(name) TRIME_JOIN(name, TRIME_LEVEL)
#define TRIME_JOIN(name, level) TRIME_JOIN_TEXT(name, level)
#define TRIME_JOIN_TEXT(name, level) name##_##level

namespace trime {

/// In rising order: what every processor of the platform has; AVX2; AVX-512 with F, DQ, VL and BW.
enum class SimdLevel { portable, avx2, avx512 };

/// @brief The highest level of this machine, asked once. The environment variable TRIME_SIMD (portable, avx2 or avx512)
/// lowers it; a level that the machine does not have, and any other value, is ignored.
SimdLevel simd_level();

/// The one of three that belongs to a level.
template <class T>
T of_level(SimdLevel level, T portable, T avx2, T avx512) {
  return level == SimdLevel::portable ? portable : level == SimdLevel::avx2 ? avx2 : avx512;
}

/// @brief Lowers the level for tests and comparisons; levels above that of the machine have no effect. Not while other
/// threads compute.
void limit_simd_level(SimdLevel limit);

} // namespace trime
