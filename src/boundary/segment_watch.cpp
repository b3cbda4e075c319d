// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/segment_watch.hpp"

#include "core/random.hpp"

#include <cmath>

namespace trime::boundary {

using geometry::Vec2;

namespace {

/// Cells that share a key by chance only share their candidates.
std::uint64_t key_of(double column, double row) {
  return mix_bits(mix_bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(column))) ^
                  static_cast<std::uint64_t>(static_cast<std::int64_t>(row)));
}

} // namespace

void SegmentWatch::add(Vec2 a, Vec2 along, LocalIndex index) {
  const double length = geometry::length(along);
  if (!(length > 0))
    return; // no disc
  const int level = std::ilogb(length);
  const double cell = std::ldexp(1.0, level + 1);
  const Vec2 middle = a + 0.5 * along;
  levels_[level][key_of(std::floor(middle.x / cell), std::floor(middle.y / cell))].push_back({middle, index});
}

void SegmentWatch::find(Vec2 site, std::vector<LocalIndex>& found) const {
  for (const auto& [level, cells] : levels_) {
    const double cell = std::ldexp(1.0, level + 1); // twice the largest radius, and half of it to spare
    const auto images = [cell](double period) { return period > 0 ? 1 + static_cast<int>(cell / period) : 0; };
    for (int i = -images(periods_.x); i <= images(periods_.x); ++i)
      for (int j = -images(periods_.y); j <= images(periods_.y); ++j) {
        const Vec2 p = site + Vec2{i * periods_.x, j * periods_.y};
        const double column = std::floor(p.x / cell), row = std::floor(p.y / cell);
        for (double dx = -1; dx <= 1; ++dx)
          for (double dy = -1; dy <= 1; ++dy)
            if (const auto there = cells.find(key_of(column + dx, row + dy)); there != cells.end())
              for (const WatchedSegment& item : there->second)
                if (geometry::squared_length(item.middle - p) <= 0.27 * cell * cell) // the largest radius, and a little
                  found.push_back(item.index);
      }
  }
}

} // namespace trime::boundary
