// SPDX-License-Identifier: BSD-3-Clause
#include "fields/smooth.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trime::fields {
namespace {

constexpr std::int64_t sums_at_once = std::int64_t{1} << 22; // 64 MB

/// A weighted sum of values, and the sum of their weights.
struct Weighted {
  double sum = 0, weight = 0;
};

/// The weights 1 - |k| / width of the whole numbers k with |k| < width; at least that of 0.
std::vector<double> weights_of(double width, std::int64_t most) {
  std::vector<double> weights{1};
  for (std::int64_t k = 1; static_cast<double>(k) < width && k < most; ++k)
    weights.push_back(1 - static_cast<double>(k) / width);
  return weights;
}

/// Sums of columns [first, end) along all rows.
struct Strip {
  std::int64_t first = 0, end = 0;
  std::vector<Weighted>& sums;

  Weighted* row(std::int64_t row) const { return sums.data() + row * (end - first); }
};

/// Sums along one row.
void sum_row(const Raster& raster, std::int64_t row, double width, const Strip& strip) {
  const std::vector<double> weights = weights_of(width, raster.x.count);
  const auto reach = std::ssize(weights) - 1;
  for (std::int64_t column = strip.first; column < strip.end; ++column) {
    Weighted& here = strip.row(row)[column - strip.first];
    here = {};
    const std::int64_t end = std::min(raster.x.count - 1, column + reach);
    for (std::int64_t other = std::max<std::int64_t>(0, column - reach); other <= end; ++other) {
      const std::size_t k = raster.index(other, row);
      if (raster.is_filled(k))
        continue;
      const double weight = weights[static_cast<std::size_t>(std::abs(other - column))];
      here.sum += weight * raster.value(k);
      here.weight += weight;
    }
  }
}

/// Joins the sums of the rows around a row, and sets its values.
void join_rows(const Strip& strip, const std::vector<double>& weights, std::int64_t row, Raster& result) {
  const std::int64_t columns = strip.end - strip.first, reach = std::ssize(weights) - 1;
  const std::int64_t first = std::max<std::int64_t>(0, row - reach), end = std::min(result.y.count, row + reach + 1);
  std::vector<Weighted> joined(static_cast<std::size_t>(columns));
  for (std::int64_t other = first; other < end; ++other) {
    const double weight = weights[static_cast<std::size_t>(std::abs(other - row))];
    const Weighted* sums = strip.row(other);
    for (std::int64_t column = 0; column < columns; ++column) {
      Weighted& here = joined[static_cast<std::size_t>(column)];
      here.sum += weight * sums[column].sum;
      here.weight += weight * sums[column].weight;
    }
  }
  for (std::int64_t column = 0; column < columns; ++column)
    if (const Weighted& here = joined[static_cast<std::size_t>(column)]; here.weight > 0)
      result.set(result.index(strip.first + column, row), here.sum / here.weight);
}

} // namespace

Raster smoothed(const Raster& raster, const SmoothReach& reach) {
  Raster result = raster;
  result.filled.clear();
  const std::int64_t rows = raster.y.count, columns = raster.x.count;
  const std::int64_t at_once = std::clamp<std::int64_t>(sums_at_once / rows, 1, columns);
  const std::vector<double> weights = weights_of(reach.in_column, rows);
  std::vector<Weighted> sums(static_cast<std::size_t>(at_once * rows));
  for (std::int64_t first = 0; first < columns; first += at_once) {
    const Strip strip{first, std::min(columns, first + at_once), sums};
    thread_loop(rows, 1, [&](std::ptrdiff_t row, int) { sum_row(raster, row, reach.in_row(row), strip); });
    thread_loop(rows, 1, [&](std::ptrdiff_t row, int) { join_rows(strip, weights, row, result); });
  }
  return result;
}

} // namespace trime::fields
