// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/boundary_walk.hpp"

#include "core/angle.hpp"

#include <algorithm>

namespace trime::refinement {

using certificate::ExactArea;
using certificate::Int128;
using geometry::Vec2;
using polygon::LoopSummary;

namespace {

class Walker {
public:
  Walker(std::vector<PlacedFacet> facets, std::span<const GlobalId> corners, const geometry::Frame& frame)
      : facets_(std::move(facets)), corners_(corners), frame_(frame) {
    std::ranges::sort(facets_, [](const PlacedFacet& p, const PlacedFacet& q) {
      return p.first != q.first ? p.first < q.first : p.second < q.second;
    });
  }

  BoundaryWalk walk() {
    count_tags();
    std::vector<char> seen(facets_.size(), 0);
    for (std::size_t k = 0; k < facets_.size(); ++k) {
      walk_.irregular += k > 0 && facets_[k].first == facets_[k - 1].first;
      if (!seen[k])
        follow(k, seen);
    }
    std::ranges::sort(walk_.loops, {}, &LoopSummary::tag);
    take_whole_containers_off();
    return std::move(walk_);
  }

private:
  void count_tags() {
    std::vector<std::int32_t> tags;
    for (const PlacedFacet& facet : facets_)
      tags.push_back(facet.tag);
    std::ranges::sort(tags);
    walk_.tags = std::unique(tags.begin(), tags.end()) - tags.begin();
  }

  /// Returns the edge that begins at a point, or the number of edges.
  std::size_t next_at(GlobalId point) const {
    const auto found = std::ranges::lower_bound(facets_, point, {}, &PlacedFacet::first);
    return found != facets_.end() && found->first == point ? static_cast<std::size_t>(found - facets_.begin())
                                                           : facets_.size();
  }

  Vec2 step(const PlacedFacet& facet) const { return frame_.periods().nearest_image(facet.b, facet.a) - facet.a; }

  /// Follows a loop from its first edge on, unrolled.
  void follow(std::size_t first, std::vector<char>& seen) {
    const Vec2 origin = facets_[first].a;
    LoopSummary loop{facets_[first].tag, LoopSummary::Kind::hole, 0, 0, {}};
    ExactArea area;
    Vec2 at = origin;
    std::size_t k = first, before = first;
    do {
      seen[k] = 1;
      const Vec2 to = at + step(facets_[k]);
      ++loop.edges;
      loop.length += geometry::length(to - at);
      area.add_triangle(origin, at, to, frame_.lattice());
      at = to;
      before = k;
      k = next_at(facets_[k].second);
      if (k < facets_.size()) {
        walk_.changes += facets_[k].tag != facets_[before].tag;
        note_corner(facets_[before], facets_[k]);
      }
    } while (k < facets_.size() && !seen[k]);
    walk_.irregular += k != first;
    finish(loop, area, origin, at);
  }

  void note_corner(const PlacedFacet& in, const PlacedFacet& out) {
    if (!std::ranges::binary_search(corners_, out.first))
      return;
    const Vec2 ahead = step(out), back = -1 * step(in);
    const double angle = angle_of(cross(ahead, back), dot(ahead, back)) * degrees_per_radian;
    walk_.corners.push_back({out.a, angle < 0 ? angle + 360 : angle, ahead, back});
  }

  /// A loop that winds gets the area between it and a corner of the container, as in the certificate of a run.
  void finish(LoopSummary& loop, ExactArea& area, Vec2 origin, Vec2 end) {
    loop.kind = end != origin    ? LoopSummary::Kind::band
                : area.twice > 0 ? LoopSummary::Kind::outer
                                 : LoopSummary::Kind::hole;
    if (end != origin)
      for (int twice = 0; twice < 2; ++twice)
        area.add_triangle(frame_.periods().min, origin, end, frame_.lattice());
    walk_.area.add(area);
    walk_.loops.push_back(loop);
  }

  /// Loops on a torus enclose an area up to whole areas of the torus.
  void take_whole_containers_off() {
    const geometry::Periods& periods = frame_.periods();
    if (periods.x == 0 || periods.y == 0)
      return;
    const Int128 torus = Int128{2} * frame_.lattice().steps(periods.x) * frame_.lattice().steps(periods.y);
    Int128& twice = walk_.area.twice;
    twice = (twice % torus + torus) % torus;
    if (twice == 0)
      twice = torus;
  }

  std::vector<PlacedFacet> facets_; // by their first point
  std::span<const GlobalId> corners_;
  const geometry::Frame& frame_;
  BoundaryWalk walk_;
};

} // namespace

BoundaryWalk walk_along(std::vector<PlacedFacet> facets, std::span<const GlobalId> corners,
                        const geometry::Frame& frame) {
  return Walker(std::move(facets), corners, frame).walk();
}

} // namespace trime::refinement
