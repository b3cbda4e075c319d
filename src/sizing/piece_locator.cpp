// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/piece_locator.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace trime::sizing {

using cones::BoxHierarchy;
using cones::NearestPoint;
using cones::search_kernel;
using cones::SegmentLeaf;
using geometry::Box;
using geometry::Piece;
using geometry::Vec2;

namespace {

Vec2 nearest_on_arc(Vec2 p, const Piece& arc) {
  const Vec2 q = p - arc.center;
  const double from_center = geometry::length(q);
  if (from_center > 0 && arc.distance(p) == std::fabs(from_center - arc.radius))
    return arc.center + (arc.radius / from_center) * q;
  return squared_length(p - arc.start) <= squared_length(p - arc.end) ? arc.start : arc.end;
}

/// A straight piece and the shift of its image. It is small, since there may be very many.
struct Segment {
  const Piece* piece;
  const Vec2* shift;
  Box box() const {
    const Box given = piece->covering_box();
    return {given.min + *shift, given.max + *shift};
  }
};

/// The segments as the search kernel wants them; places behind the last one hold no number.
std::vector<SegmentLeaf> leaves_of(const std::vector<Segment>& segments) {
  SegmentLeaf none{};
  std::fill(std::begin(none.a_x), std::end(none.a_x), std::numeric_limits<double>::quiet_NaN());
  std::vector<SegmentLeaf> leaves((segments.size() + BoxHierarchy::width - 1) / BoxHierarchy::width, none);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    SegmentLeaf& leaf = leaves[k / BoxHierarchy::width];
    const std::size_t place = k % BoxHierarchy::width;
    const Vec2 a = segments[k].piece->start + *segments[k].shift, d = segments[k].piece->end + *segments[k].shift - a;
    const double square = squared_length(d);
    leaf.a_x[place] = a.x;
    leaf.a_y[place] = a.y;
    leaf.d_x[place] = d.x;
    leaf.d_y[place] = d.y;
    leaf.inverse_square[place] = square > 0 ? 1 / square : 0;
  }
  return leaves;
}

} // namespace

PieceLocator::PieceLocator(const geometry::Boundary& boundary, const Images& images)
    : kernel_(search_kernel(simd_level())) {
  std::vector<Segment> segments;
  std::size_t pieces = 0;
  for (const geometry::Loop& loop : boundary.loops)
    pieces += loop.pieces.size();
  segments.reserve(pieces);
  const std::vector<Vec2> shifts = images.shifts();
  for (const Vec2& shift : shifts)
    for (const geometry::Loop& loop : boundary.loops)
      for (const Piece& piece : loop.pieces) {
        Box box = piece.covering_box();
        box = {box.min + shift, box.max + shift};
        if (!images.in_reach(box))
          continue;
        if (piece.circular)
          arcs_.push_back({piece, shift, box});
        else
          segments.push_back({&piece, &shift});
      }
  arc_tree_ = BoxHierarchy(arcs_.size(), [&](std::size_t k) { return BoxHierarchy::Item{arcs_[k].box, 0}; });
  segment_tree_ = BoxHierarchy(segments.size(), [&](std::size_t k) {
    return BoxHierarchy::Item{segments[k].box(), 0};
  });
  segments_ = leaves_of(segments);
}

std::optional<PieceLocator::Nearest> PieceLocator::nearest(Vec2 p, double reach) const {
  constexpr double share = 1 / (1 + 2 * slack);
  NearestPoint best{0, 0, reach * reach, -1};
  kernel_.nearest(segment_tree_.levels(), segments_.data(), p.x, p.y, share, best);
  const auto is_far = [&](const Box& box, double) {
    return !(box.squared_distance(p) < best.squared_distance * share);
  };
  arc_tree_.visit_unless(is_far, [&](std::size_t k) {
    const Vec2 point = nearest_on_arc(p - arcs_[k].shift, arcs_[k].piece) + arcs_[k].shift;
    if (const double squared = squared_length(point - p); squared < best.squared_distance)
      best = {point.x, point.y, squared, -1};
  });
  if (!(best.squared_distance < reach * reach))
    return std::nullopt;
  const Vec2 point{best.x, best.y};
  if (best.segment < 0)
    return Nearest{point, point, point};
  const SegmentLeaf& leaf = segments_[static_cast<std::size_t>(best.segment) / BoxHierarchy::width];
  const std::size_t k = static_cast<std::size_t>(best.segment) % BoxHierarchy::width;
  const Vec2 start{leaf.a_x[k], leaf.a_y[k]};
  return Nearest{point, start, start + Vec2{leaf.d_x[k], leaf.d_y[k]}};
}

} // namespace trime::sizing
