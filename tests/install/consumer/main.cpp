// SPDX-License-Identifier: BSD-3-Clause
// A user's program: measures an equilateral triangle with the installed library.
#include <trime/mesh/quality.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const double alpha = trime::mesh::aspect_ratio({0, 0}, {1, 0}, {0.5, std::sqrt(0.75)});
  std::printf("alpha of an equilateral triangle: %.15f\n", alpha);
  return std::abs(alpha - 1) < 1e-12 ? 0 : 1;
}
