// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/both_sides.hpp"

#include "core/angle.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace trime::polygon {
namespace {

using geometry::Vec2;

/// A chord that leaves a place: by its direction, the entry that leads along it, and the entry that comes back along
/// it.
struct Arm {
  double angle;         ///< [radians]
  LocalIndex out, back; ///< -1 at a chord of the boundary, which has only one side
};

/// Joins the entries around one place: whoever arrives along an arm leaves along the next one clockwise.
void join_around(std::vector<Arm>& arms, BoundarySites& sites) {
  std::sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) { return a.angle < b.angle; });
  const std::size_t n = arms.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (arms[k].back < 0)
      continue;
    for (std::size_t turn = 1; turn <= n; ++turn)
      if (const Arm& next = arms[(k + n - turn) % n]; next.out >= 0) {
        sites.sites[static_cast<std::size_t>(arms[k].back)].next = next.out;
        sites.sites[static_cast<std::size_t>(next.out)].previous = arms[k].back;
        break;
      }
  }
}

} // namespace

BoundarySites with_both_sides(const BoundarySites& boundary) {
  BoundarySites sites = boundary;
  const InnerChords& inner = boundary.inner;
  const auto first = static_cast<LocalIndex>(boundary.sites.size());
  for (LocalIndex half = 0; half < 2 * std::ssize(inner.chords); ++half) {
    const Vec2 from = inner.end(half);
    sites.sites.push_back({from, -1, -1, 0, inner.is_corner(from), inner.other_end(half) - inner.end(half ^ 1)});
  }
  std::vector<std::pair<Vec2, LocalIndex>> corners; // of the boundary
  for (LocalIndex k = 0; k < first; ++k)
    if (boundary.sites[static_cast<std::size_t>(k)].corner)
      corners.emplace_back(boundary.sites[static_cast<std::size_t>(k)].position, k);
  const auto before = [](const auto& a, const auto& b) { return geometry::lexicographically_less(a.first, b.first); };
  std::sort(corners.begin(), corners.end(), before);
  for (auto half = inner.by_end.begin(); half != inner.by_end.end();) {
    const Vec2 place = inner.end(*half);
    std::vector<Arm> arms;
    const auto add = [&](Vec2 to, LocalIndex out, LocalIndex back) {
      arms.push_back({angle_of(to.y - place.y, to.x - place.x), out, back});
    };
    for (; half != inner.by_end.end() && inner.end(*half) == place; ++half)
      add(inner.other_end(*half), first + *half, first + (*half ^ 1));
    const auto corner = std::lower_bound(corners.begin(), corners.end(), std::pair(place, LocalIndex{0}), before);
    if (corner != corners.end() && corner->first == place) {
      const LocalIndex own = corner->second, last = boundary.sites[static_cast<std::size_t>(own)].previous;
      for (const Arm& arm : arms)
        sites.sites[static_cast<std::size_t>(arm.out)].corner = true; // between two curves that meet on the boundary
      add(boundary.chord(own).b, own, -1);
      add(boundary.chord(last).a - boundary.sites[static_cast<std::size_t>(last)].next_shift, -1, last);
    }
    if (arms.size() == 1)
      sites.sites[static_cast<std::size_t>(arms[0].out)].corner = false;
    join_around(arms, sites);
  }
  return sites;
}

} // namespace trime::polygon
