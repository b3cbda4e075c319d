// SPDX-License-Identifier: BSD-3-Clause
// Evaluates a real function of x and y that is given as text, such as `1 + 3*x + 3*y`. Sizes and shapes may be such
// formulas.
#pragma once

#include <memory>
#include <string>

namespace trime {

/// @brief A parsed expression in `x` and `y` with the constants `pi` and `e`. Move-only.
///
/// The operators are those of muParser: `+ - * / ^`, comparisons, `&&
/// `, `condition ? a : b`. The functions are also those of muParser: `sin cos tan asin acos atan atan2 sinh cosh tanh
/// asinh acosh atanh exp ln log2 log10 sqrt sign rint abs min max sum avg`, and `log`, which is the natural logarithm.
/// `rint` rounds halves up.
///
/// A formula gives the same bits on every machine: functions and `^` come from core/elementary.hpp, and operations are
/// done one after the other in the order in which they are written.
class Formula {
public:
  /// @param where the origin of the text for messages, such as `config.ini:17: [sizing] expression`
  /// @throws ConfigError `where: ...` with the position of the mistake (from 1), the text, and what the parser expected
  /// there
  Formula(const std::string& text, const std::string& where);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// @brief Returns the value at (x, y), which may be infinite or NaN (1/0, sqrt(-1)). Never throws and does not
  /// allocate. Thread-safe: each call borrows a parser from a store, which holds one parser for each thread that the
  /// process could use when the formula was made.
  double evaluate(double x, double y) const;

  const std::string& text() const;
  const std::string& where() const;

private:
  struct Store;
  std::unique_ptr<Store> store_;
};

} // namespace trime
