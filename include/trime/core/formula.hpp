// SPDX-License-Identifier: BSD-3-Clause
// A real function of x and y that is given as text, such as `1 + 3*x + 3*y`, for sizes and shapes.
#pragma once

#include <memory>
#include <string>

namespace trime {

/// @brief Parsed expression in `x` and `y` with the constants `pi` and `e`. Move-only.
///
/// The operators are those of muParser: `+ - * / ^`, comparisons, `&& ||`, `condition ? a : b`. So are the functions:
/// `sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp ln log2 log10 sqrt sign rint abs min max sum
/// avg`, and `log`, which is the natural logarithm. `rint` rounds halves up.
///
/// One text gives the same bits on every machine: functions and `^` come from core/elementary, and operations are done
/// one after the other as they are written.
class Formula {
public:
  /// @param where where the text stands, for messages, such as `config.ini:17: [sizing] expression`
  /// @throws ConfigError `where: ...` with the position (from 1), the text, and what was expected
  Formula(const std::string& text, const std::string& where);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// @brief Returns the value at (x, y). It may be infinite or NaN (1/0, sqrt(-1)). Never throws and does not allocate.
  /// Thread-safe: each call takes a separate parser from a store, which has as many as the process had threads when the
  /// formula was made.
  double evaluate(double x, double y) const;

  const std::string& text() const;
  const std::string& where() const;

private:
  struct Store;
  std::unique_ptr<Store> store_;
};

} // namespace trime
