// SPDX-License-Identifier: BSD-3-Clause
#include "shape/part_images.hpp"

#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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
          "beyond the sides of the periodic container; move the part by a period, or replace it by several parts that "
          "reach less far",
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

namespace {

using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

using Shifts = std::map<std::size_t, std::vector<Vec2>>; // of the images of parts, once they were asked for

/// Returns the marker of the segment of its part that a piece follows.
int marker_of(const Piece& piece, std::span<const Part> parts, const geometry::Frame& frame, Shifts& shifts) {
  const auto part = static_cast<std::size_t>(piece.part);
  const Polygon* polygon = part < parts.size() ? parts[part].as_polygon() : nullptr;
  if (polygon == nullptr || polygon->markers.empty())
    return 0;
  auto found = shifts.find(part);
  if (found == shifts.end())
    found = shifts.emplace(part, image_shifts(parts[part], frame)).first;
  int marker = 0;
  double least = HUGE_VAL;
  for (const Vec2 shift : found->second) {
    const geometry::SegmentGrid::Nearest nearest = polygon->grid.nearest(piece.point(piece.length() / 2) - shift);
    if (nearest.squared_distance < least) {
      least = nearest.squared_distance;
      marker = polygon->markers[static_cast<std::size_t>(nearest.segment)];
    }
  }
  return marker;
}

/// Returns the name in the file, or the marker itself.
std::string name_of(int part, int marker, std::span<const Part> parts) {
  const std::vector<std::string>& names = parts[static_cast<std::size_t>(part)].as_polygon()->marker_names;
  return names.empty() ? fmt::format("{}", marker) : names[static_cast<std::size_t>(marker - 1)];
}

} // namespace

bool have_markers(std::span<const Part> parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Part& part) {
    return part.as_polygon() != nullptr && !part.as_polygon()->markers.empty();
  });
}

std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame) {
  std::vector<std::int32_t> markers(boundary.part_names.size(), 0);
  if (!have_markers(parts))
    return markers;
  std::map<std::pair<int, int>, int> index_of; // by part and marker: in this order they are named
  std::vector<int> of_piece;                   // loop by loop
  Shifts shifts;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (of_piece.push_back(marker_of(piece, parts, frame, shifts)); of_piece.back() != 0)
        index_of[{piece.part, of_piece.back()}] = 0;
  for (auto& [key, index] : index_of) {
    index = static_cast<int>(boundary.part_names.size());
    boundary.part_names.push_back(fmt::format("{}.{}", boundary.part_names[static_cast<std::size_t>(key.first)],
                                              name_of(key.first, key.second, parts)));
    markers.push_back(key.second);
  }
  for (std::size_t next = 0; Loop & loop : boundary.loops) {
    std::vector<int> given;
    for (Piece& piece : loop.pieces) {
      given.push_back(piece.part);
      if (const int marker = of_piece[next++]; marker != 0)
        piece.part = index_of.at({piece.part, marker});
    }
    for (std::size_t k = 0; k < given.size(); ++k) {
      const std::size_t before = (k + given.size() - 1) % given.size();
      if (given[before] == given[k] && loop.pieces[before].part != loop.pieces[k].part)
        loop.pieces[k].corner = true;
    }
  }
  return markers;
}

} // namespace trime::shape
