// SPDX-License-Identifier: BSD-3-Clause
// Coordinates along one axis of the container as integers.
#pragma once

#include <cmath>
#include <cstdint>

namespace trime::mesh {

/// @brief Fixed-point positions along one axis: the side of a tile is 2^tile_shift of them, the first tile starts at 0.
/// They never fall where the coordinate rises.
class FixedAxis {
public:
  FixedAxis() = default;
  /// @param start coordinate of the first tile @pre tile_side > 0, tiles * 2^tile_shift at most 2^32
  FixedAxis(double start, double tile_side, int tiles, int tile_shift, bool periodic)
      : start_(start), scale_(std::ldexp(1.0, tile_shift) / tile_side),
        limit_(static_cast<std::uint32_t>((static_cast<std::uint64_t>(tiles) << tile_shift) - 1)), periodic_(periodic) {
  }

  /// Clamped to the tiles.
  std::uint32_t fixed(double at) const {
    const double v = (at - start_) * scale_;
    return v <= 0 ? 0 : v >= static_cast<double>(limit_) ? limit_ : static_cast<std::uint32_t>(v);
  }
  /// Not clamped if the axis is periodic: images of the container follow each other.
  std::int64_t unrolled(double at) const {
    return periodic_ ? static_cast<std::int64_t>(std::floor((at - start_) * scale_)) : fixed(at);
  }

private:
  double start_ = 0, scale_ = 1;
  std::uint32_t limit_ = 0;
  bool periodic_ = false;
};

} // namespace trime::mesh
