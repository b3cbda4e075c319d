// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_operations.hpp"

#include <algorithm>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

constexpr LocalIndex regular_degree = 6; // of a vertex among equilateral triangles

bool is_free(const Patch& patch, LocalIndex v) {
  return patch.role[at(v)] == VertexRole::free;
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

} // namespace

/// Once: rings of neighbours share vertices and edges.
void PatchOperations::add(const PatchOperation& operation) {
  if (std::find(all_.begin(), all_.end(), operation) == all_.end())
    all_.push_back(operation);
}

void PatchOperations::list(const Patch& now, const BadPlace& place, bool is_thorough) {
  all_.clear();
  add_insertion(middle_of_longest_edge(now, place.corners));
  for (const LocalIndex v : place.corners)
    if (is_free(now, v))
      add_removal(v);
  if (place.alpha > CleanupRules::divide_alpha)
    list_at_boundary(now, place);
  add_insertion(place.middle);
  for (const LocalIndex v : place.corners)
    list_around(now, place.corners, v, is_thorough);
}

/// Insertions on the edges of a crowded vertex, and deletions of its neighbours.
void PatchOperations::list_around(const Patch& now, const Corners& worst, LocalIndex v, bool is_thorough) {
  now.mesh.collect_ring(v, ring_);
  if (is_free(now, v) && !now.on_boundary(v) && ring_.size() >= CleanupRules::many_neighbours)
    for (std::size_t k = 0; k < ring_.size(); k += 2)
      add_insertion(0.5 * (now.mesh.position(v) + now.mesh.position(ring_[k])));
  for (const LocalIndex u : ring_)
    if (u >= PatchMesh::frame && is_free(now, u) &&
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
    if (is_free(now, next) && is_free(now, previous))
      all_.push_back({.removed = {next, previous}});
    all_.push_back({.divided = {v, previous}});
    all_.push_back({.divided = {v, previous}, .inserted = place.middle});
  }
}

} // namespace trime::cleanup
