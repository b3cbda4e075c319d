// SPDX-License-Identifier: BSD-3-Clause
#include "core/simd_level.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace trime {
namespace {

TEST(Arithmetic, IsSoundHere) {
  EXPECT_EQ(arithmetic_fault(), "");
}

TEST(Arithmetic, AnotherRoundingIsFound) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(mode), 0);
    const std::string fault = arithmetic_fault();
    std::fesetround(FE_TONEAREST);
    EXPECT_NE(fault.find("rounded to nearest"), std::string::npos) << fault;
  }
}

#if defined(__SSE2__)
TEST(Arithmetic, SmallNumbersFlushedToZeroAreFound) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | _MM_FLUSH_ZERO_ON);
  const std::string fault = arithmetic_fault();
  _mm_setcsr(before);
  EXPECT_NE(fault.find("flushed to zero"), std::string::npos) << fault;
}
#endif

} // namespace
} // namespace trime
