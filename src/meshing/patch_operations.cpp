// SPDX-License-Identifier: BSD-3-Clause
// Insertions and deletions in a patch: what may help a bad triangle, and how it is carried out.
#include "meshing/patch.hpp"

#include "trime/geometry/diametral.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double most_off_middle = 0.3; // of a chord, where it is divided
constexpr double push_share = 0.6;      // of a chord: how far from its middle an insertion keeps
constexpr LocalIndex most_refined = 40; // new sites on the boundary
constexpr double divide_alpha = 1.1;    // triangles above it may divide chords of the boundary

} // namespace

/// What may help the worst triangle.
void PatchOptimizer::list_operations(const Contest& contest) {
  operations_.clear();
  const Corners& worst = contest.corners;
  const auto place = [&](std::size_t k) { return now_.mesh.position(worst[k % 3]); };
  const auto list = [&](const Operation& operation) { // once: rings of neighbours share vertices and edges
    if (std::find(operations_.begin(), operations_.end(), operation) == operations_.end())
      operations_.push_back(operation);
  };
  const auto insert = [&](Vec2 p) { list({.inserted = p}); };
  const auto remove = [&](LocalIndex v) { list({.removed = {v, -1}}); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (geometry::squared_length(place(k + 2) - place(k + 1)) >
        geometry::squared_length(place(longest + 2) - place(longest + 1)))
      longest = k; // the edge opposite of vertex k
  insert(0.5 * (place(longest + 1) + place(longest + 2)));
  for (const LocalIndex v : worst)
    if (now_.role[at(v)] == Role::free)
      remove(v);
  if (contest.alpha > divide_alpha)
    list_at_boundary(contest);
  insert(contest.middle);
  for (const LocalIndex v : worst) {
    now_.mesh.collect_ring(v, ring_);
    if (now_.role[at(v)] == Role::free && !now_.on_boundary(v) && ring_.size() >= 7)
      for (std::size_t k = 0; k < ring_.size(); k += 2)
        insert(0.5 * (now_.mesh.position(v) + now_.mesh.position(ring_[k])));
    for (const LocalIndex u : ring_)
      if (u >= PatchMesh::frame && now_.role[at(u)] == Role::free &&
          (is_thorough_ || (!now_.on_boundary(u) && now_.mesh.degree(u) < 6)) &&
          std::find(worst.begin(), worst.end(), u) == worst.end())
        remove(u);
  }
}

/// What may help a triangle with edges on the boundary.
void PatchOptimizer::list_at_boundary(const Contest& contest) {
  const Corners& worst = contest.corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex v = worst[k], next = worst[(k + 1) % 3], previous = worst[(k + 2) % 3];
    if (!now_.is_chord(v, next))
      continue;
    operations_.push_back({.divided = {v, -1}});
    operations_.push_back({.divided = {v, -1}, .inserted = contest.middle});
    if (!now_.is_chord(previous, v))
      continue;
    // A corner with one triangle: a vertex inside must come nearer, or more of them.
    if (now_.role[at(next)] == Role::free && now_.role[at(previous)] == Role::free)
      operations_.push_back({.removed = {next, previous}});
    operations_.push_back({.divided = {v, previous}});
    operations_.push_back({.divided = {v, previous}, .inserted = contest.middle});
  }
}

/// Carries it out on the trial. @return false if it cannot be done
bool PatchOptimizer::apply(const Operation& operation) {
  for (const LocalIndex v : operation.removed)
    if (v >= 0 && !remove(v))
      return false;
  for (const LocalIndex v : operation.divided)
    if (v >= 0 && !insert_on_boundary(v))
      return false;
  return !operation.inserted || insert(*operation.inserted);
}

/// Is a new site there far enough from the rim?
bool PatchOptimizer::is_within_reach(Vec2 p, double h) const {
  return geometry::length(p - center_) + PatchOptions::clearance * std::fmax(h, size_) < options_.reach * size_;
}

/// A chord in whose closed disc p lies.
std::optional<geometry::Segment> PatchOptimizer::entered_disc(const Patch& patch, Vec2 p) const {
  for (const LocalIndex v : patch.rim)
    if (const LocalIndex next = patch.boundary[at(v)].next;
        next >= 0 && patch.role[at(v)] != Role::gone &&
        geometry::diametral_side(patch.mesh.position(v), patch.mesh.position(next), p) <= 0)
      return geometry::Segment{patch.mesh.position(v), patch.mesh.position(next)};
  return std::nullopt;
}

bool PatchOptimizer::insert(Vec2 place) {
  Vec2 p = lattice_.snap(place);
  if (const auto chord = entered_disc(trial_, p)) { // such as in the corner of a square
    p = lattice_.snap(0.5 * (chord->a + chord->b) + push_share * geometry::left_normal(chord->b - chord->a));
    if (entered_disc(trial_, p))
      return false;
  }
  return is_within_reach(p, place_size_) && trial_.add(p, place_size_, {}, Role::free) >= 0;
}

bool PatchOptimizer::remove(LocalIndex v) {
  const BoundaryVertex& own = trial_.boundary[at(v)];
  if (trial_.on_boundary(v)) {
    if (own.previous < 0 || own.next < 0 ||
        boundary_.loop_start[at(own.loop) + 1] - boundary_.loop_start[at(own.loop)] < 8)
      return false;
    trial_.boundary[at(own.previous)].next = own.next;
    trial_.boundary[at(own.previous)].changed = true;
    trial_.boundary[at(own.next)].previous = own.previous;
    const BoundaryVertex &from = trial_.boundary[at(own.previous)], &to = trial_.boundary[at(own.next)];
    if (!stands_for_curve(from, to, {trial_.mesh.position(own.previous), trial_.mesh.position(own.next)},
                          trial_.size[at(own.previous)]))
      return false;
  }
  trial_.role[at(v)] = Role::gone;
  --trial_.gain;
  return trial_.mesh.remove(v);
}

bool PatchOptimizer::insert_on_boundary(LocalIndex before) {
  const BoundaryVertex own = trial_.boundary[at(before)];
  const LocalIndex after = own.next;
  if (after < 0)
    return false;
  double end = trial_.boundary[at(after)].arc;
  if (end <= own.arc)
    end += curve_.length(own.loop);
  BoundaryVertex made{own.site, before, after, own.loop, 0.5 * (own.arc + end), own.tolerance, true};
  const BoundaryCurve::Strayed strayed =
      curve_.strayed(own.loop, own.arc, end, {trial_.mesh.position(before), trial_.mesh.position(after)});
  if (strayed.bent && std::fabs(strayed.farthest - made.arc) < most_off_middle * (end - own.arc))
    made.arc = strayed.farthest; // a corner that was left out
  const Vec2 p = boundary_.periods.nearest_image(lattice_.snap(curve_.place(own.loop, made.arc).point), center_);
  if (made.arc >= curve_.length(own.loop))
    made.arc -= curve_.length(own.loop);
  const double h = 0.5 * (trial_.size[at(before)] + trial_.size[at(after)]);
  const LocalIndex v = is_within_reach(p, h) ? trial_.add(p, h, made, Role::free) : -1;
  if (v < 0)
    return false;
  trial_.boundary[at(before)].next = v;
  trial_.boundary[at(before)].changed = true;
  trial_.boundary[at(after)].previous = v;
  return true;
}

/// Divides all edges of the triangles that have a vertex of the worst one: the boundary is too ragged for h there.
bool PatchOptimizer::refine(const Corners& worst) {
  const auto is_worst = [&](LocalIndex v) { return std::find(worst.begin(), worst.end(), v) != worst.end(); };
  std::vector<Vec2> middles;
  for (const PatchMesh::Triangle& triangle : now_.mesh.triangles()) {
    if (std::none_of(triangle.vertex.begin(), triangle.vertex.end(), is_worst) || !counts(now_, triangle))
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalIndex v = triangle.vertex[k], next = triangle.vertex[(k + 1) % 3];
      if (now_.is_chord(v, next)) {
        if (now_.role[at(v)] < Role::scored || now_.role[at(next)] < Role::scored || !insert_on_boundary(v))
          return false;
      } else if (!now_.is_chord(next, v)) {
        const Vec2 middle = 0.5 * (now_.mesh.position(v) + now_.mesh.position(next));
        if (std::find(middles.begin(), middles.end(), middle) == middles.end())
          middles.push_back(middle);
      }
    }
  }
  for (LocalIndex before = -1; before != trial_.mesh.vertices();) {
    before = trial_.mesh.vertices();
    if (!divide_where_strayed() || !divide_where_encroached())
      return false;
  }
  for (const Vec2 middle : middles) // where there is room
    if (insert(middle) && is_behind(trial_.mesh.vertices() - 1) && !remove(trial_.mesh.vertices() - 1))
      return false;
  return true;
}

/// Does the vertex lie outside, beyond a chord of the trial? So may the middle of an edge when the boundary comes
/// nearer to its curve.
bool PatchOptimizer::is_behind(LocalIndex v) {
  trial_.mesh.collect_ring(v, ring_);
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const LocalIndex from = ring_[k], to = ring_[k + 1 == ring_.size() ? 0 : k + 1];
    if (from >= PatchMesh::frame && to >= PatchMesh::frame && trial_.is_chord(to, from))
      return true;
  }
  return false;
}

/// Divides new chords that may not take the place of the curve: half of a chord may pass farther from a ragged curve
/// than all of it.
bool PatchOptimizer::divide_where_strayed() {
  for (std::size_t k = 0; k < trial_.rim.size();) {
    const LocalIndex v = trial_.rim[k], next = trial_.boundary[at(v)].next;
    if (next < 0 || trial_.role[at(v)] == Role::gone || !trial_.boundary[at(v)].changed ||
        stands_for_curve(trial_.boundary[at(v)], trial_.boundary[at(next)],
                         {trial_.mesh.position(v), trial_.mesh.position(next)}, trial_.size[at(v)])) {
      ++k; // what is new comes later in the list
      continue;
    }
    if (trial_.mesh.vertices() > now_.mesh.vertices() + most_refined || !insert_on_boundary(v))
      return false;
  }
  return true;
}

/// Divides chords with a vertex of the boundary in their discs.
bool PatchOptimizer::divide_where_encroached() {
  for (std::size_t k = 0; k < trial_.rim.size(); ++k) {
    if (trial_.mesh.vertices() > now_.mesh.vertices() + most_refined)
      return false;
    const LocalIndex v = trial_.rim[k], next = trial_.boundary[at(v)].next;
    if (next < 0 || trial_.role[at(v)] < Role::scored || trial_.role[at(next)] < Role::scored)
      continue;
    for (const LocalIndex u : trial_.rim)
      if (u != v && u != next && trial_.role[at(u)] != Role::gone &&
          geometry::diametral_side(trial_.mesh.position(v), trial_.mesh.position(next), trial_.mesh.position(u)) <= 0) {
        if (!insert_on_boundary(v))
          return false;
        k = static_cast<std::size_t>(-1); // from the beginning
        break;
      }
  }
  return true;
}

} // namespace trime::meshing
