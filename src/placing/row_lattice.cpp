// SPDX-License-Identifier: BSD-3-Clause
#include "placing/row_lattice.hpp"

#include "placing/rules.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::placing {

using geometry::Vec2;

namespace {

// [points asked for] See tolerated_stretch.
constexpr double tolerated_shortage = 0.002;

// [1] A lattice between two periods is stretched to fit them. A stretch of this much counts as bad as a shortage of
// tolerated_shortage when rows and columns are chosen.
constexpr double tolerated_stretch = 0.02;

constexpr double never = std::numeric_limits<double>::infinity();

struct Fit {
  std::int64_t columns = 0, rows = 0;
  double cost = never;
};

double square(double v) {
  return v * v;
}

Fit judge(std::int64_t columns, std::int64_t rows, double length, double width, double wanted) {
  const double m = static_cast<double>(columns), n = static_cast<double>(rows);
  const double stretch = (width / n) / (row_height * length / m) - 1;
  const double shear = rows % 2 == 0 ? 0 : 0.5 / n / row_height;
  const double shortage = std::fmax(0, wanted - m * n) / wanted;
  return {columns, rows,
          (square(stretch) + square(shear)) / square(tolerated_stretch) + square(shortage / tolerated_shortage)};
}

/// Best pair for rows of a `length`, as many as fit a `width`.
Fit best_fit(double length, double width, double spacing) {
  // A hair more, so that a lattice that fits exactly is not lost to rounding.
  const double wanted = length * width / (row_height * spacing * spacing) * (1 + 1e-9);
  const double ideal = length / spacing;
  const auto low = static_cast<std::int64_t>(std::fmax(1, std::floor(0.9 * ideal) - 2));
  const auto high = static_cast<std::int64_t>(std::ceil(1.1 * ideal) + 2);
  Fit best;
  for (std::int64_t columns = low; columns <= high; ++columns) {
    const auto rows = static_cast<std::int64_t>(wanted / static_cast<double>(columns));
    for (std::int64_t n = std::max<std::int64_t>(1, rows - 1); n <= rows; ++n)
      if (const Fit fit = judge(columns, n, length, width, wanted); fit.cost < best.cost)
        best = fit;
  }
  return best;
}

RowLattice make_lattice(const geometry::Periods& periods, const Fit& fit, Vec2 along) {
  const bool by_x = along.y == 0;
  const double length = by_x ? periods.x : periods.y, width = by_x ? periods.y : periods.x;
  if (fit.columns == 0)
    return {periods.min, along, 0, 0, 0, 0, 0};
  return {periods.min,
          along,
          length / static_cast<double>(fit.columns),
          width / static_cast<double>(fit.rows),
          fit.columns,
          fit.rows,
          fit.rows / 2};
}

} // namespace

RowLattice fit_to_periods(const geometry::Periods& periods, double spacing, Vec2 along) {
  const bool by_x = along.y == 0;
  const double length = by_x ? periods.x : periods.y, width = by_x ? periods.y : periods.x;
  if (width > 0)
    return make_lattice(periods, best_fit(length, width, spacing), along);
  if (spacing > length)
    return make_lattice(periods, {}, along);
  const double columns = std::round(length / spacing), fitted = length / columns;
  return {periods.min, along, fitted, row_height * spacing * spacing / fitted, static_cast<std::int64_t>(columns),
          0,           0};
}

RowLattice fit_to_periods(const geometry::Periods& periods, double spacing) {
  const Fit by_x = best_fit(periods.x, periods.y, spacing), by_y = best_fit(periods.y, periods.x, spacing);
  return by_y.cost < by_x.cost ? make_lattice(periods, by_y, {0, 1}) : make_lattice(periods, by_x, {1, 0});
}

} // namespace trime::placing
