// SPDX-License-Identifier: BSD-3-Clause
// Element size h(x): the target edge length. One of the two seams of the library (the other is the update rule).
#pragma once

#include "trime/geometry/vec2.hpp"

#include <limits>

namespace trime::sizing {

/// @brief Relative element size, positive; the mesher scales it by one factor to meet the requested number of points.
/// Called concurrently: implementations must be thread-safe and give the same bits on every rank.
class SizeField {
public:
  virtual ~SizeField() = default;
  virtual double size(geometry::Vec2 p) const = 0;
  /// True if the size is the same everywhere (allows the lattice start).
  virtual bool is_uniform() const { return false; }
};

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
  /// A NaN of the field stays one, for the caller to find.
  double size(geometry::Vec2 p) const override {
    const double size = factor_ * field_.size(p);
    return size < min_size_ ? min_size_ : size > max_size_ ? max_size_ : size;
  }
  bool is_uniform() const override { return field_.is_uniform(); }

private:
  const SizeField& field_;
  double factor_, min_size_, max_size_;
};

} // namespace trime::sizing
