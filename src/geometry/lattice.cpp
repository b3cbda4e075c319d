// SPDX-License-Identifier: BSD-3-Clause

#include "trime/geometry/lattice.hpp"

#include "trime/core/error.hpp"

#include <cmath>

namespace trime::geometry {

namespace {

const Box& checked(const Box& container) {
  const double width = container.width(), height = container.height();
  if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height)))
    throw GeometryError(fmt::format("expected a container whose width and height are positive and finite, found [{}, "
                                    "{}] x [{}, {}]",
                                    container.min.x, container.max.x, container.min.y, container.max.y));
  return container;
}

} // namespace

Box container_around(const Box& box) {
  constexpr double margin = 0.05; // of the longer side: as much as users leave who give the container themselves
  if (!(box.width() > 0 && box.height() > 0) || (unit_square.contains(box.min) && unit_square.contains(box.max)))
    return unit_square;
  const double side = margin * std::fmax(box.width(), box.height());
  return {box.min - Vec2{side, side}, box.max + Vec2{side, side}};
}

Frame::Frame(const Box& container, bool periodic_x, bool periodic_y)
    : container_(checked(container)), lattice_(container),
      periods_(Periods::of(container_, lattice_, periodic_x, periodic_y)) {
  const double step = lattice_.step(), inverse = lattice_.inverse_step();
  inner_.min = {std::ceil(container.min.x * inverse) * step, std::ceil(container.min.y * inverse) * step};
  inner_.max = {std::floor(container.max.x * inverse) * step, std::floor(container.max.y * inverse) * step};
  if (periods_.x > 0)
    inner_.max.x = inner_.min.x + periods_.x;
  if (periods_.y > 0)
    inner_.max.y = inner_.min.y + periods_.y;
  const double margin = 2 * std::fmax(container.width(), container.height());
  reach_.min = container.min - Vec2{margin, margin};
  reach_.max = container.max + Vec2{margin, margin};
}

} // namespace trime::geometry
