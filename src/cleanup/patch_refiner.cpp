// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_refiner.hpp"

#include "geometry/diametral.hpp"

#include <algorithm>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

/// The chord from vertex v to the next has another vertex of the boundary in its closed disc.
bool is_encroached(const Patch& trial, LocalIndex v) {
  const LocalIndex next = trial.boundary[at(v)].next;
  return std::any_of(trial.rim.begin(), trial.rim.end(), [&](LocalIndex u) {
    return u != v && u != next && !trial.is_gone(u) &&
           geometry::diametral_side(trial.mesh.position(v), trial.mesh.position(next), trial.mesh.position(u)) <= 0;
  });
}

} // namespace

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

} // namespace trime::cleanup
