// SPDX-License-Identifier: BSD-3-Clause
#include "core/formula_functions.hpp"

#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace trime {
namespace {

constexpr char power_sign = '\x7f'; // no text of a user has it: control characters are refused

double square_root(double x) {
  return std::sqrt(x); // IEEE 754 says how it is rounded
}

double magnitude(double x) {
  return std::fabs(x);
}

double sign(double x) {
  return x < 0 ? -1 : x > 0 ? 1 : 0;
}

/// The nearest integer; halves go up, as always in formulas.
double nearest_integer(double x) {
  const double below = std::floor(x);
  return x - below >= 0.5 ? below + 1 : below;
}

double sum(const double* list, int count) {
  double total = 0;
  for (int k = 0; k < count; ++k)
    total += list[k];
  return total;
}

double average(const double* list, int count) {
  return sum(list, count) / count;
}

double least(const double* list, int count) {
  double value = list[0];
  for (int k = 1; k < count; ++k)
    value = std::min(value, list[k]);
  return value;
}

double greatest(const double* list, int count) {
  double value = list[0];
  for (int k = 1; k < count; ++k)
    value = std::max(value, list[k]);
  return value;
}

void replace(std::string& text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
}

} // namespace

void define_functions(mu::Parser& parser) {
  parser.EnableOptimizer(false);
  parser.ClearFun();
  parser.DefineFun("sin", elementary::sin);
  parser.DefineFun("cos", elementary::cos);
  parser.DefineFun("tan", elementary::tan);
  parser.DefineFun("asin", elementary::asin);
  parser.DefineFun("acos", elementary::acos);
  parser.DefineFun("atan", elementary::atan);
  parser.DefineFun("atan2", elementary::atan2);
  parser.DefineFun("sinh", elementary::sinh);
  parser.DefineFun("cosh", elementary::cosh);
  parser.DefineFun("tanh", elementary::tanh);
  parser.DefineFun("asinh", elementary::asinh);
  parser.DefineFun("acosh", elementary::acosh);
  parser.DefineFun("atanh", elementary::atanh);
  parser.DefineFun("exp", elementary::exp);
  parser.DefineFun("ln", elementary::log);
  parser.DefineFun("log", elementary::log);
  parser.DefineFun("log2", elementary::log2);
  parser.DefineFun("log10", elementary::log10);
  parser.DefineFun("sqrt", square_root);
  parser.DefineFun("abs", magnitude);
  parser.DefineFun("sign", sign);
  parser.DefineFun("rint", nearest_integer);
  parser.DefineFun("sum", sum);
  parser.DefineFun("avg", average);
  parser.DefineFun("min", least);
  parser.DefineFun("max", greatest);
  const char sign_text[] = {power_sign, '\0'};
  parser.DefineOprtChars(sign_text);
  parser.DefineOprt(sign_text, elementary::pow, mu::prPOW, mu::oaRIGHT);
}

std::string with_our_power(std::string text) {
  replace(text, '^', power_sign);
  return text;
}

std::string with_usual_power(std::string text) {
  replace(text, power_sign, '^');
  return text;
}

} // namespace trime
