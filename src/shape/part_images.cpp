// SPDX-License-Identifier: BSD-3-Clause
#include "shape/part_images.hpp"

#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Periods;
using geometry::Segment;
using geometry::Vec2;

constexpr double margin_in_steps = 64; // around the container, far more than vertices are moved by merging

void check_periodic_reach(const Part& part, const Box& box, const Frame& frame) {
  const Periods& periods = frame.periods();
  const Vec2 low = frame.inner().min - Vec2{periods.x, periods.y};
  const Vec2 high = frame.inner().max + Vec2{periods.x, periods.y};
  const auto check = [&](char axis, double period, double from, double to, double least, double most) {
    if (period > 0 && (from < least || to > most))
      throw GeometryError(fmt::format(
          "part '{}' reaches from {} = {:.9g} to {:.9g}: expected it between {:.9g} and {:.9g}, at most one period "
          "beyond the sides of the periodic container; move it by a period, or intersect two parts",
          part.name(), axis, from, to, least, most));
  };
  check('x', periods.x, box.min.x, box.max.x, low.x, high.x);
  check('y', periods.y, box.min.y, box.max.y, low.y, high.y);
}

} // namespace

Box box_of(const Part& part) {
  Box box;
  if (const Circle* circle = part.as_circle()) {
    box.include(circle->center - Vec2{circle->radius, circle->radius});
    box.include(circle->center + Vec2{circle->radius, circle->radius});
    return box;
  }
  for (const Segment& segment : part.as_polygon()->grid.segments()) {
    box.include(segment.a);
    box.include(segment.b);
  }
  return box;
}

void check_frame(const Part& part, const Frame& frame) {
  const auto fail = [&](Vec2 p, const std::string& expected) {
    const Box& box = frame.container();
    throw GeometryError(
        fmt::format("part '{}' was made in another frame: expected {} of the container [{:.9g}, {:.9g}] "
                    "x [{:.9g}, {:.9g}], found ({:.17g}, {:.17g}); make parts and shape in one frame",
                    part.name(), expected, box.min.x, box.max.x, box.min.y, box.max.y, p.x, p.y));
  };
  const auto check = [&](Vec2 p) {
    if (!frame.reach().contains(p))
      fail(p, "points within twice the size");
    if (frame.lattice().snap(p) != p)
      fail(p, "points on the lattice");
  };
  if (const Circle* circle = part.as_circle()) {
    for (const Vec2 p : quadrant_vertices(*circle))
      check(p);
    return;
  }
  for (const Segment& segment : part.as_polygon()->grid.segments())
    check(segment.a);
}

Part domain_part(const Frame& frame) {
  const Vec2 periods{frame.periods().x, frame.periods().y};
  return Part::rectangle(std::string(domain_name), {frame.inner().min - periods, frame.inner().max + periods}, frame);
}

std::vector<Vec2> image_shifts(const Part& part, const Frame& frame) {
  const Periods& periods = frame.periods();
  if (!periods.any() || part.name() == domain_name)
    return {{0, 0}};
  const Box box = box_of(part);
  check_periodic_reach(part, box, frame);
  const double margin = margin_in_steps * frame.step();
  const Vec2 low = frame.inner().min - Vec2{margin, margin}, high = frame.inner().max + Vec2{margin, margin};
  const auto meets = [](double period, double from, double to, double least, double most) {
    return period == 0 || (from <= most && to >= least);
  };
  std::vector<Vec2> shifts;
  for (int i = periods.x > 0 ? -1 : 0; i <= (periods.x > 0 ? 1 : 0); ++i)
    for (int j = periods.y > 0 ? -1 : 0; j <= (periods.y > 0 ? 1 : 0); ++j) {
      const Vec2 shift{i * periods.x, j * periods.y};
      if (meets(periods.x, box.min.x + shift.x, box.max.x + shift.x, low.x, high.x) &&
          meets(periods.y, box.min.y + shift.y, box.max.y + shift.y, low.y, high.y))
        shifts.push_back(shift);
    }
  return shifts;
}

} // namespace trime::shape
