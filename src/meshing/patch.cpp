// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/patch.hpp"

#include "trime/geometry/diametral.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double clearance_of_score = 1.5; // h, from the rim of what is read
constexpr double clearance_of_core = 1.8;  // h, from where sites are free
constexpr double widest_frame = 0x1.8p44;  // lattice steps: 1.5 sides of the container at least; predicates are exact
constexpr double weight_of_bad = 10;
constexpr double waking_move = 0.05;      // h: who has moved that far is worth another try
constexpr std::size_t most_searched = 64; // triangles without a vertex inside, for one that tells of its side

} // namespace

LocalIndex PatchOptimizer::Patch::add(Vec2 p, double h, const BoundaryVertex& on_boundary, Role its_role) {
  const LocalIndex v = mesh.insert(p);
  if (v >= 0)
    append(v, h, on_boundary, its_role);
  return v;
}

void PatchOptimizer::Patch::append(LocalIndex v, double h, const BoundaryVertex& on_boundary, Role its_role) {
  role.push_back(its_role);
  size.push_back(h);
  boundary.push_back(on_boundary);
  if (on_boundary.site >= 0)
    rim.push_back(v);
  ++gain;
}

/// The triangulation of the sites. @return false if there is nothing to be done
bool PatchOptimizer::build(Vec2 center, double size, std::span<const PatchSite> sites) {
  center_ = center;
  size_ = size;
  if (sites.size() > options_.most_sites)
    return false;
  const double reach = options_.reach * size;
  start_.broken = false;
  start_.mesh.start(center, std::min(lattice_.snap(3 * reach), widest_frame * lattice_.step()));
  start_.role.assign(PatchMesh::frame, Role::held);
  start_.size.assign(PatchMesh::frame, size);
  start_.boundary.assign(PatchMesh::frame, {});
  start_.rim.clear();
  rests_.assign(PatchMesh::frame, 0);
  for (const PatchSite& site : sites) {
    const double distance = geometry::length(site.position - center);
    const double coarser = std::fmax(site.size, size);
    Role role = Role::held;
    if (distance + PatchOptions::clearance * coarser < reach && site.boundary != mesh::fixed_site)
      role = Role::free;
    else if (distance + clearance_of_score * coarser < reach)
      role = Role::scored;
    BoundaryVertex on_boundary;
    if (site.boundary >= 0) {
      const BoundarySite& its = boundary_.sites[at(site.boundary)];
      on_boundary.site = site.boundary;
      on_boundary.tolerance = site.tolerance;
      on_boundary.loop = chain_.loop(site.boundary);
      on_boundary.arc = curve_.arc(on_boundary.loop, its);
      if (its.corner)
        role = std::min(role, Role::scored);
    }
    start_.append(start_.mesh.append(site.position), site.size, on_boundary, role);
    rests_.push_back(site.rests != 0);
  }
  start_.mesh.connect_all();
  start_.gain = 0;
  link_boundary();
  missing_at_start_ = missing_chords(start_);
  return std::find(start_.role.begin(), start_.role.end(), Role::free) != start_.role.end();
}

/// Joins neighbours along the boundary. Who has none in the patch is held.
void PatchOptimizer::link_boundary() {
  for (const LocalIndex v : start_.rim) {
    BoundaryVertex& own = start_.boundary[at(v)];
    const geometry::Segment chord = boundary_.chord(own.site);
    const Vec2 end = start_.mesh.position(v) + (chord.b - chord.a);
    for (const LocalIndex u : start_.rim)
      if (start_.boundary[at(u)].site == boundary_.sites[at(own.site)].next && start_.mesh.position(u) == end) {
        own.next = u;
        start_.boundary[at(u)].previous = v;
      }
  }
  for (const LocalIndex v : start_.rim) {
    const BoundaryVertex& own = start_.boundary[at(v)];
    if (own.next < 0 || own.previous < 0)
      start_.role[at(v)] = std::min(start_.role[at(v)], Role::scored);
  }
}

/// Who has a vertex inside lies inside; else a chord among its edges tells, or a neighbour across the others.
bool PatchOptimizer::lies_inside(const Patch& patch, const PatchMesh::Triangle& triangle) {
  std::array<const PatchMesh::Triangle*, most_searched> found; // only the first `count`
  found[0] = &triangle;
  std::size_t count = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const PatchMesh::Triangle& at_hand = *found[i];
    for (const LocalIndex v : at_hand.vertex)
      if (v >= PatchMesh::frame && !patch.on_boundary(v))
        return true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (patch.is_chord(at_hand.vertex[k], at_hand.vertex[(k + 1) % 3]))
        return true;
      if (patch.is_chord(at_hand.vertex[(k + 1) % 3], at_hand.vertex[k]))
        return false;
    }
    for (const LocalIndex t : at_hand.neighbour) {
      if (t < 0)
        return false; // beyond the frame all is unknown
      const PatchMesh::Triangle* next = &patch.mesh.triangles()[at(t)];
      if (count < most_searched && std::find(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), next) ==
                                       found.begin() + static_cast<std::ptrdiff_t>(count))
        found[count++] = next;
    }
  }
  return false;
}

/// As mesh::aspect_ratio.
double PatchOptimizer::alpha(const Patch& patch, const PatchMesh::Triangle& triangle) const {
  const Vec2 p = patch.mesh.position(triangle.vertex[0]), u = patch.mesh.position(triangle.vertex[1]) - p,
             v = patch.mesh.position(triangle.vertex[2]) - p;
  const double a = geometry::length(u), b = geometry::length(v), c = geometry::length(v - u);
  const double twice_area = geometry::cross(u, v);
  return twice_area == 0 ? INFINITY : std::max(1.0, a * b * c * (a + b + c) / (4 * twice_area * twice_area));
}

/// Does it count, and is it bad? Most are good, which takes no root to see.
bool PatchOptimizer::is_bad(const Patch& patch, const PatchMesh::Triangle& triangle) const {
  const auto& vertex = triangle.vertex;
  return patch.may_count(triangle) &&
         !mesh::is_surely_below(options_.bad_alpha, patch.mesh.position(vertex[0]), patch.mesh.position(vertex[1]),
                                patch.mesh.position(vertex[2])) &&
         counts(patch, triangle) && alpha(patch, triangle) > options_.bad_alpha;
}

void PatchOptimizer::add_to(Score& score, double alpha) const {
  const double excess = alpha - 1, bad = std::max(0.0, alpha - options_.bad_alpha);
  score.sum += excess * excess + weight_of_bad * bad * bad;
  score.max = std::max(score.max, alpha);
}

Vec2 PatchOptimizer::middle_of(const Patch& patch, const Corners& corners) const {
  return (1.0 / 3) *
         (patch.mesh.position(corners[0]) + patch.mesh.position(corners[1]) + patch.mesh.position(corners[2]));
}

/// Far enough from the sites that are held.
bool PatchOptimizer::is_in_core(Vec2 p) const {
  return geometry::length(p - center_) < (options_.reach - PatchOptions::clearance - clearance_of_core) * size_;
}

/// How many chords of the boundary are no edges.
LocalIndex PatchOptimizer::missing_chords(const Patch& patch) const {
  LocalIndex missing = 0;
  for (const LocalIndex v : patch.rim)
    missing += patch.role[at(v)] != Role::gone && patch.boundary[at(v)].next >= 0 &&
               !patch.mesh.apexes(v, patch.boundary[at(v)].next);
  return missing;
}

/// @brief Is each chord that has changed an edge that stands for its curve, and is its closed diametral disc free? Is
/// that of each other chord free of what has moved? Does nothing from inside lie behind a chord?
///
/// If a vertex lies in the disc of an edge of a Delaunay triangulation, the third vertex of one of its triangles does.
bool PatchOptimizer::chords_hold(const Patch& patch) const {
  const auto has_moved = [&](LocalIndex u) {
    return u >= start_.mesh.vertices() || patch.mesh.position(u) != start_.mesh.position(u);
  };
  LocalIndex missing = 0;
  for (const LocalIndex v : patch.rim) {
    const BoundaryVertex& own = patch.boundary[at(v)];
    if (own.next < 0 || patch.role[at(v)] == Role::gone)
      continue;
    const auto apexes = patch.mesh.apexes(v, own.next);
    if (!apexes) {
      ++missing;
      continue;
    }
    const Vec2 a = patch.mesh.position(v), b = patch.mesh.position(own.next);
    if (own.changed && !stands_for_curve(own, patch.boundary[at(own.next)], {a, b}, patch.size[at(v)]))
      return false;
    for (const LocalIndex apex : {apexes->left, apexes->right}) {
      if (apex < PatchMesh::frame || !(own.changed || has_moved(apex)))
        continue; // near the rim, not all that lies between is known
      if ((apex == apexes->right && !patch.on_boundary(apex)) ||
          geometry::diametral_side(a, b, patch.mesh.position(apex)) <= 0)
        return false;
    }
  }
  return missing <= missing_at_start_;
}

/// The difference between the sites and what they have become.
void PatchOptimizer::collect_edits(std::vector<SiteEdit>& edits) const {
  for (LocalIndex v = PatchMesh::frame; v < now_.mesh.vertices(); ++v) {
    const bool is_new = v >= start_.mesh.vertices(), is_gone = now_.role[at(v)] == Role::gone;
    const Vec2 to = now_.mesh.position(v), from = is_new ? to : start_.mesh.position(v);
    const BoundaryVertex& on_boundary = now_.boundary[at(v)];
    LocalIndex before = v; // the last one that had been there
    while (is_new && !is_gone && now_.on_boundary(v) && before >= start_.mesh.vertices())
      before = now_.boundary[at(before)].previous;
    const std::int32_t site = now_.boundary[at(before)].site;
    if (is_new && !is_gone)
      edits.push_back({to, to, EditKind::insert, site, on_boundary.arc});
    else if (!is_new && is_gone)
      edits.push_back({from, from, EditKind::remove, on_boundary.site, on_boundary.arc});
    else if (to != from)
      edits.push_back({from, to, EditKind::move, on_boundary.site, on_boundary.arc});
  }
}

/// Of all sites whose triangles are all known, if this patch has changed anything about them.
void PatchOptimizer::collect_verdicts(PatchResult& result) {
  const auto collect = [&](const Patch& patch, std::vector<double>& worst) {
    worst.assign(at(now_.mesh.vertices()), 0);
    for (const PatchMesh::Triangle& triangle : patch.mesh.triangles())
      if (is_bad(patch, triangle))
        for (const LocalIndex v : triangle.vertex)
          worst[at(v)] = std::max(worst[at(v)], alpha(patch, triangle));
  };
  collect(start_, worst_before_);
  collect(now_, worst_after_);
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles())
    if (is_bad(now_, triangle) && is_in_core(middle_of(now_, triangle.vertex)) && !is_tried(triangle.vertex)) {
      ++result.failures;
      for (const LocalIndex v : triangle.vertex)
        rests_[at(v)] = 1;
    }
  const auto is_news = [&](LocalIndex v) {
    return v >= start_.mesh.vertices() || now_.mesh.position(v) != start_.mesh.position(v) ||
           worst_after_[at(v)] != worst_before_[at(v)] || rests_[at(v)] != rested_[at(v)];
  };
  for (LocalIndex v = PatchMesh::frame; v < now_.mesh.vertices(); ++v)
    if (now_.role[at(v)] >= Role::scored && (worst_before_[at(v)] > 0 || worst_after_[at(v)] > 0) && is_news(v))
      result.verdicts.push_back({now_.mesh.position(v), now_.size[at(v)], worst_after_[at(v)], rests_[at(v)]});
}

/// As worst_untried tells of it.
PatchOptimizer::Corners PatchOptimizer::largest_first(Corners corners) {
  std::rotate(corners.begin(), std::max_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

bool PatchOptimizer::is_tried(const Corners& corners) const {
  return !tried_.empty() && std::find(tried_.begin(), tried_.end(), largest_first(corners)) != tried_.end();
}

/// Do all three? Then nothing helped for this triangle.
bool PatchOptimizer::rest(const Corners& corners) const {
  return rests_[at(corners[0])] && rests_[at(corners[1])] && rests_[at(corners[2])];
}

/// Who has moved, or is new, does not rest any more.
void PatchOptimizer::wake_moved(const Patch& before) {
  rests_.resize(at(now_.mesh.vertices()), 0);
  for (LocalIndex v = PatchMesh::frame; v < before.mesh.vertices(); ++v) {
    const double limit = waking_move * now_.size[at(v)];
    if (rests_[at(v)] && geometry::squared_length(now_.mesh.position(v) - before.mesh.position(v)) > limit * limit)
      rests_[at(v)] = 0;
  }
}

PatchResult PatchOptimizer::improve(Vec2 center, double size, std::span<const PatchSite> sites,
                                    const PatchBudget& budget) {
  PatchResult result;
  if (!build(center, size, sites)) {
    result.failures = 1;
    for (const PatchSite& site : sites)
      if (geometry::length(site.position - center) < 0.5 * options_.reach * size)
        result.verdicts.push_back({site.position, site.size, options_.bad_alpha, 1});
    return result;
  }
  now_ = start_;
  rested_ = rests_;
  if (!budget.is_again)
    operate_first(budget);
  move_bad_sites();
  wake_moved(start_);
  operate(budget);
  collect_edits(result.edits);
  collect_verdicts(result);
  return result;
}

} // namespace trime::meshing
