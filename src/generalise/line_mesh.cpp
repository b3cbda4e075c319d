// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/line_mesh.hpp"

#include "generalise/rules.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace trime::generalise {

using geometry::Vec2;
using HalfEdge = Triangulation::HalfEdge;

namespace {

// [longest edge] Triangles that are less high are nearly flat.
constexpr double flat = 0.05;

} // namespace

LineMesh::LineMesh(const RegionMap& map, std::span<const std::array<int, 2>> pairs)
    : mesh_(map.mesh()), pairs_(pairs), triangles_of_(at(mesh_.vertex_count())),
      is_changed_(at(mesh_.vertex_count()), 0) {
  for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t) {
    triangles_.push_back({{mesh_.origin(3 * t), mesh_.origin(3 * t + 1), mesh_.origin(3 * t + 2)}, map.label(t)});
    for (const LocalIndex v : triangles_.back().corners)
      triangles_of_[at(v)].push_back(t);
    ++triangles_of_region_[map.label(t)];
  }
  for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
    if (const int curve = map.curve_on(e); curve >= 0 && mesh_.mark(e) >= 0) {
      curves_[{mesh_.origin(e), mesh_.target(e)}] = curve;
      ++edges_of_curve_[curve];
    }
}

/// The triangle on the left of the edge from a to b; -1 if no triangle is there.
LocalIndex LineMesh::triangle_beside(LocalIndex a, LocalIndex b) const {
  for (const LocalIndex t : triangles_of_[at(a)])
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles_[at(t)].corners[k] == a && triangles_[at(t)].corners[(k + 1) % 3] == b)
        return t;
  return -1;
}

int LineMesh::left_of(LocalIndex a, LocalIndex b) const {
  const LocalIndex t = triangle_beside(a, b);
  return t < 0 ? RegionMap::outside : triangles_[at(t)].region;
}

bool LineMesh::is_edge(LocalIndex a, LocalIndex b) const {
  return triangle_beside(a, b) >= 0;
}

int LineMesh::curve_on(LocalIndex a, LocalIndex b) const {
  const auto along = curves_.find({a, b}), back = curves_.find({b, a});
  return along != curves_.end() ? along->second : back != curves_.end() ? back->second : -1;
}

bool LineMesh::is_line(LocalIndex a, LocalIndex b) const {
  return left_of(a, b) != left_of(b, a) || curve_on(a, b) >= 0;
}

std::vector<LocalIndex> LineMesh::neighbours(LocalIndex v) const {
  std::vector<LocalIndex> found;
  for (const LocalIndex t : triangles_of_[at(v)])
    for (const LocalIndex w : triangles_[at(t)].corners)
      if (w != v)
        found.push_back(w);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

int LineMesh::degree(LocalIndex v) const {
  int count = 0;
  for (const LocalIndex w : neighbours(v))
    count += is_line(v, w) ? 1 : 0;
  return count;
}

bool LineMesh::has_curve(LocalIndex v) const {
  const std::vector<LocalIndex> around = neighbours(v);
  return std::any_of(around.begin(), around.end(), [&](LocalIndex w) { return curve_on(v, w) >= 0; });
}

bool LineMesh::follow(LocalIndex a, LocalIndex b) const {
  const std::vector<LocalIndex> around_a = neighbours(a), around_b = neighbours(b);
  for (const LocalIndex u : around_a)
    for (const LocalIndex v : around_b)
      if (is_line(a, u) && is_line(b, v)) {
        const Vec2 first = mesh_.point(u) - mesh_.point(a), second = mesh_.point(v) - mesh_.point(b);
        if (std::fabs(cross(first, second)) < GeneraliseRules::parallel * length(first) * length(second))
          return true;
      }
  return false;
}

double LineMesh::area(const Triangle& t) const {
  const Vec2 a = mesh_.point(t.corners[0]);
  return 0.5 * cross(mesh_.point(t.corners[1]) - a, mesh_.point(t.corners[2]) - a);
}

/// No triangle may turn over, or become nearly flat between three lines.
bool LineMesh::keeps_orientation(LocalIndex from, LocalIndex to) const {
  const auto becomes_line = [&](LocalIndex a, LocalIndex b) {
    return is_line(a, b) || (a == from && is_edge(to, b) && is_line(to, b)) ||
           (b == from && is_edge(to, a) && is_line(to, a));
  };
  for (const LocalIndex t : triangles_of_[at(from)]) {
    if (triangles_[at(t)].has(to))
      continue;
    const std::array<LocalIndex, 3> given = triangles_[at(t)].corners;
    std::array<LocalIndex, 3> corners = given;
    std::replace(corners.begin(), corners.end(), from, to);
    const Vec2 a = mesh_.point(corners[0]), b = mesh_.point(corners[1]), c = mesh_.point(corners[2]);
    const double longest = std::fmax(squared_length(b - a), std::fmax(squared_length(c - b), squared_length(a - c)));
    if (geometry::orient2d(a, b, c) <= 0 || (cross(b - a, c - a) < flat * longest && becomes_line(given[0], given[1]) &&
                                             becomes_line(given[1], given[2]) && becomes_line(given[2], given[0])))
      return false;
  }
  return true;
}

/// May the edges from both vertices to a common neighbour become one?
bool LineMesh::may_merge(LocalIndex from, LocalIndex to, LocalIndex apex) const {
  if (!is_line(from, apex) || !is_line(to, apex))
    return true;
  const LocalIndex beside = triangle_beside(from, apex);
  const bool is_left = beside >= 0 && triangles_[at(beside)].has(to);
  const int beyond_from = is_left ? left_of(apex, from) : left_of(from, apex);
  const int beyond_to = is_left ? left_of(to, apex) : left_of(apex, to);
  if (beyond_from == RegionMap::outside || beyond_to == RegionMap::outside)
    return false;
  const int a = curve_on(from, apex), b = curve_on(to, apex);
  const std::array<int, 2> pair{std::min(beyond_from, beyond_to), std::max(beyond_from, beyond_to)};
  return (a < 0 || b < 0 || a == b) && (pair[0] == pair[1] || std::ranges::binary_search(pairs_, pair));
}

/// Do all regions and curves keep something?
bool LineMesh::keeps_regions(LocalIndex from, LocalIndex to) const {
  std::map<int, LocalIndex> gone;
  for (const LocalIndex t : triangles_of_[at(from)])
    if (triangles_[at(t)].has(to))
      ++gone[triangles_[at(t)].region];
  std::map<int, LocalIndex> merged;
  for (const LocalIndex w : neighbours(from))
    if (const int curve = curve_on(from, w); curve >= 0 && (w == to || curve_on(to, w) >= 0))
      ++merged[curve];
  return std::all_of(gone.begin(), gone.end(),
                     [&](const auto& one) { return triangles_of_region_.at(one.first) > one.second; }) &&
         std::all_of(merged.begin(), merged.end(),
                     [&](const auto& one) { return edges_of_curve_.at(one.first) > one.second; });
}

bool LineMesh::contract(LocalIndex from, LocalIndex to) {
  const std::vector<LocalIndex> a = neighbours(from), b = neighbours(to);
  std::vector<LocalIndex> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  if (common.size() != 2 || !keeps_orientation(from, to) || !may_merge(from, to, common[0]) ||
      !may_merge(from, to, common[1]) || !keeps_regions(from, to))
    return false;
  std::map<int, double> gains;
  for (const LocalIndex w : a)
    if (is_line(from, w))
      is_changed_[at(w)] = 1;
  is_changed_[at(to)] = is_changed_[at(from)] = 1;
  move_curves(from, to);
  for (const LocalIndex t : std::exchange(triangles_of_[at(from)], {})) {
    Triangle& triangle = triangles_[at(t)];
    gains[triangle.region] -= area(triangle);
    if (triangle.has(to)) {
      for (const LocalIndex v : triangle.corners)
        std::erase(triangles_of_[at(v)], t);
      --triangles_of_region_[triangle.region];
      continue;
    }
    std::replace(triangle.corners.begin(), triangle.corners.end(), from, to);
    gains[triangle.region] += area(triangle);
    triangles_of_[at(to)].push_back(t);
  }
  note_losses(gains, from);
  return true;
}

/// Moves a curve on the edge between a and b to the edges from both to the apex.
void LineMesh::take_through(LocalIndex a, LocalIndex b, LocalIndex apex) {
  const int curve = curve_on(a, b);
  if (curve < 0)
    return;
  if (curves_.contains({b, a}))
    std::swap(a, b);
  curves_.erase({a, b});
  --edges_of_curve_[curve];
  for (const Ends& part : {Ends{a, apex}, Ends{apex, b}})
    if (curve_on(part.first, part.second) < 0) {
      curves_[part] = curve;
      ++edges_of_curve_[curve];
    }
}

bool LineMesh::flatten(LocalIndex t, double reach) {
  Triangle& triangle = triangles_[at(t)];
  if (triangle.region == RegionMap::outside ||
      std::ranges::find(triangles_of_[at(triangle.corners[0])], t) == triangles_of_[at(triangle.corners[0])].end())
    return false;
  const auto length_of = [&](std::size_t k) {
    return length(mesh_.point(triangle.corners[(k + 1) % 3]) - mesh_.point(triangle.corners[k]));
  };
  std::size_t longest = 0;
  for (const std::size_t k : {1U, 2U})
    longest = length_of(k) > length_of(longest) ? k : longest;
  const LocalIndex a = triangle.corners[longest], b = triangle.corners[(longest + 1) % 3],
                   apex = triangle.corners[(longest + 2) % 3];
  if (!is_line(a, b) || !is_line(b, apex) || !is_line(apex, a) || !(2 * area(triangle) < reach * length_of(longest)))
    return false;
  const int beyond = left_of(b, a), curve = curve_on(a, b), own = triangle.region;
  const auto may_border = [&](LocalIndex from, LocalIndex to) {
    const int other = left_of(to, from), its = curve_on(from, to);
    const std::array<int, 2> pair{std::min(beyond, other), std::max(beyond, other)};
    return other != RegionMap::outside && (curve < 0 || its < 0) &&
           (pair[0] == pair[1] || std::ranges::binary_search(pairs_, pair));
  };
  if (beyond == RegionMap::outside || !may_border(b, apex) || !may_border(apex, a) ||
      (beyond != own && triangles_of_region_.at(own) == 1))
    return false;
  for (const LocalIndex v : triangle.corners)
    is_changed_[at(v)] = 1;
  take_through(a, b, apex);
  if (beyond != own) {
    const double lost = area(triangle);
    losses_.push_back({own, beyond, geometry::LossReason::sliver, lost, 1, lost, mesh_.point(apex)});
    --triangles_of_region_[own];
    ++triangles_of_region_[beyond];
    triangle.region = beyond;
  }
  return true;
}

void LineMesh::move_curves(LocalIndex from, LocalIndex to) {
  for (const LocalIndex w : neighbours(from))
    for (const bool leaves : {true, false}) {
      const auto found = curves_.find(leaves ? Ends{from, w} : Ends{w, from});
      if (found == curves_.end())
        continue;
      const int curve = found->second;
      curves_.erase(found);
      if (w == to || curve_on(to, w) >= 0)
        --edges_of_curve_[curve];
      else
        curves_[leaves ? Ends{to, w} : Ends{w, to}] = curve;
    }
}

/// Notes which regions have lost to which others.
void LineMesh::note_losses(const std::map<int, double>& gains, LocalIndex from) {
  for (const auto& [loser, gain] : gains) {
    if (gain >= 0)
      continue;
    double won = 0;
    for (const auto& [region, area] : gains)
      won += std::fmax(0, area);
    for (const auto& [winner, area] : gains)
      if (area > 0 && winner != RegionMap::outside && loser != RegionMap::outside) {
        const double lost = -gain * (area / won);
        losses_.push_back({loser, winner, geometry::LossReason::close_nodes, lost, 1, lost, mesh_.point(from)});
      }
  }
}

std::vector<LineMesh::Line> LineMesh::lines() const {
  std::vector<Line> found;
  for (LocalIndex v = 0; v < mesh_.vertex_count(); ++v)
    for (const LocalIndex w : neighbours(v)) {
      const int left = left_of(v, w), right = left_of(w, v), curve = curve_on(v, w);
      if (left == RegionMap::outside || right == RegionMap::outside || (left == right && curve < 0))
        continue;
      const bool is_along = curve >= 0 ? curves_.contains({v, w}) : left < right;
      if (is_along)
        found.push_back({v, w, left, right, curve});
    }
  return found;
}

} // namespace trime::generalise
