// SPDX-License-Identifier: BSD-3-Clause
#include "core/simd_level.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime {
namespace {

TEST(SimdLevel, IsLoweredByItsLimitAndComesBack) {
  const SimdLevel level = simd_level();
  for (const SimdLevel limit : {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512}) {
    limit_simd_level(limit);
    EXPECT_EQ(simd_level(), std::min(level, limit));
  }
  EXPECT_EQ(simd_level(), level);
}

} // namespace
} // namespace trime
