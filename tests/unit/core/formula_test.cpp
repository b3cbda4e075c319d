// SPDX-License-Identifier: BSD-3-Clause
// Formulas: values, errors that point at the place, and one formula shared by many threads.
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

TEST(Formula, ShowsByItsValueWhatCannotBeComputed) {
  EXPECT_FALSE(std::isfinite(value("1/x", 0)));
  EXPECT_TRUE(std::isnan(value("sqrt(x)", -1)));
  EXPECT_TRUE(std::isnan(value("0/x", 0)));
  EXPECT_EQ(value("1/x", 2), 0.5);
}

TEST(Formula, SaysWhereATextIsWrong) {
  EXPECT_EQ(message("1+3*z"), "config.ini:17: expected an expression in x and y, found '1+3*z'; at position 5: unknown "
                              "name 'z'; known are x, y, pi, e and functions such as sqrt, sin, min, max");
  EXPECT_NE(message("sqr(x)").find("did you mean 'sqrt'?"), std::string::npos) << message("sqr(x)");
  for (const std::string text : {"", "  ", "x +", "(x", "x)", "x y", "x = 3", "x, y", "sin()", "sin(x, y)", "x $ y",
                                 "+", "x += 1", "\"text\"", "x\ny", "2x", "1..2", "x = = 3"})
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
        wrong[thread] += formula.evaluate(x, y) != x * x + std::sin(y);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(wrong, std::vector<int>(8, 0));
}

} // namespace
} // namespace trime
