// SPDX-License-Identifier: BSD-3-Clause
#include "sites/edited_stars.hpp"

#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sites {
namespace {

using geometry::Vec2;

/// Distances are compared with so much room that rounding cannot lose a change.
constexpr double room_for_rounding = 1 + 1e-9;

/// [1] The circumradius of a triangle whose sine at the site is smaller than this is not computed: rounding could
/// make it too small.
constexpr double least_sine = 1e-4;

bool has_member_gap(const delaunay::StarTable& stars, LocalIndex i) {
  return stars.degree(i) < 3 || stars.has_gap(i);
}

/// May a site that has come to p lie in the disc of a triangle of the star? @pre the ring has no gap
bool reaches(const mesh::BinnedPoints& points, std::span<const LocalIndex> ring, Vec2 center, Vec2 p) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LocalIndex next = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (geometry::in_circle_filter(center, points.position(ring[k]), points.position(next), p) >= 0)
      return true;
  }
  return false;
}

/// Returns a bound on the squared distance from a site to any point in the disc of a triangle of its star: the square
/// of the longest circumdiameter. @pre the ring has no gap
double squared_reach_of_ring(const mesh::BinnedPoints& points, std::span<const LocalIndex> ring, Vec2 center) {
  double largest = 0;
  Vec2 a = points.position(ring.back()) - center;
  double a2 = geometry::squared_length(a);
  for (const LocalIndex neighbour : ring) {
    const Vec2 b = points.position(neighbour) - center;
    const double b2 = geometry::squared_length(b), cross = geometry::cross(a, b), product = a2 * b2;
    if (!(cross * cross > least_sine * least_sine * product))
      return INFINITY;
    largest = std::max(largest, product * geometry::squared_length(b - a) / (cross * cross));
    a = b;
    a2 = b2;
  }
  return largest * (room_for_rounding * room_for_rounding);
}

/// The changes near one tile, for its stars one after the other.
class TileDoubts {
public:
  TileDoubts(const mesh::BinnedPoints& points, const mesh::LocalSizes& sizes, const delaunay::StarBuilder& builder,
             std::span<const ChangedPlace> along_x, delaunay::StarTable& stars)
      : points_(points), sizes_(sizes), builder_(builder), along_x_(along_x), stars_(stars) {}

  void doubt(LocalIndex tile, std::vector<ChangedPlace>& near) const {
    const auto [begin, end] = points_.tile_range(tile);
    double widest = 0;
    for (LocalIndex i = begin; i < end; ++i)
      widest = std::max(widest, reach_of(i));
    list_near(points_.grid().tile_box(tile), widest, near);
    for (LocalIndex i = begin; i < end && !near.empty(); ++i)
      if (may_change(i, near))
        stars_.set_certain(i, false);
  }

private:
  /// Nothing farther away matters to the star.
  double reach_of(LocalIndex i) const { return 2 * builder_.cap(sizes_[i]) * room_for_rounding; }

  void list_near(const geometry::Box& box, double reach, std::vector<ChangedPlace>& near) const {
    near.clear();
    auto change = std::lower_bound(along_x_.begin(), along_x_.end(), box.min.x - reach,
                                   [](const ChangedPlace& a, double low) { return a.place.x < low; });
    for (; change != along_x_.end() && change->place.x <= box.max.x + reach; ++change)
      if (change->place.y >= box.min.y - reach && change->place.y <= box.max.y + reach)
        near.push_back(*change);
  }

  /// Few changes are near a star: those that are at most as far along x as the discs of its triangles reach.
  bool may_change(LocalIndex i, std::span<const ChangedPlace> near) const {
    const Vec2 center = points_.position(i);
    const bool has_gap = has_member_gap(stars_, i);
    const std::span<const LocalIndex> ring = stars_.ring(i);
    double squared_reach = reach_of(i) * reach_of(i);
    if (!has_gap)
      squared_reach = std::min(squared_reach, squared_reach_of_ring(points_, ring, center));
    const double reach = std::sqrt(squared_reach) * room_for_rounding;
    auto change = std::lower_bound(near.begin(), near.end(), center.x - reach,
                                   [](const ChangedPlace& a, double low) { return a.place.x < low; });
    for (; change != near.end() && change->place.x <= center.x + reach; ++change)
      if (geometry::squared_length(change->place - center) <= squared_reach &&
          (has_gap || (change->comes && reaches(points_, ring, center, change->place))))
        return true;
    return false;
  }

  const mesh::BinnedPoints& points_;
  const mesh::LocalSizes& sizes_;
  const delaunay::StarBuilder& builder_;
  std::span<const ChangedPlace> along_x_;
  delaunay::StarTable& stars_;
};

} // namespace

FormerGhosts::FormerGhosts(const mesh::BinnedPoints& points)
    : places_(points.positions().begin() + points.owned(), points.positions().end()) {
  points.for_each_foreign_bin([&](const mesh::BinRef& bin, const mesh::SiteRange& sites) {
    bins_.push_back({bin, {sites.begin - points.owned(), sites.end - points.owned()}});
  });
}

/// The sites of a bin are in order, before and after.
std::vector<LocalIndex> FormerGhosts::find_in(const mesh::BinnedPoints& points,
                                              std::vector<ChangedPlace>& changed) const {
  std::vector<LocalIndex> found(places_.size(), -1);
  for (const auto& [bin, former] : bins_) {
    auto [next, end] = points.bin_range(bin);
    for (LocalIndex k = former.begin; k < former.end; ++k) {
      const Vec2 place = places_[at(k)];
      for (; next < end && geometry::lexicographically_less(points.position(next), place); ++next)
        changed.push_back({points.position(next), true});
      if (next < end && points.position(next) == place)
        found[at(k)] = next++;
      else
        changed.push_back({place, false});
    }
    for (; next < end; ++next)
      changed.push_back({points.position(next), true});
  }
  return found;
}

void doubt_stars(const mesh::BinnedPoints& points, const mesh::LocalSizes& sizes, const delaunay::StarBuilder& builder,
                 std::vector<ChangedPlace> changes, delaunay::StarTable& stars) {
  std::sort(changes.begin(), changes.end(),
            [](const ChangedPlace& a, const ChangedPlace& b) { return a.place.x < b.place.x; });
  const TileDoubts doubts(points, sizes, builder, changes, stars);
  PerThread<std::vector<ChangedPlace>> near;
  thread_loop(points.last_tile() - points.first_tile(), 8, [&](std::ptrdiff_t t, int thread) {
    doubts.doubt(points.first_tile() + static_cast<LocalIndex>(t), near[thread]);
  });
}

} // namespace trime::sites
