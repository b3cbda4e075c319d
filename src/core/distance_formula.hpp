// SPDX-License-Identifier: BSD-3-Clause
// A formula of x and y that may also use distances to parts of the boundary, such as `200 + 0.15*dist(coast)`, and data
// fields, such as `50*sqrt(abs(depth))`.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace trime {

/// A function of x and y. Threads call it concurrently.
using PlaceFunction = std::function<double(double, double)>;

/// Returns the distance to the part of the boundary with this name; the name is empty for the whole boundary.
/// @throws ConfigError that says what is wrong with the name
using DistanceLookup = std::function<PlaceFunction(const std::string&)>;

/// A data field, which is a variable of a formula.
struct FormulaField {
  std::string name;
  PlaceFunction value; ///< value of the variable at a place
  PlaceFunction slope; ///< value of `grad(NAME)`
};

/// Returns whether formulas use this name for something else than a data field, such as `x`, `sin` or `dist`.
bool is_word_of_formulas(const std::string& name);

/// @brief A Formula that may use `dist(NAME)` and `dist()`. A name with `)` in it must be in double quotes. The value
/// of the formula has the same bits on every machine if the distances have. Move-only.
class DistanceFormula {
public:
  /// @param lookup called once for each use of `dist`
  /// @param fields variables of the formula; their names are not words of formulas
  /// @throws ConfigError `where: ...` like a Formula, also if `lookup` throws one
  DistanceFormula(const std::string& text, const std::string& where, const DistanceLookup& lookup,
                  std::vector<FormulaField> fields = {});
  DistanceFormula(DistanceFormula&&) noexcept;
  DistanceFormula& operator=(DistanceFormula&&) noexcept;
  ~DistanceFormula();

  /// Returns the value at (x, y), which may be infinite or NaN. Thread-safe.
  double evaluate(double x, double y) const;
  const std::string& text() const;
  const std::string& where() const;
  /// Returns whether the text uses `dist`.
  bool uses_distances() const;
  /// Returns the names of the fields that the text uses, sorted.
  std::vector<std::string> fields() const;
  /// Returns the names in `grad(NAME)`, sorted.
  std::vector<std::string> slopes() const;

private:
  struct Store;
  std::unique_ptr<Store> store_;
};

} // namespace trime
