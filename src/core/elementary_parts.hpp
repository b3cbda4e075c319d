// SPDX-License-Identifier: BSD-3-Clause
// Functions that the sources of the elementary functions share, such as exp and log with more bits than a double has.
#pragma once

#include "core/double_double.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace trime::elementary {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The number (value.hi + value.lo) 2^exponent.
struct Scaled {
  DoubleDouble value;
  int exponent = 0;
};

/// @brief Returns 2^n. @pre -1022 <= n <= 1023
constexpr double power_of_two(int n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

/// @brief Returns the nearest integer, halves to even. @pre |x| < 2^51
inline double nearest(double x) {
  constexpr double shift = 0x1.8p+52;
  return (x + shift) - shift;
}

/// @brief Returns coefficient[0] + q (coefficient[1] + q (...)).
template <std::size_t count>
constexpr double polynomial(const std::array<double, count>& coefficient, double q) {
  double sum = coefficient[count - 1];
  for (std::size_t k = count - 1; k-- > 0;)
    sum = coefficient[k] + q * sum;
  return sum;
}

/// @brief Returns s as a double. It is rounded only once, also if the result is denormal. @pre 0.5 <= s.value < 4
double rounded(const Scaled& s);

/// @brief Returns exp(a) with a relative error of about 2^-60 and a `value` in [0.99, 2.01]. @pre |a| < 1200
Scaled exp_parts(DoubleDouble a);

/// @brief Returns log(x) with a relative error of about 2^-67. @pre x is finite, x > 0
DoubleDouble log_parts(double x);

/// @brief Returns the square root of a with a relative error of about 2^-100. @pre a is normal and positive
DoubleDouble root(DoubleDouble a);

} // namespace trime::elementary
