// SPDX-License-Identifier: BSD-3-Clause
// A real function of x and y given as text, such as `1 + 3*x + 3*y`: sizes and shapes of a config.
#pragma once

#include <memory>
#include <string>

namespace trime {

/// @brief Parsed expression in `x` and `y` with the constants `pi` and `e`. Move-only.
///
/// Operators are those of muParser: `+ - * / ^`, comparisons, `&& ||`, `condition ? a : b`. So are the functions:
/// `sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp ln log2 log10 sqrt sign rint abs min max sum
/// avg`, and `log`, which is the natural one. `rint` sends halves up.
///
/// The same text gives the same bits on every machine: functions and `^` are those of core/elementary, and operations
/// are done as they are written, one after the other.
class Formula {
public:
  /// @param where what the text belongs to, for messages, such as `config.ini:17: [sizing] expression`
  /// @throws ConfigError `where: ...` with the position (from 1), the text, and what was expected
  Formula(const std::string& text, const std::string& where);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// @brief Value at (x, y): may be infinite or NaN (1/0, sqrt(-1)), never throws. Thread-safe: each call takes a
  /// parser of its own, from a store with as many as the process had threads when the formula was made; no allocation.
  double evaluate(double x, double y) const;

  const std::string& text() const;
  const std::string& where() const;

private:
  struct Store;
  std::unique_ptr<Store> store_;
};

} // namespace trime
