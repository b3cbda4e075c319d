// SPDX-License-Identifier: BSD-3-Clause
#include "fields/smooth.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trime::fields {
namespace {

constexpr std::int64_t least_rows = 64; // in a block; with few rows, those around a block would be summed too often

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

/// Sums along one row.
void sum_row(const Raster& raster, std::int64_t row, double width, Weighted* sums) {
  const std::vector<double> weights = weights_of(width, raster.x.count);
  const auto reach = std::ssize(weights) - 1;
  for (std::int64_t column = 0; column < raster.x.count; ++column) {
    Weighted& here = sums[column];
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

/// Rows of sums, [first, end).
struct Block {
  std::int64_t first = 0, end = 0;
  std::vector<Weighted> sums{};

  const Weighted* row(std::int64_t row, std::int64_t columns) const { return sums.data() + (row - first) * columns; }
};

/// Joins the sums of the rows around a row, and sets its values.
void join_rows(const Block& block, const std::vector<double>& weights, std::int64_t row, Raster& result) {
  const std::int64_t columns = result.x.count, reach = std::ssize(weights) - 1;
  const std::int64_t first = std::max(block.first, row - reach), end = std::min(block.end, row + reach + 1);
  std::vector<Weighted> joined(static_cast<std::size_t>(columns));
  for (std::int64_t other = first; other < end; ++other) {
    const double weight = weights[static_cast<std::size_t>(std::abs(other - row))];
    const Weighted* sums = block.row(other, columns);
    for (std::int64_t column = 0; column < columns; ++column) {
      Weighted& here = joined[static_cast<std::size_t>(column)];
      here.sum += weight * sums[column].sum;
      here.weight += weight * sums[column].weight;
    }
  }
  for (std::int64_t column = 0; column < columns; ++column)
    if (const Weighted& here = joined[static_cast<std::size_t>(column)]; here.weight > 0)
      result.set(result.index(column, row), here.sum / here.weight);
}

} // namespace

Raster smoothed(const Raster& raster, const SmoothReach& reach) {
  Raster result = raster;
  result.filled.clear();
  const std::int64_t rows = raster.y.count, columns = raster.x.count;
  const std::vector<double> weights = weights_of(reach.in_column, rows);
  const std::int64_t around = std::ssize(weights) - 1, at_once = std::max(least_rows, around);
  for (std::int64_t first = 0; first < rows; first += at_once) {
    const std::int64_t end = std::min(rows, first + at_once);
    Block block{std::max<std::int64_t>(0, first - around), std::min(rows, end + around)};
    block.sums.resize(static_cast<std::size_t>((block.end - block.first) * columns));
    thread_loop(block.end - block.first, 1, [&](std::ptrdiff_t k, int) {
      const std::int64_t row = block.first + k;
      sum_row(raster, row, reach.in_row(row), block.sums.data() + k * columns);
    });
    thread_loop(end - first, 1, [&](std::ptrdiff_t k, int) { join_rows(block, weights, first + k, result); });
  }
  return result;
}

} // namespace trime::fields
