// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions: special values of the C standard, and bits that are the same on every machine.
#include "core/elementary.hpp"
#include "core/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace trime::elementary {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 0x1.921fb54442d18p+1, least = 0x1p-1074, largest = std::numeric_limits<double>::max();

struct Function {
  std::string name;
  double (*of)(double);
  std::uint64_t hash; // of the bits of 2000 values
};

// Hashes of an x86-64 build of g++ 12; every machine and compiler must find the same.
const std::vector<Function> functions{
    {"sin", elementary::sin, 0x02f73f11ac1de805u},     {"cos", elementary::cos, 0xac354c745baa5319u},
    {"tan", elementary::tan, 0xeb68e890d0e2563bu},     {"asin", elementary::asin, 0x5c2f4ef8c99af655u},
    {"acos", elementary::acos, 0x9fdcdf145ecc3655u},   {"atan", elementary::atan, 0xf3db6ddd645704ffu},
    {"exp", elementary::exp, 0x5e792010768c4b25u},     {"sinh", elementary::sinh, 0x22a3c2cc19afe23bu},
    {"cosh", elementary::cosh, 0xc99a822ae224e9aeu},   {"tanh", elementary::tanh, 0xaee799de3a1ac3e7u},
    {"log", elementary::log, 0x778272c0edf88921u},     {"log2", elementary::log2, 0x23dd3487aaf933c2u},
    {"log10", elementary::log10, 0xf37282762c820f4cu}, {"asinh", elementary::asinh, 0x9d00cb002f15b603u},
    {"acosh", elementary::acosh, 0x2b54f29cfed5fda7u}, {"atanh", elementary::atanh, 0x30f23e02bce85a4bu}};
constexpr std::uint64_t pow_hash = 0xdd004ddb1a06e846u, atan2_hash = 0x31bc70569139f4e6u;

/// The same number, with the sign of a zero; or both are NaN.
bool same(double a, double b) {
  return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Even numbers k: uniform in [-8, 8); odd ones: any bits but those of NaN.
double argument(std::uint64_t k) {
  const std::uint64_t bits = random_bits(7, RandomPurpose::test, k, 0);
  const double any = std::bit_cast<double>(bits);
  return k % 2 == 0 || any != any ? random_unit(7, RandomPurpose::test, k, 1) * 16 - 8 : any;
}

/// Adds the bits of a value; all NaN are one.
std::uint64_t mixed(std::uint64_t hash, double value) {
  return mix_bits(hash ^ (value != value ? 0 : std::bit_cast<std::uint64_t>(value)));
}

std::uint64_t hash_of(double (*f)(double, double)) {
  std::uint64_t hash = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) // both of one kind, then one of each
    hash = mixed(hash, f(argument(k), argument(k + 5000 + k / 1000)));
  return hash;
}

TEST(ElementaryValues, AreTheSameBitsOnEveryMachine) {
  for (const Function& f : functions) {
    std::uint64_t hash = 0;
    for (std::uint64_t k = 0; k < 2000; ++k)
      hash = mixed(hash, f.of(argument(k)));
    EXPECT_EQ(hash, f.hash) << f.name << std::hex << " 0x" << hash;
  }
  EXPECT_EQ(hash_of(pow), pow_hash) << std::hex << "0x" << hash_of(pow);
  EXPECT_EQ(hash_of(atan2), atan2_hash) << std::hex << "0x" << hash_of(atan2);
}

TEST(ElementaryValues, StayOnRecord) {
  EXPECT_EQ(sin(1), 0x1.aed548f090ceep-1);
  EXPECT_EQ(sin(1e+22), -0x1.b453ab76bf397p-1);
  EXPECT_EQ(cos(2.5), -0x1.9a2f7ef858b7dp-1);
  EXPECT_EQ(cos(-100000), -0x1.ffac3841b3da7p-1);
  EXPECT_EQ(tan(1.5), 0x1.c33ed50b88777p+3);
  EXPECT_EQ(tan(-0.69999999999999996), -0x1.af406c2fc78aep-1);
  EXPECT_EQ(asin(0.29999999999999999), 0x1.380159e14f6ffp-2);
  EXPECT_EQ(asin(-0.98999999999999999), -0x1.6de3c6f33d51dp+0);
  EXPECT_EQ(acos(0.29999999999999999), 0x1.441f5ecbeef59p+0);
  EXPECT_EQ(acos(-0.98999999999999999), 0x1.8001be1bc011bp+1);
  EXPECT_EQ(atan(0.59999999999999998), 0x1.14b1dd5f90ce1p-1);
  EXPECT_EQ(atan(-30), -0x1.8997fbb8b19cp+0);
  EXPECT_EQ(exp(1), 0x1.5bf0a8b145769p+1);
  EXPECT_EQ(exp(-740.25), 0x0.0000000000042p-1022);
  EXPECT_EQ(sinh(0.20000000000000001), 0x1.9c560cd35ef81p-3);
  EXPECT_EQ(sinh(5), 0x1.28d0166f07374p+6);
  EXPECT_EQ(cosh(0.20000000000000001), 0x1.0523184b1ee9dp+0);
  EXPECT_EQ(cosh(-700), 0x1.d945df4f8ec8ep+1008);
  EXPECT_EQ(tanh(0.20000000000000001), 0x1.9439830b3a59p-3);
  EXPECT_EQ(tanh(-3), -0x1.fd77d111a0bp-1);
  EXPECT_EQ(log(3), 0x1.193ea7aad030bp+0);
  EXPECT_EQ(log(0.98999999999999999), -0x1.495453e6fd4bcp-7);
  EXPECT_EQ(log2(3), 0x1.95c01a39fbd68p+0);
  EXPECT_EQ(log2(9.9999999999999694e-311), -0x1.01730dabca5f6p+10);
  EXPECT_EQ(log10(3), 0x1.e8927964fd5fdp-2);
  EXPECT_EQ(log10(1.0000000000000001e+300), 0x1.2cp+8);
  EXPECT_EQ(asinh(0.10000000000000001), 0x1.98eb9e7e5fc3ep-4);
  EXPECT_EQ(asinh(-1000000000), -0x1.56a9a0b23d188p+4);
  EXPECT_EQ(acosh(1.0625), 0x1.682dd8ac1096dp-2);
  EXPECT_EQ(acosh(20), 0x1.d818b3e5d4c5fp+1);
  EXPECT_EQ(atanh(0.10000000000000001), 0x1.9af93cd234412p-4);
  EXPECT_EQ(atanh(-0.75), -0x1.f2272ae325a57p-1);
  EXPECT_EQ(pow(10, 0.29999999999999999), 0x1.fec982d5bb8afp+0);
  EXPECT_EQ(pow(0.69999999999999996, -11), 0x1.94962e991c879p+5);
  EXPECT_EQ(pow(1.0000001000000001, 1000000000), 0x1.349445c228792p+144);
  EXPECT_EQ(pow(3, 3), 0x1.bp+4);
  EXPECT_EQ(atan2(1, -3), 0x1.68f095fdf593cp+1);
  EXPECT_EQ(atan2(-2, 0.5), -0x1.5368c951e9cfdp+0);
  EXPECT_EQ(atan2(9.9999999999999998e-201, 2.9999999999999999e-200), 0x1.4978fa3269ee1p-2);
  EXPECT_EQ(atan2(-1, -1000000000000), -0x1.921fb5444244cp+1);
}

TEST(ElementaryValues, ZerosInfinitiesAndNaNFollowTheStandard) {
  struct Case {
    double (*of)(double);
    double x, value;
  };
  const std::vector<Case> cases{
      {sin, inf, nan},     {sin, -inf, nan},      {cos, inf, nan},      {cos, -0.0, 1},       {tan, inf, nan},
      {asin, 1, pi / 2},   {asin, -1, -pi / 2},   {asin, 1.0001, nan},  {asin, -inf, nan},    {acos, 1, 0.0},
      {acos, -1, pi},      {acos, 0, pi / 2},     {acos, -0.0, pi / 2}, {acos, -1.0001, nan}, {acos, inf, nan},
      {atan, inf, pi / 2}, {atan, -inf, -pi / 2}, {exp, inf, inf},      {exp, -inf, 0.0},     {exp, -0.0, 1},
      {exp, 709.79, inf},  {exp, 1e300, inf},     {exp, -745.2, 0.0},   {exp, -1e300, 0.0},   {exp, least, 1},
      {sinh, inf, inf},    {sinh, -inf, -inf},    {sinh, 710.5, inf},   {sinh, -1e300, -inf}, {cosh, inf, inf},
      {cosh, -inf, inf},   {cosh, 0, 1},          {cosh, -710.5, inf},  {tanh, inf, 1},       {tanh, -inf, -1},
      {log, 0.0, -inf},    {log, -0.0, -inf},     {log, -1, nan},       {log, -inf, nan},     {log, inf, inf},
      {log, 1, 0.0},       {log2, 0.0, -inf},     {log2, -least, nan},  {log2, inf, inf},     {log2, 1, 0.0},
      {log10, -0.0, -inf}, {log10, -1, nan},      {log10, inf, inf},    {log10, 1, 0.0},      {asinh, inf, inf},
      {asinh, -inf, -inf}, {acosh, 1, 0.0},       {acosh, 0.9999, nan}, {acosh, -inf, nan},   {acosh, inf, inf},
      {atanh, 1, inf},     {atanh, -1, -inf},     {atanh, 1.0001, nan}, {atanh, -inf, nan}};
  for (const Case& c : cases)
    EXPECT_TRUE(same(c.of(c.x), c.value)) << "case " << &c - cases.data() << ": " << c.x << " -> " << c.of(c.x);
  for (const Function& f : functions)
    EXPECT_TRUE(std::isnan(f.of(nan))) << f.name;
  for (double (*odd)(double) : {sin, tan, asin, atan, sinh, tanh, asinh, atanh})
    for (const double x : {0.0, -0.0, least, -least, 1e-310, -0x1p-1022, 1e-20})
      EXPECT_TRUE(same(odd(x), x)) << x;
}

TEST(ElementaryValues, PowFollowsTheTableOfTheStandard) {
  struct Case {
    double x, y, value;
  };
  const std::vector<Case> cases{{0.0, -3, inf},
                                {-0.0, -3, -inf},
                                {-0.0, -1, -inf},
                                {0.0, -2.5, inf},
                                {-0.0, -2, inf},
                                {-0.0, -2.5, inf},
                                {0.0, -inf, inf},
                                {-0.0, -inf, inf},
                                {0.0, 3, 0.0},
                                {-0.0, 3, -0.0},
                                {-0.0, 1, -0.0},
                                {-0.0, 2, 0.0},
                                {-0.0, 0.5, 0.0},
                                {-1, inf, 1},
                                {-1, -inf, 1},
                                {1, nan, 1},
                                {1, inf, 1},
                                {nan, 0, 1},
                                {nan, -0.0, 1},
                                {inf, 0, 1},
                                {-8, 1.0 / 3, nan},
                                {-2, 0.5, nan},
                                {0.5, -inf, inf},
                                {-1.5, -inf, 0.0},
                                {0.5, inf, 0.0},
                                {-1.5, inf, inf},
                                {-inf, -3, -0.0},
                                {-inf, -2, 0.0},
                                {-inf, -0.5, 0.0},
                                {-inf, 3, -inf},
                                {-inf, 2, inf},
                                {-inf, 0.5, inf},
                                {inf, -1, 0.0},
                                {inf, 0.1, inf},
                                {nan, 1, nan},
                                {2, nan, nan},
                                {nan, 2, nan},
                                {-2, 0x1p+53, inf},
                                {-2, 0x1p+60, inf},
                                {-2, 1025, -inf},
                                {-2, -1075, -0.0},
                                {2, 1024, inf},
                                {1e200, 1e300, inf},
                                {1e200, -1e300, 0.0},
                                {0.5, 1e300, 0.0},
                                {3, least, 1},
                                {largest, 2, inf},
                                {-least, 3, -0.0},
                                {-largest, 3, -inf},
                                {least, -1, inf},
                                {least, 0.5, 0x1p-537},
                                {2, 0.0, 1},
                                {-3, -1, -1.0 / 3},
                                {0x1p-300, 4, 0.0},
                                {-0x1p+300, 3, -0x1p+900},
                                {-1, 1e15 + 1, -1}};
  for (const Case& c : cases)
    EXPECT_TRUE(same(pow(c.x, c.y), c.value)) << c.x << " ^ " << c.y << " -> " << pow(c.x, c.y);
}

TEST(ElementaryValues, AnglesOfVectorsFollowTheTableOfTheStandard) {
  struct Case {
    double y, x, value;
  };
  const std::vector<Case> cases{{0.0, -0.0, pi},
                                {0.0, 0.0, 0.0},
                                {0.0, -1, pi},
                                {0.0, 1, 0.0},
                                {1, 0.0, pi / 2},
                                {1, -0.0, pi / 2},
                                {1, -inf, pi},
                                {1, inf, 0.0},
                                {inf, 1, pi / 2},
                                {inf, -1, pi / 2},
                                {inf, -inf, 0.75 * pi},
                                {inf, inf, pi / 4},
                                {least, 1, least},
                                {1, least, pi / 2},
                                {least, -1, pi},
                                {least, least, pi / 4},
                                {least, largest, 0.0},
                                {largest, least, pi / 2},
                                {largest, largest, pi / 4},
                                {1, nan, nan},
                                {inf, nan, nan}};
  for (const Case& c : cases) {
    EXPECT_TRUE(same(atan2(c.y, c.x), c.value)) << c.y << ", " << c.x << " -> " << atan2(c.y, c.x);
    EXPECT_TRUE(same(atan2(-c.y, c.x), -c.value)) << -c.y << ", " << c.x << " -> " << atan2(-c.y, c.x);
  }
  EXPECT_TRUE(std::isnan(atan2(nan, 1)));
}

} // namespace
} // namespace trime::elementary
