// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/formula.hpp"

#include "core/angle.hpp"
#include "core/elementary.hpp"
#include "core/quoted.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <muParser.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace trime {
namespace {

/// @brief Replaces all functions of the parser and its power by ours, and has it compute what is written: muParser
/// would turn a x + b x into (a + b) x, and its library may fuse products and sums on some processors.
void define_functions(mu::Parser& parser);

/// @brief The text as the parser must see it, as long as before: muParser's own `^` cannot be replaced, so ours has
/// another sign there.
std::string with_our_power(std::string text);

/// @brief Takes that back, for messages.
std::string with_usual_power(std::string text);

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

constexpr std::size_t longest_text = 4096; // of a formula, in bytes

/// A parser with its variables, in separate cache lines.
struct alignas(64) Slot {
  std::atomic_flag taken = ATOMIC_FLAG_INIT;
  double x = 0, y = 0;
  mu::Parser parser;

  explicit Slot(const std::string& text) {
    define_functions(parser);
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    parser.DefineConst("pi", pi);
    parser.DefineConst("e", 0x1.5bf0a8b145769p+1);
    parser.SetExpr(with_our_power(text));
  }
};

std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names{"x", "y", "pi", "e"};
  for (const auto& function : parser.GetFunDef())
    names.push_back(function.first);
  return names;
}

/// Says what is wrong, without position and text.
std::string complaint(const mu::Parser& parser, const mu::ParserError& error) {
  const std::string token = with_usual_power(error.GetToken());
  switch (error.GetCode()) {
  case mu::ecUNASSIGNABLE_TOKEN: {
    if (!token.empty() && token.front() == '^') // as for the operators of muParser
      return "the operator '^' is not allowed here";
    if (!token.empty() && std::isalpha(static_cast<unsigned char>(token.front())) == 0)
      return fmt::format("'{}' cannot stand here", token);
    const std::vector<std::string> names = known_names(parser);
    const std::string near = token.size() > 1 ? suggestion(token, names) : ""; // every letter is near to x
    return fmt::format("unknown name '{}'{}", token,
                       near.empty() ? "; known are x, y, pi, e and functions such as sqrt, sin, min, max" : near);
  }
  case mu::ecUNEXPECTED_EOF:
    return "the expression ends too early";
  case mu::ecMISSING_PARENS:
    return "a parenthesis is not closed";
  case mu::ecUNEXPECTED_PARENS:
    return fmt::format("'{}' cannot stand here", token);
  case mu::ecUNEXPECTED_OPERATOR:
    return fmt::format("the operator '{}' is not allowed here", token);
  case mu::ecUNEXPECTED_VAL:
  case mu::ecUNEXPECTED_VAR:
  case mu::ecUNEXPECTED_FUN:
    return fmt::format("expected an operator before '{}'", token);
  case mu::ecTOO_MANY_PARAMS:
    return fmt::format("too many arguments for '{}'", token);
  case mu::ecTOO_FEW_PARAMS:
    return fmt::format("too few arguments for '{}'", token);
  default:
    return with_usual_power(error.GetMsg());
  }
}

[[noreturn]] void reject(const std::string& where, const std::string& text, std::size_t position,
                         const std::string& why) {
  throw ConfigError(
      fmt::format("{}: expected an expression in x and y, found '{}'; at position {}: {}", where, text, position, why));
}

/// An assignment would change x or y behind our back; muParser knows no other single '='.
void reject_assignment(const std::string& where, const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '=')
      continue;
    if (k + 1 < text.size() && text[k + 1] == '=')
      ++k;
    else if (k == 0 || (text[k - 1] != '<' && text[k - 1] != '>' && text[k - 1] != '!'))
      reject(where, text, k + 1, "an expression cannot assign values; write == to compare");
  }
}

} // namespace

struct Formula::Store {
  std::string text, where;
  std::vector<std::unique_ptr<Slot>> slots;

  Slot& take() {
    // A thread comes back to the parser that it had last, so that parsers rarely wander between caches.
    static std::atomic<std::size_t> threads{0};
    thread_local const std::size_t home = threads.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t k = home;; ++k) {
      Slot& slot = *slots[k % slots.size()];
      if (!slot.taken.test_and_set(std::memory_order_acquire))
        return slot;
      if (k - home >= slots.size()) // more threads than parsers: one of them will be free soon
        std::this_thread::yield();
    }
  }
};

Formula::Formula(const std::string& text, const std::string& where) : store_(std::make_unique<Store>()) {
  store_->text = text;
  store_->where = where;
  if (text.find_first_not_of(" \t") == std::string::npos)
    throw ConfigError(fmt::format("{}: expected an expression in x and y, found nothing", where));
  if (text.size() > longest_text)
    throw ConfigError(
        fmt::format("{}: expected an expression of at most {} characters, found {}", where, longest_text, text.size()));
  for (std::size_t k = 0; k < text.size(); ++k)
    if (std::iscntrl(static_cast<unsigned char>(text[k])) != 0 && text[k] != '\t')
      reject(where, text, k + 1, "control characters are not allowed in an expression");
  reject_assignment(where, text);
  const std::size_t count =
      std::clamp<std::size_t>(std::max<std::size_t>(thread_count(), std::thread::hardware_concurrency()), 1, 256);
  for (std::size_t k = 0; k < count; ++k) {
    store_->slots.push_back(std::make_unique<Slot>(text));
    Slot& slot = *store_->slots.back();
    try {
      slot.parser.Eval(); // translates the text once
      if (slot.parser.GetNumResults() != 1)
        reject(where, text, text.find(',') + 1, "expected one value, found several values separated by ','");
    } catch (const mu::ParserError& error) {
      const auto position = static_cast<std::ptrdiff_t>(error.GetPos());
      reject(where, text, position < 0 ? 1 : static_cast<std::size_t>(position) + 1, complaint(slot.parser, error));
    }
  }
}

Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::evaluate(double x, double y) const {
  Slot& slot = store_->take();
  slot.x = x;
  slot.y = y;
  double value = std::numeric_limits<double>::quiet_NaN();
  try {
    value = slot.parser.Eval();
  } catch (const mu::ParserError&) { // a domain error of a function
  }
  slot.taken.clear(std::memory_order_release);
  return value;
}

const std::string& Formula::text() const {
  return store_->text;
}

const std::string& Formula::where() const {
  return store_->where;
}

} // namespace trime
