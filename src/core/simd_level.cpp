// SPDX-License-Identifier: BSD-3-Clause
#include "core/simd_level.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace trime {
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
