// SPDX-License-Identifier: BSD-3-Clause
#include "fields/nearest_fill.hpp"

#include <cmath>
#include <limits>

namespace trime::fields {
namespace {

constexpr std::int32_t none = -1;

/// For each cell, the nearest row of its column that has a value.
std::vector<std::int32_t> nearest_rows(const Raster& raster) {
  std::vector<std::int32_t> rows(raster.size(), none);
  const std::int64_t columns = raster.x.count, count = raster.y.count;
  for (std::int64_t row = 0; row < count; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      const std::size_t k = raster.index(column, row);
      if (!std::isnan(raster.value(k)))
        rows[k] = static_cast<std::int32_t>(row);
      else if (row > 0)
        rows[k] = rows[raster.index(column, row - 1)];
    }
  for (std::int64_t row = count - 2; row >= 0; --row)
    for (std::int64_t column = 0; column < columns; ++column) {
      const std::int32_t above = rows[raster.index(column, row + 1)];
      std::int32_t& here = rows[raster.index(column, row)];
      if (above != none && (here == none || above - row < row - here))
        here = above;
    }
  return rows;
}

/// The lower envelope of the parabolas (x - c)^2 + height(c) over the columns c of a row.
class Envelope {
public:
  void clear() {
    columns_.clear();
    heights_.clear();
    begins_.clear();
  }
  void add(std::int64_t column, double height, double step) {
    const auto key = [&](std::int64_t c, double h) { return h + std::pow(step * static_cast<double>(c), 2); };
    while (!columns_.empty()) {
      const double begin = (key(column, height) - key(columns_.back(), heights_.back())) /
                           (2 * step * step * static_cast<double>(column - columns_.back()));
      if (begin > begins_.back()) {
        push(column, height, begin);
        return;
      }
      pop();
    }
    push(column, height, -std::numeric_limits<double>::infinity());
  }
  /// Returns the column of the lowest parabola at a column. @param from where the search begins: columns must ascend
  std::int64_t lowest(std::int64_t column, std::size_t& from) const {
    while (from + 1 < columns_.size() && begins_[from + 1] < static_cast<double>(column))
      ++from;
    return columns_[from];
  }

private:
  void push(std::int64_t column, double height, double begin) {
    columns_.push_back(column);
    heights_.push_back(height);
    begins_.push_back(begin);
  }
  void pop() {
    columns_.pop_back();
    heights_.pop_back();
    begins_.pop_back();
  }
  std::vector<std::int64_t> columns_{};
  std::vector<double> heights_{}, begins_{};
};

} // namespace

void fill_with_nearest(Raster& raster) {
  std::vector<std::uint8_t> filled((raster.size() + 7) / 8, 0);
  std::size_t count = 0;
  for (std::size_t k = 0; k < raster.size(); ++k)
    if (std::isnan(raster.value(k))) {
      filled[k / 8] = static_cast<std::uint8_t>(filled[k / 8] | 1U << k % 8);
      ++count;
    }
  if (count == 0 || count == raster.size())
    return;
  const std::vector<std::int32_t> rows = nearest_rows(raster);
  raster.filled = std::move(filled);
  Envelope envelope;
  for (std::int64_t row = 0; row < raster.y.count; ++row) {
    envelope.clear();
    for (std::int64_t column = 0; column < raster.x.count; ++column)
      if (const std::int32_t at = rows[raster.index(column, row)]; at != none)
        envelope.add(column, std::pow(raster.y.step * static_cast<double>(at - row), 2), raster.x.step);
    std::size_t from = 0;
    for (std::int64_t column = 0; column < raster.x.count; ++column)
      if (const std::size_t k = raster.index(column, row); raster.is_filled(k)) {
        const std::int64_t source = envelope.lowest(column, from);
        raster.set(k, raster.value(raster.index(source, rows[raster.index(source, row)])));
      }
  }
}

} // namespace trime::fields
