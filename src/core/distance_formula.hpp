// SPDX-License-Identifier: BSD-3-Clause
// A formula of x and y that may also use distances to parts of the boundary, such as `200 + 0.15*dist(coast)`.
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

/// @brief A Formula that may use `dist(NAME)` and `dist()`. A name with `)` in it must be in double quotes. The value
/// of the formula has the same bits on every machine if the distances have. Move-only.
class DistanceFormula {
public:
  /// @param lookup called once for each use of `dist`
  /// @throws ConfigError `where: ...` like a Formula, also if `lookup` throws one
  DistanceFormula(const std::string& text, const std::string& where, const DistanceLookup& lookup);
  DistanceFormula(DistanceFormula&&) noexcept;
  DistanceFormula& operator=(DistanceFormula&&) noexcept;
  ~DistanceFormula();

  /// Returns the value at (x, y), which may be infinite or NaN. Thread-safe.
  double evaluate(double x, double y) const;
  const std::string& text() const;
  const std::string& where() const;
  /// Returns whether the text uses `dist`.
  bool uses_distances() const;

private:
  struct Store;
  std::unique_ptr<Store> store_;
};

} // namespace trime
