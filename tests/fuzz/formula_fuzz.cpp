// SPDX-License-Identifier: BSD-3-Clause
// Formulas of x and y: what is accepted has a value everywhere, the same each time, and never throws.
#include "fuzz.hpp"
#include "trime/core/formula.hpp"

#include <bit>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::survives([&] {
    const Formula formula(std::string(fuzz::text_of(data, size)), "'expression' in [sizing]");
    for (const double x : {0.0, 0.3, -1e30, 1e-300})
      for (const double y : {0.7, 0.0, 1e30}) {
        const double value = formula.evaluate(x, y), again = formula.evaluate(x, y);
        TRIME_ASSERT(value == again || (value != value && again != again), "{} and {} at ({}, {})", value, again, x, y);
      }
  });
  return 0;
}
