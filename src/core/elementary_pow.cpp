// SPDX-License-Identifier: BSD-3-Clause
// pow as exp(y log(x)), with 67 bits of the logarithm.
#include "core/elementary.hpp"
#include "core/elementary_parts.hpp"

#include <cmath>

namespace trime::elementary {
namespace {

enum class Parity { none, odd, even };

/// Returns the parity of y as an integer.
Parity parity(double y) {
  const double a = std::fabs(y);
  if (a >= 0x1p+53)
    return Parity::even;
  if (std::floor(a) != a)
    return Parity::none;
  return (static_cast<std::int64_t>(a) & 1) == 1 ? Parity::odd : Parity::even;
}

/// True if products of four factors x neither overflow nor lose bits.
bool moderate(double x) {
  return std::fabs(x) > 0x1p-200 && std::fabs(x) < 0x1p+200;
}

/// x^y for finite x > 0 and finite y
double positive_pow(double x, double y) {
  const DoubleDouble l = log_parts(x);
  const double about = y * l.hi;
  if (!(std::fabs(about) < 760))
    return about > 0 ? infinity : 0;
  if (std::fabs(about) < 0x1p-60)
    return 1;
  const DoubleDouble product = two_product(y, l.hi);
  return rounded(exp_parts({product.hi, product.lo + y * l.lo}));
}

/// x^y where one of them is NaN or infinite, or x is zero; not both 1^y and x^0.
double special_pow(double x, double y) {
  if (x != x || y != y)
    return not_a_number;
  const double a = std::fabs(x);
  if (std::fabs(y) == infinity)
    return a == 1 ? 1 : (a > 1) == (y > 0) ? infinity : 0;
  const double value = (a == 0) == (y < 0) ? infinity : 0;
  return parity(y) == Parity::odd ? std::copysign(value, x) : value;
}

} // namespace

double pow(double x, double y) {
  if (y == 2)
    return x * x;
  if (y == 1)
    return x;
  if (y == 0 || x == 1)
    return 1;
  const double a = std::fabs(x);
  if (!(a > 0 && a < infinity && std::fabs(y) < infinity)) // with NaN
    return special_pow(x, y);
  if (y == -1)
    return 1 / x;
  if (y == 3 && moderate(x))
    return (two_product(x, x) * x).hi;
  if (y == 4 && moderate(x)) {
    const DoubleDouble square = two_product(x, x);
    return (square * square).hi;
  }
  if (x > 0)
    return y == 0.5 ? std::sqrt(x) : positive_pow(x, y);
  const Parity kind = parity(y);
  if (kind == Parity::none)
    return not_a_number;
  return kind == Parity::odd ? -positive_pow(a, y) : positive_pow(a, y);
}

} // namespace trime::elementary
