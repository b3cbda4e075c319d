// SPDX-License-Identifier: BSD-3-Clause
// Converts coordinates along one axis of the container to integers.
#pragma once

#include <cmath>
#include <cstdint>

namespace trime::mesh {

/// @brief Fixed-point positions along one axis of the square of the Hilbert curve, which has 2^32 positions a side. The
/// container has the positions first() to last(), a multiple of 2^unit_shift positions. A larger coordinate never has a
/// smaller position.
class FixedAxis {
public:
  FixedAxis() = default;
  /// @param start coordinate where the container begins @param unit length of 2^unit_shift positions
  /// @param first_unit, units where the container begins, and its length, in units @pre unit > 0, (first_unit + units)
  /// * 2^unit_shift at most 2^32
  FixedAxis(double start, double unit, std::uint32_t first_unit, std::uint32_t units, int unit_shift, bool periodic)
      : start_(start), unit_(unit), scale_(std::ldexp(1.0, unit_shift) / unit),
        limit_(static_cast<std::uint32_t>((std::uint64_t{units} << unit_shift) - 1)), first_(first_unit << unit_shift),
        unit_shift_(unit_shift), periodic_(periodic) {}

  /// Returns the position of a coordinate, clamped to the container.
  std::uint32_t fixed(double at) const {
    const double v = (at - start_) * scale_;
    return first_ + (v <= 0 ? 0 : v >= static_cast<double>(limit_) ? limit_ : static_cast<std::uint32_t>(v));
  }
  /// Returns the position of a coordinate. It is not clamped if the axis is periodic, where images of the container
  /// follow each other.
  std::int64_t unrolled(double at) const {
    return periodic_ ? std::int64_t{first_} + static_cast<std::int64_t>(std::floor((at - start_) * scale_)) : fixed(at);
  }
  /// Returns the coordinate where a position begins.
  double coordinate(std::int64_t fixed) const {
    return start_ + std::ldexp(static_cast<double>(fixed - std::int64_t{first_}), -unit_shift_) * unit_;
  }
  std::int64_t first() const { return first_; }
  std::int64_t last() const { return std::int64_t{first_} + limit_; }
  /// Number of positions of the container.
  std::int64_t length() const { return std::int64_t{limit_} + 1; }
  bool is_periodic() const { return periodic_; }

private:
  double start_ = 0, unit_ = 1, scale_ = 1;
  std::uint32_t limit_ = 0, first_ = 0;
  int unit_shift_ = 0;
  bool periodic_ = false;
};

} // namespace trime::mesh
