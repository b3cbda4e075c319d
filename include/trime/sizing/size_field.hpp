// SPDX-License-Identifier: BSD-3-Clause
// Element size h(x): the target edge length. One of the two seams of the library; the other is the shape.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <limits>

namespace trime::sizing {

/// @brief Relative element size, positive; the mesher scales it by one factor to meet the requested number of points.
/// Called concurrently: implementations must be thread-safe and give the same bits on every rank. Where the mesher
/// meets a value in the shape that is not positive and finite, all ranks throw a GeometryError with the place and the
/// value.
class SizeField {
public:
  virtual ~SizeField() = default;
  virtual double size(geometry::Vec2 p) const = 0;
  /// True if the size is the same everywhere (allows the lattice start).
  virtual bool is_uniform() const { return false; }
  /// Of tables of its own, for the report.
  virtual std::size_t memory_bytes() const { return 0; }
};

/// What the mesher expects of a size.
inline bool is_valid_size(double size) {
  return size > 0 && size <= std::numeric_limits<double>::max();
}

/// @throws GeometryError that names the place and the value
[[noreturn]] void fail_for_size(geometry::Vec2 p, double size);

/// The size at p. @throws GeometryError unless it is positive and finite, on this rank alone
inline double checked_size(const SizeField& field, geometry::Vec2 p) {
  const double size = field.size(p);
  if (!is_valid_size(size))
    fail_for_size(p, size);
  return size;
}

/// The same size everywhere.
class UniformSize final : public SizeField {
public:
  explicit UniformSize(double size = 1) : size_(size) {}
  double size(geometry::Vec2) const override { return size_; }
  bool is_uniform() const override { return true; }

private:
  double size_;
};

/// A size field times a factor, kept within absolute bounds.
class ScaledSize final : public SizeField {
public:
  /// @pre `field` outlives this object; 0 <= min_size <= max_size
  ScaledSize(const SizeField& field, double factor, double min_size = 0,
             double max_size = std::numeric_limits<double>::infinity())
      : field_(field), factor_(factor), min_size_(min_size), max_size_(max_size) {}
  /// What is no valid size comes through as it is, for the caller to find.
  double size(geometry::Vec2 p) const override {
    const double relative = field_.size(p);
    return is_valid_size(relative) ? scaled(relative) : relative;
  }
  /// The size where the field has a valid value.
  double scaled(double relative) const {
    const double size = factor_ * relative;
    return size < min_size_ ? min_size_ : size > max_size_ ? max_size_ : size;
  }
  double factor() const { return factor_; }
  bool is_uniform() const override { return field_.is_uniform(); }

private:
  const SizeField& field_;
  double factor_, min_size_, max_size_;
};

} // namespace trime::sizing
