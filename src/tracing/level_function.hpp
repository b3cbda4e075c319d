// SPDX-License-Identifier: BSD-3-Clause
// The function of a traced shape, extended a little beyond the container so that its zero set is closed. Also finds a
// zero on a segment.
#pragma once

#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"
#include "trime/tracing/shape.hpp"

#include <optional>
#include <string>
#include <vector>

namespace trime::tracing {

/// The function of a traced shape, which is negative inside; zero counts as outside. The object is as thread-safe as
/// the function of the shape.
class LevelFunction {
public:
  /// Thrown for a value that is not finite. Loops over many points turn it into one error, the same for any number of
  /// threads.
  struct NotFinite {
    geometry::Vec2 place;
    double value;
  };

  LevelFunction(const std::string& name, const Shape& shape, const geometry::Box& container)
      : name_(name), shape_(shape), container_(container) {}

  /// @brief Makes the function rise outside of the container: by `slope` per unit of distance, and by more than
  /// -`lowest` before the distance `width`, so that it is positive there. `lowest` is the lowest value inside.
  void build_wall(double slope, double lowest, double width);

  /// Returns the value at p. Outside of the container, this is the value at the nearest point inside plus the rise.
  /// @throws NotFinite if the function is not finite
  double operator()(geometry::Vec2 p) const {
    const geometry::Vec2 nearest{std::fmin(std::fmax(p.x, container_.min.x), container_.max.x),
                                 std::fmin(std::fmax(p.y, container_.min.y), container_.max.y)};
    const double value = shape_.signed_distance(nearest);
    if (!std::isfinite(value))
      throw NotFinite{nearest, value};
    return p == nearest ? value : value + wall(geometry::length(p - nearest));
  }
  bool inside(geometry::Vec2 p) const { return (*this)(p) < 0; }

  /// @brief Returns the zero between a and b with an error of at most `tolerance`.
  /// @pre exactly one of value_a, value_b is negative
  geometry::Vec2 crossing(geometry::Vec2 a, double value_a, geometry::Vec2 b, double value_b, double tolerance) const;

  /// Calls body(item) for each item in [0, n) on all threads.
  /// @throws GeometryError for the lowest item whose value is not finite
  template <class Body>
  void for_all(std::size_t n, int chunk, const Body& body) const {
    std::vector<std::optional<NotFinite>> bad((n + chunk - 1) / chunk);
    thread_loop(static_cast<std::ptrdiff_t>(bad.size()), 1, [&](std::ptrdiff_t c, int) {
      try {
        const std::size_t first = static_cast<std::size_t>(c) * chunk;
        for (std::size_t item = first; item < std::min(n, first + chunk); ++item)
          body(item);
      } catch (const NotFinite& found) {
        bad[static_cast<std::size_t>(c)] = found;
      }
    });
    for (const std::optional<NotFinite>& found : bad)
      if (found)
        report(*found);
  }

  const std::string& name() const { return name_; }

private:
  double wall(double distance) const {
    return slope_ * distance + (distance > steep_from_ ? steep_slope_ * (distance - steep_from_) : 0);
  }
  [[noreturn]] void report(const NotFinite& found) const;

  const std::string& name_;
  const Shape& shape_;
  const geometry::Box container_;
  double slope_ = 1, steep_from_ = 0, steep_slope_ = 0;
};

} // namespace trime::tracing
