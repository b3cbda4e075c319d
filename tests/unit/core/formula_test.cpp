// SPDX-License-Identifier: BSD-3-Clause
// Formulas: values, errors that point at the place, and one formula shared by many threads.
#include "core/distance_formula.hpp"
#include "core/elementary.hpp"
#include "trime/core/error.hpp"
#include "trime/core/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

namespace trime {
namespace {

double value(const std::string& text, double x = 0, double y = 0) {
  return Formula(text, "test").evaluate(x, y);
}

std::string message(const std::string& text) {
  try {
    const Formula formula(text, "config.ini:17");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Formula, ComputesWithBothVariablesConstantsAndFunctions) {
  EXPECT_EQ(value("1+3*x+3*y", 0.5, 0.25), 3.25);
  EXPECT_EQ(value("x^2-y", 3, 1), 8);
  EXPECT_EQ(value("pi"), 0x1.921fb54442d18p+1);
  EXPECT_EQ(value("ln(e)"), 1);
  EXPECT_EQ(value("max(x, min(y, 2))", -1, 5), 2);
  EXPECT_EQ(value("x < 1e-3 ? 7 : 8", 0), 7);
  EXPECT_EQ(value("x == 2 && y <= 3", 2, 3), 1);
  EXPECT_EQ(value(" 4 "), 4);
  EXPECT_EQ(value("-x^2", 3), -9);
}

TEST(Formula, KnowsAllItsFunctionsByOurOwnBits) {
  const double x = 0.3, y = 2.7;
  EXPECT_EQ(value("sin(x)+2*cos(x)+4*tan(x)", x), elementary::sin(x) + 2 * elementary::cos(x) + 4 * elementary::tan(x));
  EXPECT_EQ(value("asin(x)", x), elementary::asin(x));
  EXPECT_EQ(value("acos(x)", x), elementary::acos(x));
  EXPECT_EQ(value("atan(x)", x), elementary::atan(x));
  EXPECT_EQ(value("atan2(y, x)", x, y), elementary::atan2(y, x));
  EXPECT_EQ(value("sinh(y)", x, y), elementary::sinh(y));
  EXPECT_EQ(value("cosh(y)", x, y), elementary::cosh(y));
  EXPECT_EQ(value("tanh(y)", x, y), elementary::tanh(y));
  EXPECT_EQ(value("asinh(y)", x, y), elementary::asinh(y));
  EXPECT_EQ(value("acosh(y)", x, y), elementary::acosh(y));
  EXPECT_EQ(value("atanh(x)", x, y), elementary::atanh(x));
  EXPECT_EQ(value("exp(x)", x), elementary::exp(x));
  EXPECT_EQ(value("ln(x)", x), elementary::log(x));
  EXPECT_EQ(value("log(x)", x), elementary::log(x));
  EXPECT_EQ(value("log2(x)", x), elementary::log2(x));
  EXPECT_EQ(value("log10(x)", x), elementary::log10(x));
  EXPECT_EQ(value("sqrt(2)"), 0x1.6a09e667f3bcdp+0);
  EXPECT_EQ(value("x^y", x, y), elementary::pow(x, y));
  EXPECT_EQ(value("x^3", x, y), elementary::pow(x, 3));
  EXPECT_EQ(value("min(3, x, y) + 8*max(3, x, y)", -1, 5), 39);
  EXPECT_EQ(value("sum(3, x, y) + 8*avg(x, y)", -1, 5), 23);
  EXPECT_EQ(value("abs(x) + 8*sign(x) + 64*sign(y)", -1, 5), 57);
  EXPECT_EQ(value("rint(x) + 16*rint(y)", -2.5, 2.5), 46); // halves go up
  EXPECT_EQ(value("rint(x)", 0x1.fffffffffffffp-2), 0);
}

TEST(Formula, ComputesWhatIsWrittenInTheOrderOfMathematics) {
  const double x = 0.7;
  EXPECT_EQ(value("0.1*x+0.2*x", x), 0.1 * x + 0.2 * x);
  EXPECT_NE(0.1 * x + 0.2 * x, (0.1 + 0.2) * x); // what an optimiser would make of it
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("2*x^2*3", 2), 24);
  EXPECT_EQ(value("10/x^2", 2), 2.5);
  EXPECT_EQ(value("x^-2", 2), 0.25);
  EXPECT_EQ(value("(-x)^2", 2), 4);
  EXPECT_EQ(value("x < 1 ? x^2 : x^y", 3, 3), 27);
}

TEST(Formula, ShowsByItsValueWhatCannotBeComputed) {
  EXPECT_FALSE(std::isfinite(value("1/x", 0)));
  EXPECT_TRUE(std::isnan(value("sqrt(x)", -1)));
  EXPECT_TRUE(std::isnan(value("0/x", 0)));
  EXPECT_EQ(value("1/x", 2), 0.5);
}

TEST(Formula, SaysWhereATextIsWrong) {
  EXPECT_EQ(message("1+3*z"), "config.ini:17: expected an expression in x and y, found '1+3*z'; at position 5: unknown "
                              "name 'z'; known are x, y, pi, e and functions such as sqrt, sin, min, max");
  EXPECT_EQ(message("x^^2"),
            "config.ini:17: expected an expression in x and y, found 'x^^2'; at position 3: the operator "
            "'^' is not allowed here");
  EXPECT_NE(message("x^*2").find("at position 3: the operator '*' is not allowed here"), std::string::npos);
  EXPECT_NE(message("sqr(x)").find("did you mean 'sqrt'?"), std::string::npos) << message("sqr(x)");
  for (const std::string text :
       {"",      "  ", "x +",    "(x",       "x)",   "x y", "x = 3", "x, y",    "sin()",  "sin(x, y)",
        "x $ y", "+",  "x += 1", "\"text\"", "x\ny", "2x",  "1..2",  "x = = 3", "x\x7fy", "x^"})
    EXPECT_NE(message(text).find("config.ini:17: expected an expression in x and y, found "), std::string::npos)
        << text << " -> " << message(text);
  EXPECT_NE(message(std::string(5000, '(')).find("at most 4096"), std::string::npos);
}

TEST(Formula, AnswersManyThreadsAtOnce) {
  const Formula formula("x*x + sin(y)", "test");
  std::vector<int> wrong(8, 0);
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 8; ++thread)
    threads.emplace_back([&, thread] {
      for (int k = 0; k < 20000; ++k) {
        const double x = thread + 1e-3 * k, y = k - 100.0 * thread;
        wrong[thread] += formula.evaluate(x, y) != x * x + elementary::sin(y);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(wrong, std::vector<int>(8, 0));
}

/// Every name has a distance of as many lengths as it has letters.
PlaceFunction letters(const std::string& name) {
  if (name == "cost")
    throw ConfigError("no part has this name");
  return [size = static_cast<double>(name.size())](double x, double) { return x + size; };
}

TEST(Formula, UsesDistancesToNamedParts) {
  const auto value_with = [](const std::string& text) {
    return DistanceFormula(text, "test", letters).evaluate(100, 0);
  };
  EXPECT_EQ(value_with("dist()"), 100);
  EXPECT_EQ(value_with("min(2000, 2*dist(open sea) + dist( \"a)b\" ))"), 2 * 108 + 103);
}

TEST(Formula, RefusesDistancesWhereTheyAreNotKnown) {
  EXPECT_NE(message("1+dist(coast)").find("at position 3: dist(NAME)"), std::string::npos) << message("1+dist(coast)");
  EXPECT_THROW(DistanceFormula("1+dist(cost)", "test", letters), ConfigError);
  EXPECT_THROW(DistanceFormula("1+dist(coast", "test", letters), ConfigError);
}

} // namespace
} // namespace trime
