// SPDX-License-Identifier: BSD-3-Clause
#include "shape/periodic_clip.hpp"

#include "shape/make_boundary.hpp"
#include "shape/rules.hpp"
#include "shape/vertex_table.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/region.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::shape {

namespace {

using geometry::Boundary;
using geometry::Box;
using geometry::Frame;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

/// One periodic axis: coordinates along and across it.
struct Axis {
  double Vec2::*across;
  double Vec2::*along;
  double low, high;
  char name;
};

using Rings = std::vector<std::vector<Vec2>>;

/// Vertices within a few steps of a side are put onto it.
void straighten(Rings& rings, const Axis& axis, double reach) {
  for (std::vector<Vec2>& ring : rings)
    for (Vec2& p : ring)
      for (const double side : {axis.low, axis.high})
        if (std::fabs(p.*axis.across - side) <= reach)
          p.*axis.across = side;
}

/// Vertices of the rings on a side at which the curve enters or leaves it, by their place along it.
std::vector<Vec2*> ends_on(Rings& rings, const Axis& axis, double side) {
  std::vector<Vec2*> ends;
  for (std::vector<Vec2>& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 before = ring[(k + ring.size() - 1) % ring.size()], after = ring[(k + 1) % ring.size()];
      if (ring[k].*axis.across == side && (before.*axis.across != side || after.*axis.across != side))
        ends.push_back(&ring[k]);
    }
  std::sort(ends.begin(), ends.end(),
            [&](const Vec2* a, const Vec2* b) { return (*a).*axis.along < (*b).*axis.along; });
  return ends;
}

void join_sides(Rings& rings, const Axis& axis, double reach, const std::string& name) {
  const std::vector<Vec2*> low = ends_on(rings, axis, axis.low), high = ends_on(rings, axis, axis.high);
  for (std::size_t k = 0; k < std::max(low.size(), high.size()); ++k) {
    if (k < low.size() && k < high.size() && std::fabs((*low[k]).*axis.along - (*high[k]).*axis.along) <= reach) {
      (*high[k]).*axis.along = (*low[k]).*axis.along;
      continue;
    }
    const Vec2 alone = k < low.size() ? *low[k] : *high[k];
    throw GeometryError(fmt::format(
        "part '{}': its boundary meets the side of the periodic container at ({:.9g}, {:.9g}), but not the opposite "
        "side; expected a function with the period of the container in {}",
        name, alone.x, alone.y, axis.name));
  }
}

/// Without vertices between two others on the same side: the other side need not have them.
void remove_inner_vertices(std::vector<Vec2>& ring, const Axis& axis) {
  std::vector<Vec2> kept;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 before = ring[(k + ring.size() - 1) % ring.size()], p = ring[k], after = ring[(k + 1) % ring.size()];
    const double side = p.*axis.across;
    if ((side != axis.low && side != axis.high) || before.*axis.across != side || after.*axis.across != side)
      kept.push_back(p);
  }
  ring = std::move(kept);
}

} // namespace

contours::Contour clip_to_periods(const Part& traced, const Frame& frame) {
  const Frame plain(frame.container());
  const std::vector<Part> parts{traced, Part::rectangle("container", frame.inner(), plain)};
  const std::array<std::string, 2> names{"traced", "container"};
  const geometry::Domain clipped = make_boundary(Region::parse("intersection(traced, container)", names), parts, plain);
  Rings rings;
  for (const Loop& loop : clipped.boundary().loops) {
    rings.emplace_back();
    for (const Piece& piece : loop.pieces)
      rings.back().push_back(piece.start);
  }
  const Box& box = frame.inner();
  const double reach = ShapeRules::partner_reach * std::fmax(box.width(), box.height());
  std::vector<Axis> axes;
  if (frame.periods().x > 0)
    axes.push_back({&Vec2::x, &Vec2::y, box.min.x, box.max.x, 'x'});
  if (frame.periods().y > 0)
    axes.push_back({&Vec2::y, &Vec2::x, box.min.y, box.max.y, 'y'});
  for (const Axis& axis : axes)
    straighten(rings, axis, VertexTable::merge_steps * frame.step());
  for (const Axis& axis : axes) {
    for (std::vector<Vec2>& ring : rings)
      remove_inner_vertices(ring, axis);
    join_sides(rings, axis, reach, traced.name());
  }
  return contours::make_contour(rings, traced.name());
}

} // namespace trime::shape
