// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/region_size.hpp"

#include "core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {
namespace {

using geometry::Piece;
using geometry::Segment;
using geometry::Vec2;

constexpr double longest_turn = pi / 180;

// [longer side of the container] Sites lie so near to the border on which they were placed.
constexpr double border_width = 1e-9;

/// The border of a region.
struct Outline {
  std::vector<Segment> segments;
  double deviation = 0; ///< largest distance of an arc from its segments
};

/// @param along the region lies on the left of the piece
void add_piece(const Piece& piece, bool along, const geometry::Lattice& lattice, Outline& outline) {
  const double length = piece.length();
  const int parts = piece.circular ? static_cast<int>(std::ceil(std::fabs(piece.sweep) / longest_turn)) : 1;
  Vec2 at = piece.start;
  for (int k = 1; k <= parts; ++k) {
    const Vec2 next = k == parts ? piece.end : lattice.snap(piece.point(length * k / parts));
    if (next != at)
      outline.segments.push_back(along ? Segment{at, next} : Segment{next, at});
    at = next;
  }
  if (piece.circular)
    outline.deviation = std::fmax(outline.deviation, piece.radius * (1 - sin_cos(0.5 * longest_turn).cos));
}

Outline outline_of(int region, const geometry::Domain& domain) {
  const geometry::Lattice& lattice = domain.frame().lattice();
  Outline outline;
  for (const geometry::Loop& loop : domain.boundary().loops)
    for (const Piece& piece : loop.pieces)
      if (piece.region == region)
        add_piece(piece, true, lattice, outline);
  for (const geometry::InnerArc& arc : domain.curves().arcs)
    if (arc.left != arc.right && (arc.left == region || arc.right == region))
      for (const Piece& piece : arc.pieces)
        add_piece(piece, arc.left == region, lattice, outline);
  return outline;
}

} // namespace

RegionSize::RegionSize(const SizeField& field, const geometry::Domain& domain, std::vector<RegionBound> bounds)
    : field_(field), lattice_(domain.frame().lattice()), periods_(domain.frame().periods()) {
  const geometry::Box& container = domain.frame().container();
  const double width = border_width * std::fmax(container.width(), container.height());
  for (const RegionBound& bound : bounds) {
    Outline outline = outline_of(bound.region, domain);
    if (outline.segments.empty()) { // the region fills the whole torus, or nothing
      if (periods_.x > 0 && periods_.y > 0 && domain.regions().areas[static_cast<std::size_t>(bound.region)] > 0)
        whole_ = std::fmin(whole_, bound.size);
      continue;
    }
    const double border = width + outline.deviation;
    if (periods_.any()) {
      periodic_.push_back({geometry::PeriodicOutline(outline.segments, periods_, lattice_), bound.size, border});
      continue;
    }
    geometry::Box box;
    for (const Segment& segment : outline.segments)
      for (const Vec2 corner : {segment.a - Vec2{border, border}, segment.a + Vec2{border, border}})
        box.include(corner);
    bounded_.push_back({box, geometry::SegmentGrid(std::move(outline.segments)), bound.size, border});
  }
}

void RegionSize::sizes(std::span<const Vec2> places, std::span<double> values) const {
  field_.sizes(places, values);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = bounded(places[k], values[k]);
}

double RegionSize::bounded(Vec2 p, double size) const {
  if (!is_valid_size(size))
    return size;
  for (const Bounded& one : bounded_)
    if (one.size < size && p.x >= one.box.min.x && p.x <= one.box.max.x && p.y >= one.box.min.y &&
        p.y <= one.box.max.y && (one.outline.inside(lattice_.snap(p)) || one.outline.nearest(p, one.border)))
      size = one.size;
  size = std::fmin(size, whole_);
  const Vec2 canonical = periods_.wrap(p);
  for (const PeriodicBound& one : periodic_)
    if (one.size < size &&
        (one.outline.inside(periods_.wrap(lattice_.snap(canonical))) || one.outline.is_within(canonical, one.border)))
      size = one.size;
  return size;
}

std::size_t RegionSize::memory_bytes() const {
  std::size_t bytes = field_.memory_bytes();
  for (const Bounded& one : bounded_)
    bytes += one.outline.memory_bytes();
  for (const PeriodicBound& one : periodic_)
    bytes += one.outline.memory_bytes();
  return bytes;
}

} // namespace trime::sizing
