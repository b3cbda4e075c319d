// SPDX-License-Identifier: BSD-3-Clause
#include "fields/field.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace trime::fields {
namespace {

/// The two centres next to a coordinate; they are equal if the axis has one centre only.
struct Between {
  std::int64_t low = 0, high = 0;
  double share = 0; ///< 0 at `low`, 1 at `high`
};

Between between(const Axis& axis, double coordinate) {
  const double index = axis.index(coordinate);
  if (!(index > 0)) // also for NaN
    return {0, axis.count > 1 ? 1 : 0, 0};
  if (index >= static_cast<double>(axis.count - 1))
    return axis.count > 1 ? Between{axis.count - 2, axis.count - 1, 1} : Between{};
  const auto low = static_cast<std::int64_t>(index);
  return {low, low + 1, index - static_cast<double>(low)};
}

/// The four centres around a place, with their values: south-west, south-east, north-west, north-east.
struct Corners {
  std::array<std::size_t, 4> at;
  std::array<double, 4> values;
  double u, v;

  double bilinear() const {
    return (1 - v) * ((1 - u) * values[0] + u * values[1]) + v * ((1 - u) * values[2] + u * values[3]);
  }
};

Corners corners_of(const Raster& raster, geometry::Vec2 p) {
  const Between x = between(raster.x, p.x), y = between(raster.y, p.y);
  Corners corners{{raster.index(x.low, y.low), raster.index(x.high, y.low), raster.index(x.low, y.high),
                   raster.index(x.high, y.high)},
                  {},
                  x.share,
                  y.share};
  for (std::size_t k = 0; k < 4; ++k)
    corners.values[k] = raster.value(corners.at[k]);
  return corners;
}

/// Where some values are filled.
double among_given(const Raster& raster, const Corners& corners) {
  const std::array<double, 4> weights{(1 - corners.u) * (1 - corners.v), corners.u * (1 - corners.v),
                                      (1 - corners.u) * corners.v, corners.u * corners.v};
  double sum = 0, weight = 0;
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (weights[k] > weights[nearest])
      nearest = k;
    if (raster.is_filled(corners.at[k]))
      continue;
    sum += weights[k] * corners.values[k];
    weight += weights[k];
  }
  return weight > 0 ? sum / weight : corners.values[nearest];
}

} // namespace

Field::Field(Raster raster, double period, double middle, std::optional<Raster> smooth)
    : raster_(std::move(raster)), smooth_(std::move(smooth)), period_(period), middle_(middle) {}

double Field::value(geometry::Vec2 p) const {
  if (period_ > 0)
    p.x += period_ * std::rint((middle_ - p.x) / period_);
  const Corners corners = corners_of(raster_, p);
  if (!raster_.filled.empty())
    for (const std::size_t at : corners.at)
      if (raster_.is_filled(at))
        return among_given(raster_, corners);
  return corners.bilinear();
}

geometry::Vec2 Field::gradient(geometry::Vec2 p) const {
  if (period_ > 0)
    p.x += period_ * std::rint((middle_ - p.x) / period_);
  const Corners corners = corners_of(smooth_ ? *smooth_ : raster_, p);
  const std::array<double, 4>& z = corners.values;
  const auto is_between = [](const Axis& axis, double at) {
    return axis.index(at) >= 0 && axis.index(at) <= static_cast<double>(axis.count - 1);
  };
  const double along = (1 - corners.v) * (z[1] - z[0]) + corners.v * (z[3] - z[2]);
  const double up = (1 - corners.u) * (z[2] - z[0]) + corners.u * (z[3] - z[1]);
  return {is_between(raster_.x, p.x) ? along / raster_.x.step : 0,
          is_between(raster_.y, p.y) ? up / raster_.y.step : 0};
}

} // namespace trime::fields
