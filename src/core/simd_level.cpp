// SPDX-License-Identifier: BSD-3-Clause
#include "core/simd_level.hpp"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace trime {

std::string arithmetic_fault() {
  // Read at run time, so that the compiler cannot know the results.
  volatile double one = 1, tiny = 0x1p-30, half_step = 0x1p-53, two = 2;
  volatile double least = std::numeric_limits<double>::min();
  if (std::fegetround() != FE_TONEAREST || one + half_step != 1 || -one - half_step != -1)
    return "sums are not rounded to nearest";
  const double x = one + tiny, rounded = one + 2 * tiny;
  if (x * x - rounded != 0)
    return "a product and a sum are rounded once (contracted); compile with -ffp-contract=off";
  if (least / two == 0 || (least / two) * two != least)
    return "small numbers are flushed to zero; a library was built with -ffast-math, or the compiler's flags ask for "
           "it";
  if (std::sqrt(two) != 0x1.6a09e667f3bcdp+0)
    return "the root of 2 is not rounded to nearest";
  return {};
}

namespace {

SimdLevel level_of_machine() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw"))
    return SimdLevel::avx512;
  if (__builtin_cpu_supports("avx2"))
    return SimdLevel::avx2;
#endif
  return SimdLevel::portable;
}

SimdLevel limit_of_environment() {
  const char* value = std::getenv("TRIME_SIMD");
  const std::string_view name = value ? value : "";
  return name == "portable" ? SimdLevel::portable : name == "avx2" ? SimdLevel::avx2 : SimdLevel::avx512;
}

SimdLevel test_limit = SimdLevel::avx512;

} // namespace

SimdLevel simd_level() {
  static const SimdLevel level = std::min(level_of_machine(), limit_of_environment());
  return std::min(level, test_limit);
}

void limit_simd_level(SimdLevel limit) {
  test_limit = limit;
}

} // namespace trime
