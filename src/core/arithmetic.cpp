// SPDX-License-Identifier: BSD-3-Clause
#include "core/arithmetic.hpp"

#include <cfenv>
#include <cmath>
#include <limits>

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

} // namespace trime
