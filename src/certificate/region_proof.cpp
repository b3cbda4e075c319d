// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/region_proof.hpp"

#include "certificate/boundary_proof.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <utility>

namespace trime::certificate {
namespace {

using geometry::Vec2;
using polygon::RegionFinder;
using sites::FlatFan;
using sites::StageView;

/// Counts of one thread, mergeable.
struct RegionCounts {
  explicit RegionCounts(std::size_t regions) : triangles(regions, 0), areas(regions) {}

  std::vector<std::int64_t> triangles; // by region
  std::vector<ExactArea> areas;
  std::int64_t interfaces = 0, wrong = 0; // edges between regions that are chords, and those that are not

  void add(const RegionCounts& other) {
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      triangles[k] += other.triangles[k];
      areas[k].add(other.areas[k]);
    }
    interfaces += other.interfaces;
    wrong += other.wrong;
  }
};

/// Counts triangles at their lowest vertices, and interfaces at the stars of their first ends.
class RegionCounter {
public:
  RegionCounter(const StageView& view, const decomposition::Numbering& numbering, const RegionFinder& regions)
      : view_(view), numbering_(numbering), regions_(regions), points_(view.state.points()), fan_(view, numbering),
        counts_(regions.count()) {}

  void count(LocalIndex site) {
    const Vec2 p = points_.position(site);
    const std::span<const LocalIndex> ends =
        points_.boundary(site) == mesh::free_site ? std::span<const LocalIndex>() : view_.polygon.inner.at(p);
    fan_.load(site);
    const LocalIndex own = numbering_.vertex(site);
    for (const std::uint32_t k : fan_.triangles_above(own)) {
      const auto region = static_cast<std::size_t>(region_of(p, k));
      ++counts_.triangles[region];
      counts_.areas[region].add_triangle(p, fan_.positions[k], fan_.positions[k + 1], view_.lattice);
    }
    if (!ends.empty())
      count_edges(p, ends);
  }
  const RegionCounts& counts() const { return counts_; }

private:
  int region_of(Vec2 p, std::size_t k) const {
    return regions_.at(polygon::centroid(p, fan_.positions[k], fan_.positions[k + 1], view_.lattice));
  }

  /// The triangle before the k-th edge of the fan lies on its right, seen from the site.
  void count_edges(Vec2 p, std::span<const LocalIndex> ends) {
    const polygon::InnerChords& inner = view_.polygon.inner;
    std::vector<int> of_triangle;
    for (std::size_t k = 0; k < fan_.triangles; ++k)
      of_triangle.push_back(region_of(p, k));
    for (std::size_t k = fan_.closed ? 0 : 1; k < fan_.triangles; ++k) {
      const int left = of_triangle[k], right = of_triangle[k > 0 ? k - 1 : fan_.triangles - 1];
      const auto leads = [&](LocalIndex half) { return inner.other_end(half) == fan_.positions[k]; };
      const auto half = std::find_if(ends.begin(), ends.end(), leads);
      if (half == ends.end()) {
        counts_.wrong += left != right;
        continue;
      }
      const polygon::InnerChord& chord = inner.chords[static_cast<std::size_t>(*half / 2)];
      const bool forth = *half % 2 == 0;
      const bool agrees = chord.left == chord.right ? left == right
                                                    : left == (forth ? chord.left : chord.right) &&
                                                          right == (forth ? chord.right : chord.left);
      counts_.wrong += !agrees;
      counts_.interfaces += forth && agrees && left != right;
    }
  }

  const StageView& view_;
  const decomposition::Numbering& numbering_;
  const RegionFinder& regions_;
  const mesh::BinnedPoints& points_;
  FlatFan fan_;
  RegionCounts counts_;
};

/// Over all ranks.
RegionCounts count_regions(const StageView& view, const decomposition::Numbering& numbering,
                           const RegionFinder& regions) {
  const mesh::BinnedPoints& points = view.state.points();
  PerThread<RegionCounter> of_thread(view, numbering, regions);
  thread_loop(points.last_tile() - points.first_tile(), 1, [&](std::ptrdiff_t t, int thread) {
    const auto [first, last] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    for (LocalIndex site = first; site < last; ++site)
      of_thread[thread].count(site);
  });
  RegionCounts counts(regions.count());
  for (const RegionCounter& counter : of_thread)
    counts.add(counter.counts());
  std::vector<std::int64_t> sums = counts.triangles;
  for (const ExactArea& area : counts.areas)
    for (const std::int64_t part : area.split())
      sums.push_back(part);
  sums.push_back(counts.interfaces);
  sums.push_back(counts.wrong);
  view.state.comm().sum(sums);
  auto next = sums.begin();
  for (std::int64_t& triangles : counts.triangles)
    triangles = *next++;
  for (ExactArea& area : counts.areas) {
    area = ExactArea::join({next[0], next[1], next[2]});
    next += 3;
  }
  counts.interfaces = next[0];
  counts.wrong = next[1];
  return counts;
}

/// The outline of a region in a periodic container, as closed paths around its faces.
class PeriodicPaths {
public:
  PeriodicPaths(const RegionFinder& regions, int region, const geometry::Periods& periods) : periods_(periods) {
    regions.for_each_chord(region, [&](Vec2 a, Vec2 b) {
      const Vec2 home = periods.wrap(a) - a;
      chords_.push_back({a + home, b + home});
    });
    std::sort(chords_.begin(), chords_.end(), [](const geometry::Segment& s, const geometry::Segment& t) {
      return s.a != t.a ? geometry::lexicographically_less(s.a, t.a) : geometry::lexicographically_less(s.b, t.b);
    });
  }

  /// The area on the left of all paths. On a torus it is known up to multiples of the area of the torus.
  ExactArea area(const geometry::Lattice& lattice) const {
    ExactArea area;
    std::vector<char> is_used(chords_.size(), 0);
    for (std::size_t first = 0; first < chords_.size(); ++first) {
      const Vec2 origin = chords_[first].a;
      Vec2 from = origin;
      for (std::size_t k = first; is_used[k] == 0; k = next(k)) {
        is_used[k] = 1;
        const Vec2 to = from + (chords_[k].b - chords_[k].a);
        area.add_triangle(origin, from, to, lattice);
        from = to;
      }
      for (int side = 0; side < 2 && from != origin; ++side) // what a path around the container lacks to a closed one
        area.add_triangle(periods_.min, origin, from, lattice);
    }
    return area;
  }

private:
  /// The chord that goes on around the same face: the first one clockwise from the way back.
  std::size_t next(std::size_t chord) const {
    const Vec2 back = chords_[chord].a - chords_[chord].b, place = periods_.wrap(chords_[chord].b);
    auto out = std::lower_bound(chords_.begin(), chords_.end(), place, [](const geometry::Segment& s, Vec2 p) {
      return geometry::lexicographically_less(s.a, p);
    });
    std::size_t best = chord;
    double least = 4 * pi;
    for (; out != chords_.end() && out->a == place; ++out) {
      const Vec2 along = out->b - out->a;
      const double angle = angle_of(geometry::cross(along, back), geometry::dot(along, back));
      if (const double turn = angle > 0 ? angle : angle + 2 * pi; turn < least) {
        least = turn;
        best = static_cast<std::size_t>(out - chords_.begin());
      }
    }
    return best;
  }

  const geometry::Periods& periods_;
  std::vector<geometry::Segment> chords_; // by their starts, which lie in the container
};

/// The exact area inside the outline of a region that has triangles or not, in a periodic container.
ExactArea periodic_area(const RegionFinder& regions, int region, bool has_triangles, const StageView& view) {
  const geometry::Periods& periods = view.polygon.periods;
  ExactArea area = PeriodicPaths(regions, region, periods).area(view.lattice);
  if (!(periods.x > 0 && periods.y > 0))
    return area;
  const Int128 torus = Int128{2} * view.lattice.steps(periods.x) * view.lattice.steps(periods.y);
  area.twice = (area.twice % torus + torus) % torus;
  if (area.twice == 0 && has_triangles)
    area.twice = torus;
  return area;
}

/// The exact area inside the outline of a region: the sum of the triangles from one of its vertices to its chords.
ExactArea outline_area(const RegionFinder& regions, int region, const geometry::Lattice& lattice) {
  ExactArea area;
  bool is_first = true;
  Vec2 origin;
  regions.for_each_chord(region, [&](Vec2 a, Vec2 b) {
    if (std::exchange(is_first, false))
      origin = a;
    area.add_triangle(origin, a, b, lattice);
  });
  return area;
}

} // namespace

RegionProof prove_regions(const StageView& view, const decomposition::Numbering& numbering, const RegionFinder& regions,
                          const mesh::DistributedMesh& mesh) {
  RegionProof proof;
  if (!regions.any())
    return proof;
  const RegionCounts counts = count_regions(view, numbering, regions);
  const auto count = static_cast<double>(regions.count());
  std::vector<std::int64_t> written(regions.count(), 0);
  for (const std::int32_t region : mesh.region)
    ++written[static_cast<std::size_t>(region - 1)];
  view.state.comm().sum(written);
  std::int64_t chords = 0, filled = 0, listed = 0;
  for (const polygon::InnerChord& chord : view.polygon.inner.chords)
    chords += chord.left != chord.right;
  for (std::size_t k = 0; k < regions.count(); ++k) {
    const ExactArea inside = view.polygon.periods.any()
                                 ? periodic_area(regions, static_cast<int>(k), counts.triangles[k] > 0, view)
                                 : outline_area(regions, static_cast<int>(k), view.lattice);
    filled += inside.twice == counts.areas[k].twice;
    listed += written[k] == counts.triangles[k];
    proof.areas.push_back(counts.areas[k].value(view.lattice));
  }
  proof.triangles = counts.triangles;
  proof.checks = {
      {"region_areas", count, static_cast<double>(filled), filled == std::ssize(written),
       "regions whose triangles have exactly the area inside the outline of the region (exact integers)"},
      {"interfaces", static_cast<double>(chords), static_cast<double>(counts.interfaces),
       counts.interfaces == chords && counts.wrong == 0 && mesh.interface_slab.total == chords,
       "edges between two regions that have these regions on their sides; no other edge lies between two regions"},
      {"region_triangles", count, static_cast<double>(listed), listed == std::ssize(written),
       "regions with as many triangles in the arrays as the stars have"}};
  return proof;
}

} // namespace trime::certificate
