// SPDX-License-Identifier: BSD-3-Clause
// Size fields: the target edge length h(x), as a uniform value, a scaled field, or a formula. Derive from SizeField to
// use your own size.
#pragma once

#include "trime/core/formula.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <limits>
#include <span>

namespace trime::sizing {

/// @brief A relative element size, which must be positive; the mesher scales it by one factor to reach the requested
/// number of points. Threads call it concurrently: implementations must be thread-safe and give the same bits on every
/// rank. If the mesher finds a value in the shape that is not positive and finite, all ranks throw a GeometryError with
/// the place and the value.
class SizeField {
public:
  virtual ~SizeField() = default;
  virtual double size(geometry::Vec2 p) const = 0;
  /// @brief Sets values[k] to size(places[k]), bit for bit. The default calls size for each place.
  /// @pre there are as many values as places
  virtual void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const;
  /// Returns true if one call of sizes is much faster than many calls of size, as for a function of an interpreter.
  /// Then the mesher calls sizes for up to 8192 places at a time wherever their number grows with that of the sites: in
  /// integrals of the density, in sweeps, and when it measures the quality. When it places sites on the boundary and in
  /// the clean-up, it still calls size for each place.
  virtual bool prefers_blocks() const { return false; }
  /// Returns true if the size is the same everywhere. Then a run can start from a hexagonal lattice.
  virtual bool is_uniform() const { return false; }
  /// Returns an upper bound on the growth of the size per unit of distance; infinity if it is not known. The mesher
  /// does not look for steep places of a size that is known to be gentle.
  virtual double largest_growth() const { return std::numeric_limits<double>::infinity(); }
  /// Returns whether the size jumps because the user asked for different sizes side by side. Then the mesher limits its
  /// growth without a warning.
  virtual bool jumps() const { return false; }
  /// Returns the number of bytes of the field's tables, for the report.
  virtual std::size_t memory_bytes() const { return 0; }
};

/// Returns whether the mesher accepts this size: it must be positive and finite.
inline bool is_valid_size(double size) {
  return size > 0 && size <= std::numeric_limits<double>::max();
}

/// Throws a GeometryError that names the place and the value.
/// @throws GeometryError always
[[noreturn]] void fail_for_size(geometry::Vec2 p, double size);

/// Returns the size at p.
/// @throws GeometryError on this rank alone if the size is not positive and finite
inline double checked_size(const SizeField& field, geometry::Vec2 p) {
  const double size = field.size(p);
  if (!is_valid_size(size))
    fail_for_size(p, size);
  return size;
}

/// A size with the same value everywhere.
class UniformSize final : public SizeField {
public:
  explicit UniformSize(double size = 1) : size_(size) {}
  double size(geometry::Vec2) const override { return size_; }
  bool is_uniform() const override { return true; }
  double largest_growth() const override { return 0; }

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
  ScaledSize(const SizeField&&, double, double = 0, double = 0) = delete;
  /// Returns the scaled size at p. An invalid value of the field is returned unchanged, so that the caller notices it.
  double size(geometry::Vec2 p) const override {
    const double relative = field_.size(p);
    return is_valid_size(relative) ? scaled(relative) : relative;
  }
  /// Returns the scaled size for a valid value of the field.
  double scaled(double relative) const {
    const double size = factor_ * relative;
    return size < min_size_ ? min_size_ : size > max_size_ ? max_size_ : size;
  }
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override { return field_.prefers_blocks(); }
  double factor() const { return factor_; }
  bool is_uniform() const override { return field_.is_uniform(); }

private:
  const SizeField& field_;
  double factor_, min_size_, max_size_;
};

/// @brief A relative size given by a formula of x and y. Only ratios of its values count, because the mesher scales the
/// size by one factor.
class ExpressionSize final : public SizeField {
public:
  /// Sizes below this share of the largest value on the checking grid are raised to it.
  static constexpr double smallest_share = 1e-6;
  /// Number of points of the checking grid along each axis of the box.
  static constexpr int check_points = 65;

  /// @brief Evaluates the formula on a grid over `box`, 65^2 times.
  /// @pre `formula` outlives this object
  /// @param box the bounding box of the shape
  /// @throws ConfigError that names the place and the value if the formula is not positive and finite on the grid
  ExpressionSize(const Formula& formula, const geometry::Box& box);
  ExpressionSize(const Formula&&, const geometry::Box&) = delete;

  /// @brief Returns the value of the formula, but at least smallest_share of the largest value on the checking grid.
  /// Outside of the box it uses the nearest point of the box. Between the points of the grid the formula may give an
  /// invalid value; this value is returned, and the mesher reports it.
  double size(geometry::Vec2 p) const override;

private:
  const Formula& formula_;
  geometry::Box box_;
  double smallest_ = 0;
};

} // namespace trime::sizing
