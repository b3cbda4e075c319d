// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_operations.hpp"

#include "geometry/predicates.hpp"
#include "polygon/rules.hpp"

#include <algorithm>
#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

// Share of a chord: within it of the middle a left-out corner is where the chord is divided.
constexpr double most_off_middle = 0.3;
constexpr LocalIndex least_in_loop = 8; // [sites] A loop with fewer loses none, so that it stays a loop

constexpr LocalIndex regular_degree = 6; // of a vertex among equilateral triangles

/// May an operation remove a vertex? Those on curves inside only move.
bool may_go(const Patch& patch, LocalIndex v) {
  return patch.role[at(v)] == VertexRole::free && !patch.on_curve(v);
}

Vec2 middle_of_longest_edge(const Patch& now, const Corners& corners) {
  const auto place = [&](std::size_t k) { return now.mesh.position(corners[k % 3]); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (geometry::squared_length(place(k + 2) - place(k + 1)) >
        geometry::squared_length(place(longest + 2) - place(longest + 1)))
      longest = k; // the edge opposite of vertex k
  return 0.5 * (place(longest + 1) + place(longest + 2));
}

/// The chord from vertex v to the next has another vertex of the boundary in its closed disc.
bool is_encroached(const Patch& trial, LocalIndex v) {
  const LocalIndex next = trial.boundary[at(v)].next;
  return std::any_of(trial.rim.begin(), trial.rim.end(), [&](LocalIndex u) {
    return u != v && u != next && !trial.is_gone(u) &&
           geometry::diametral_side(trial.mesh.position(v), trial.mesh.position(next), trial.mesh.position(u)) <= 0;
  });
}

using polygon::BoundaryCurve;

} // namespace

bool PatchEditor::apply(Patch& trial, const PatchOperation& operation, double size) const {
  for (const LocalIndex v : operation.removed)
    if (v >= 0 && !remove(trial, v))
      return false;
  for (const LocalIndex v : operation.divided)
    if (v >= 0 && !divide(trial, v))
      return false;
  return !operation.inserted || insert(trial, *operation.inserted, size);
}

bool PatchEditor::insert(Patch& trial, Vec2 place, double size) const {
  const geometry::Lattice& lattice = start_.lattice();
  Vec2 p = lattice.snap(place);
  if (const auto chord = trial.entered_disc(p)) {
    p = lattice.snap(0.5 * (chord->a + chord->b) +
                     polygon::PolygonRules::push_way * geometry::left_normal(chord->b - chord->a));
    if (trial.entered_disc(p))
      return false;
  }
  return start_.has_room(p, size) && trial.add(p, size, {}, VertexRole::free) >= 0;
}

bool PatchEditor::remove(Patch& trial, LocalIndex v) const {
  const BoundaryVertex& own = trial.boundary[at(v)];
  if (trial.on_boundary(v)) {
    if (own.previous < 0 || own.next < 0 || start_.sites_of_loop(own.loop) < least_in_loop)
      return false;
    trial.boundary[at(own.previous)].next = own.next;
    trial.boundary[at(own.previous)].changed = true;
    trial.boundary[at(own.next)].previous = own.previous;
    if (!chords_.stands_for_curve(trial, own.previous))
      return false;
  }
  trial.role[at(v)] = VertexRole::gone;
  --trial.gain;
  return trial.mesh.remove(v);
}

bool PatchEditor::divide(Patch& trial, LocalIndex before) const {
  const BoundaryVertex own = trial.boundary[at(before)];
  const LocalIndex after = own.next;
  if (after < 0)
    return false;
  const BoundaryCurve& curve = start_.curve();
  double end = trial.boundary[at(after)].arc;
  if (end <= own.arc)
    end += curve.length(own.loop);
  BoundaryVertex made{own.site, before, after, own.loop, 0.5 * (own.arc + end), own.tolerance, true};
  const BoundaryCurve::Strayed strayed = curve.strayed(own.loop, own.arc, end, trial.chord(before));
  if (strayed.bent && std::fabs(strayed.farthest - made.arc) < most_off_middle * (end - own.arc))
    made.arc = strayed.farthest; // a corner that was left out
  const Vec2 p =
      start_.periods().nearest_image(start_.lattice().snap(curve.place(own.loop, made.arc).point), start_.center());
  if (made.arc >= curve.length(own.loop))
    made.arc -= curve.length(own.loop);
  const double h = 0.5 * (trial.size[at(before)] + trial.size[at(after)]);
  const LocalIndex v = start_.has_room(p, h) ? trial.add(p, h, made, VertexRole::free) : -1;
  if (v < 0)
    return false;
  trial.boundary[at(before)].next = v;
  trial.boundary[at(before)].changed = true;
  trial.boundary[at(after)].previous = v;
  return true;
}

bool PatchRefiner::refine(const Patch& now, Patch& trial, const BadPlace& place) {
  if (!divide_around(now, trial, place.corners))
    return false;
  const LocalIndex most = now.mesh.vertices() + CleanupRules::most_refined;
  for (LocalIndex before = -1; before != trial.mesh.vertices();) {
    before = trial.mesh.vertices();
    if (!divide_where_strayed(trial, most) || !divide_where_encroached(trial, most))
      return false;
  }
  for (const Vec2 middle : middles_) // where there is room
    if (editor_.insert(trial, middle, place.size) && is_behind(trial, trial.mesh.vertices() - 1) &&
        !editor_.remove(trial, trial.mesh.vertices() - 1))
      return false;
  return true;
}

/// Divides the chords and lists the middles of the other edges.
bool PatchRefiner::divide_around(const Patch& now, Patch& trial, const Corners& worst) {
  const auto is_worst = [&](LocalIndex v) { return std::find(worst.begin(), worst.end(), v) != worst.end(); };
  middles_.clear();
  for (const PatchMesh::Triangle& triangle : now.mesh.triangles()) {
    if (std::none_of(triangle.vertex.begin(), triangle.vertex.end(), is_worst) || !now.counts(triangle))
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const LocalIndex v = triangle.vertex[k], next = triangle.vertex[(k + 1) % 3];
      if (now.is_chord(v, next)) {
        if (now.role[at(v)] < VertexRole::scored || now.role[at(next)] < VertexRole::scored ||
            !editor_.divide(trial, v))
          return false;
      } else if (!now.is_chord(next, v)) {
        const Vec2 middle = 0.5 * (now.mesh.position(v) + now.mesh.position(next));
        if (std::find(middles_.begin(), middles_.end(), middle) == middles_.end())
          middles_.push_back(middle);
      }
    }
  }
  return true;
}

/// Does the vertex lie outside, beyond a chord of the trial? The middle of an edge may be there after the boundary has
/// moved nearer to its curve.
bool PatchRefiner::is_behind(const Patch& trial, LocalIndex v) {
  trial.mesh.collect_ring(v, ring_);
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const LocalIndex from = ring_[k], to = ring_[k + 1 == ring_.size() ? 0 : k + 1];
    if (from >= PatchMesh::frame && to >= PatchMesh::frame && trial.is_chord(to, from))
      return true;
  }
  return false;
}

/// Divides new chords that may not take the place of the curve: half of a chord may pass farther from a ragged curve
/// than all of it. @param most number of vertices
bool PatchRefiner::divide_where_strayed(Patch& trial, LocalIndex most) const {
  for (std::size_t k = 0; k < trial.rim.size();) {
    const LocalIndex v = trial.rim[k];
    if (trial.boundary[at(v)].next < 0 || trial.is_gone(v) || !trial.boundary[at(v)].changed ||
        chords_.stands_for_curve(trial, v)) {
      ++k; // what is new comes later in the list
      continue;
    }
    if (trial.mesh.vertices() > most || !editor_.divide(trial, v))
      return false;
  }
  return true;
}

/// Divides chords with a vertex of the boundary in their discs; after each one it looks at all of them again.
bool PatchRefiner::divide_where_encroached(Patch& trial, LocalIndex most) const {
  for (std::size_t k = 0; k < trial.rim.size();) {
    if (trial.mesh.vertices() > most)
      return false;
    const LocalIndex v = trial.rim[k], next = trial.boundary[at(v)].next;
    if (next < 0 || trial.role[at(v)] < VertexRole::scored || trial.role[at(next)] < VertexRole::scored ||
        !is_encroached(trial, v)) {
      ++k;
      continue;
    }
    if (!editor_.divide(trial, v))
      return false;
    k = 0;
  }
  return true;
}

/// Once: rings of neighbours share vertices and edges.
void PatchOperations::add(const PatchOperation& operation) {
  if (std::find(all_.begin(), all_.end(), operation) == all_.end())
    all_.push_back(operation);
}

void PatchOperations::list(const Patch& now, const BadPlace& place, bool is_thorough) {
  all_.clear();
  if (!now.walls.empty())
    list_between_walls(now, place.corners);
  add_insertion(middle_of_longest_edge(now, place.corners));
  for (const LocalIndex v : place.corners)
    if (may_go(now, v))
      add_removal(v);
  if (place.alpha > CleanupRules::divide_alpha)
    list_at_boundary(now, place);
  add_insertion(place.middle);
  for (const LocalIndex v : place.corners)
    list_around(now, place.corners, v, is_thorough);
}

void PatchOperations::list_against_obtuse(const Patch& now, const BadPlace& place) {
  all_.insert(all_.begin(), PatchOperation{});
  for (std::size_t k = 0; k < 3; ++k)
    add_insertion(0.5 * (now.mesh.position(place.corners[k]) + now.mesh.position(place.corners[(k + 1) % 3])));
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex v = place.corners[k], next = place.corners[(k + 1) % 3], previous = place.corners[(k + 2) % 3];
    if (!now.is_chord(v, next) || !now.is_chord(previous, v))
      continue;
    divide_corner(now, v, next, previous);
  }
}

/// A corner with one triangle becomes one with two, whose common edge is as long as the chords.
void PatchOperations::divide_corner(const Patch& now, LocalIndex v, LocalIndex next, LocalIndex previous) {
  const Vec2 p = now.mesh.position(v), u = now.mesh.position(next) - p, w = now.mesh.position(previous) - p;
  const double a = geometry::length(u), b = geometry::length(w);
  const Vec2 along = (1 / a) * u + (1 / b) * w;
  const Vec2 inside = p + (0.5 * (a + b) / geometry::length(along)) * along;
  add_insertion(inside);
  for (const LocalIndex far : {next, previous})
    if (may_go(now, far))
      all_.push_back({.removed = {far, -1}, .inserted = inside});
  if (const auto apexes = now.mesh.apexes(next, previous); apexes)
    for (const LocalIndex far : {apexes->left, apexes->right})
      if (far >= PatchMesh::frame && far != v && may_go(now, far))
        all_.push_back({.removed = {far, -1}, .inserted = inside});
}

/// Corners between two curves inside, or between one and the boundary. Sites on curves only slide, so a site inside
/// must do all.
void PatchOperations::list_between_walls(const Patch& now, const Corners& worst) {
  const auto is_line = [&](LocalIndex a, LocalIndex b) {
    return now.is_wall(a, b) || now.is_chord(a, b) || now.is_chord(b, a);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex v = worst[k], next = worst[(k + 1) % 3], previous = worst[(k + 2) % 3];
    if ((now.is_wall(v, next) || now.is_wall(v, previous)) && is_line(v, next) && is_line(v, previous))
      divide_corner(now, v, next, previous);
  }
}

/// Insertions on the edges of a crowded vertex, and deletions of its neighbours.
void PatchOperations::list_around(const Patch& now, const Corners& worst, LocalIndex v, bool is_thorough) {
  now.mesh.collect_ring(v, ring_);
  if (may_go(now, v) && !now.on_boundary(v) && ring_.size() >= CleanupRules::many_neighbours)
    for (std::size_t k = 0; k < ring_.size(); k += 2)
      add_insertion(0.5 * (now.mesh.position(v) + now.mesh.position(ring_[k])));
  for (const LocalIndex u : ring_)
    if (u >= PatchMesh::frame && may_go(now, u) &&
        (is_thorough || (!now.on_boundary(u) && now.mesh.degree(u) < regular_degree)) &&
        std::find(worst.begin(), worst.end(), u) == worst.end())
      add_removal(u);
}

/// Operations that may help a triangle with edges on the boundary.
void PatchOperations::list_at_boundary(const Patch& now, const BadPlace& place) {
  const Corners& worst = place.corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex v = worst[k], next = worst[(k + 1) % 3], previous = worst[(k + 2) % 3];
    if (!now.is_chord(v, next))
      continue;
    all_.push_back({.divided = {v, -1}});
    all_.push_back({.divided = {v, -1}, .inserted = place.middle});
    if (!now.is_chord(previous, v))
      continue;
    // A corner with one triangle: a vertex inside must come nearer, or more of them.
    if (may_go(now, next) && may_go(now, previous))
      all_.push_back({.removed = {next, previous}});
    all_.push_back({.divided = {v, previous}});
    all_.push_back({.divided = {v, previous}, .inserted = place.middle});
  }
}

} // namespace trime::cleanup
