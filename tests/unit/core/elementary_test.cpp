// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions against MPFR, on random and on hard arguments, and where they must not fall.
#include "core/elementary.hpp"
#include "core/elementary_parts.hpp"
#include "core/random.hpp"

#include <gtest/gtest.h>

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace trime::elementary {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double bound = 0.52; // of the errors, in units in the last place
constexpr int tries = 1000;    // in each range

/// A number of MPFR with 200 bits.
class Wide {
public:
  explicit Wide(double value = 0) {
    mpfr_init2(value_, 200);
    mpfr_set_d(value_, value, MPFR_RNDN);
  }
  Wide(const Wide&) = delete;
  Wide& operator=(const Wide&) = delete;
  ~Wide() { mpfr_clear(value_); }
  mpfr_ptr get() { return value_; }

private:
  mpfr_t value_;
};

/// |got - exact| in units of the last place of the exact value as a double.
double error_of(double got, Wide& exact) {
  const double nearest = mpfr_get_d(exact.get(), MPFR_RNDN);
  if (!std::isfinite(nearest) || !std::isfinite(got) || nearest == 0)
    return nearest == got || (nearest != nearest && got != got) ? 0 : infinity;
  const long place = std::max<long>(mpfr_get_exp(exact.get()) - 53, -1074);
  Wide difference(got);
  mpfr_sub(difference.get(), difference.get(), exact.get(), MPFR_RNDN);
  mpfr_mul_2si(difference.get(), difference.get(), -place, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference.get(), MPFR_RNDN));
}

struct Function {
  std::string name;
  double (*ours)(double);
  int (*exact)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

  double error(double x) const {
    Wide argument(x), value;
    exact(value.get(), argument.get(), MPFR_RNDN);
    return error_of(ours(x), value);
  }
};

double error_of_pow(double x, double y) {
  Wide base(x), exponent(y), value;
  mpfr_pow(value.get(), base.get(), exponent.get(), MPFR_RNDN);
  return error_of(pow(x, y), value);
}

const std::vector<Function> functions{
    {"sin", sin, mpfr_sin},       {"cos", cos, mpfr_cos},       {"tan", tan, mpfr_tan},
    {"asin", asin, mpfr_asin},    {"acos", acos, mpfr_acos},    {"atan", atan, mpfr_atan},
    {"exp", exp, mpfr_exp},       {"sinh", sinh, mpfr_sinh},    {"cosh", cosh, mpfr_cosh},
    {"tanh", tanh, mpfr_tanh},    {"log", log, mpfr_log},       {"log2", log2, mpfr_log2},
    {"log10", log10, mpfr_log10}, {"asinh", asinh, mpfr_asinh}, {"acosh", acosh, mpfr_acosh},
    {"atanh", atanh, mpfr_atanh}};

const Function& function(const std::string& name) {
  return *std::find_if(functions.begin(), functions.end(), [&](const Function& f) { return f.name == name; });
}

/// A stream of random numbers in [0, 1).
class Stream {
public:
  double next() { return random_unit(1, RandomPurpose::test, ++count_, 0); }
  double between(double low, double high) { return low + (high - low) * next(); }
  /// Either sign, all powers of two between the two equally often.
  double any(int low, int high) {
    const double size = std::ldexp(1 + next(), static_cast<int>(std::floor(between(low, high))));
    return next() < 0.5 ? -size : size;
  }

private:
  std::uint64_t count_ = 0;
};

TEST(DoubleDouble, ProductsAndSumsAreExact) {
  Stream random;
  for (int k = 0; k < tries; ++k) {
    const double a = random.any(-40, 40), b = random.any(-40, 40);
    const DoubleDouble product = two_product(a, b), sum = two_sum(a, b);
    EXPECT_EQ(product.lo, std::fma(a, b, -product.hi));
    Wide exact(a), tail;
    mpfr_add_d(exact.get(), exact.get(), b, MPFR_RNDN);
    mpfr_sub_d(tail.get(), exact.get(), sum.hi, MPFR_RNDN);
    EXPECT_EQ(mpfr_cmp_d(tail.get(), sum.lo), 0);
  }
}

TEST(Elementary, ErrorsAreBoundedOnRandomArguments) {
  Stream random;
  for (const Function& f : functions) {
    double worst = 0;
    for (int k = 0; k < tries; ++k) {
      worst = std::max(worst, f.error(random.between(-8, 8)));
      worst = std::max(worst, f.error(random.between(-1, 1)));
      worst = std::max(worst, f.error(1 + random.any(-50, -1)));
      worst = std::max(worst, f.error(random.between(-760, 760)));
      worst = std::max(worst, f.error(random.any(-60, 60)));
      worst = std::max(worst, f.error(random.any(-1074, 1023)));
    }
    EXPECT_LT(worst, bound) << f.name;
  }
}

TEST(Elementary, ErrorsOfTwoArgumentsAreBounded) {
  Stream random;
  double powers = 0, angles = 0;
  for (int k = 0; k < 3 * tries; ++k) {
    powers = std::max(powers, error_of_pow(random.between(0, 10), random.between(-20, 20)));
    powers = std::max(powers, error_of_pow(random.between(-3, 3), std::floor(random.between(-12, 12))));
    powers = std::max(powers, error_of_pow(1 + random.any(-50, -2), random.any(0, 58)));
    const double base = std::fabs(random.any(-1074, 1023)); // results near to both ends of the range
    powers = std::max(powers, error_of_pow(base, random.between(-745.2, 709.8) / std::log(base)));
    powers = std::max(powers, error_of_pow(base, random.between(-745.2, -708) / std::log(base)));
    const int range = k % 3 == 0 ? 1 : k % 3 == 1 ? 60 : 1074;
    const double y = random.any(-range, std::min(range, 1023)), x = random.any(-range, std::min(range, 1023));
    Wide exact(y), other(x);
    mpfr_atan2(exact.get(), exact.get(), other.get(), MPFR_RNDN);
    angles = std::max(angles, error_of(atan2(y, x), exact));
  }
  EXPECT_LT(powers, bound);
  EXPECT_LT(angles, bound);
}

TEST(Elementary, AnglesNearToMultiplesOfTheTableAreReducedExactly) {
  // The double nearest to a multiple of pi/2, as far as such numbers go: 2^-61 beside it.
  const double hard = 0x1.6ac5b262ca1ffp+849;
  double worst = 0;
  Stream random;
  const Function &sine = function("sin"), &cosine = function("cos"), &tangent = function("tan");
  for (const Function* f : {&sine, &cosine, &tangent})
    for (const double x : {hard, -hard, std::numeric_limits<double>::max(), 0x1p+19, 0x1.fffffffffffffp+18, 1e22, 11.0})
      worst = std::max(worst, f->error(x));
  for (int k = 0; k < 3 * tries; ++k) {
    Wide angle;
    mpfr_const_pi(angle.get(), MPFR_RNDN);
    mpfr_mul_d(angle.get(), angle.get(), std::floor(std::fabs(random.any(0, 60))), MPFR_RNDN);
    mpfr_div_d(angle.get(), angle.get(), k % 2 == 0 ? 128 : 2, MPFR_RNDN);
    const double x = mpfr_get_d(angle.get(), MPFR_RNDN);
    for (const Function* f : {&sine, &cosine, &tangent})
      worst = std::max(worst, f->error(x));
  }
  EXPECT_LT(worst, bound);
}

TEST(Elementary, ResultsBelowTheNormalNumbersAreRoundedOnce) {
  Stream random;
  double worst = 0;
  for (int k = 0; k < tries; ++k) {
    worst = std::max(worst, function("exp").error(random.between(-745.2, -708)));
    worst = std::max(worst, error_of_pow(2, random.between(-1075.2, -1020)));
    worst = std::max(worst, error_of_pow(0.1, random.between(307, 323.5)));
  }
  EXPECT_LT(worst, 0.51);
  EXPECT_EQ(pow(2, -1074), 0x1p-1074);
  EXPECT_EQ(pow(2, -1075), 0); // half of it, to even
  EXPECT_EQ(exp(-745.13321910194110), 0x1p-1074);
}

TEST(Elementary, ExactValuesAreExact) {
  for (int n = -1074; n <= 1023; ++n) {
    EXPECT_EQ(log2(std::ldexp(1.0, n)), n);
    EXPECT_EQ(pow(2, n), std::ldexp(1.0, n));
  }
  double power = 1;
  for (int n = 0; n <= 22; ++n, power *= 10) {
    EXPECT_EQ(log10(power), n);
    EXPECT_EQ(pow(10, n), power);
  }
  EXPECT_EQ(pow(3, 33), 5559060566555523.0);
  EXPECT_EQ(pow(-7, 3), -343);
  EXPECT_EQ(pow(1.5, 4), 5.0625);
  EXPECT_EQ(pow(4, -0.5), 0.5);
  EXPECT_EQ(exp(0), 1);
  EXPECT_EQ(cos(0), 1);
  EXPECT_EQ(atan2(1, 1), 0x1.921fb54442d18p-1);
}

TEST(Elementary, NeighboursOfBorderlinesAreInOrder) {
  // Borders of tables, of series, and of reductions: the rising functions must not fall from one double to the next.
  const auto rises = [](double (*f)(double), double border) {
    double x = border;
    for (int k = 0; k < 12; ++k)
      x = std::nextafter(x, -infinity);
    for (int k = 0; k < 24; ++k) {
      const double next = std::nextafter(x, infinity);
      if (f(next) < f(x))
        return false;
      x = next;
    }
    return true;
  };
  for (int k = 1; k < 128; ++k) {
    EXPECT_TRUE(rises(exp, (k + 0.5) * 0x1.62e42fefa39efp-8)) << k;
    EXPECT_TRUE(rises(log, 0.6875 + k / 256.0)) << k;
    EXPECT_TRUE(rises(atan, (k + 0.5) / 64)) << k;
    EXPECT_TRUE(rises(asin, k / 128.0)) << k;
    EXPECT_TRUE(rises(tan, (k + 0.5) * 0x1.921fb54442d18p-5)) << k;
  }
  for (const double border : {0x1p-28, 0.125, 22.0}) {
    EXPECT_TRUE(rises(sinh, border)) << border;
    EXPECT_TRUE(rises(tanh, border)) << border;
    EXPECT_TRUE(rises(asinh, border)) << border;
    EXPECT_TRUE(border > 1 || rises(atanh, border)) << border;
    EXPECT_TRUE(rises(atan, border)) << border;
  }
}

} // namespace
} // namespace trime::elementary
