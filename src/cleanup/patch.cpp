// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch.hpp"

#include "geometry/diametral.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::cleanup {

using geometry::Vec2;

void Patch::start(Vec2 center, double half_width, double h) {
  mesh.start(center, half_width);
  role.assign(PatchMesh::frame, VertexRole::held);
  size.assign(PatchMesh::frame, h);
  boundary.assign(PatchMesh::frame, {});
  rim.clear();
  broken = false;
}

LocalIndex Patch::add(Vec2 p, double h, const BoundaryVertex& on_boundary, VertexRole its_role) {
  const LocalIndex v = mesh.insert(p);
  if (v >= 0)
    append(v, h, on_boundary, its_role);
  return v;
}

void Patch::append(LocalIndex v, double h, const BoundaryVertex& on_boundary, VertexRole its_role) {
  role.push_back(its_role);
  size.push_back(h);
  boundary.push_back(on_boundary);
  if (on_boundary.site >= 0)
    rim.push_back(v);
  ++gain;
}

LocalIndex Patch::missing_chords() const {
  LocalIndex missing = 0;
  for (const LocalIndex v : rim)
    missing += !is_gone(v) && boundary[at(v)].next >= 0 && !mesh.apexes(v, boundary[at(v)].next);
  return missing;
}

std::optional<geometry::Segment> Patch::entered_disc(Vec2 p) const {
  for (const LocalIndex v : rim)
    if (const LocalIndex next = boundary[at(v)].next;
        next >= 0 && !is_gone(v) && geometry::diametral_side(mesh.position(v), mesh.position(next), p) <= 0)
      return chord(v);
  return std::nullopt;
}

bool Patch::is_surely_below(double limit, const Corners& corners) const {
  return mesh::is_surely_below(limit, mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2]));
}

/// A triangle with a vertex inside lies inside. For others a chord among the edges decides on which side they lie;
/// without one, the neighbours decide, and their neighbours.
bool Patch::lies_inside(const PatchMesh::Triangle& triangle) const {
  constexpr std::size_t most = CleanupRules::most_searched;
  std::array<const PatchMesh::Triangle*, most> found; // only the first `count`
  found[0] = &triangle;
  std::size_t count = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const PatchMesh::Triangle& at_hand = *found[i];
    for (const LocalIndex v : at_hand.vertex)
      if (v >= PatchMesh::frame && !on_boundary(v))
        return true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_chord(at_hand.vertex[k], at_hand.vertex[(k + 1) % 3]))
        return true;
      if (is_chord(at_hand.vertex[(k + 1) % 3], at_hand.vertex[k]))
        return false;
    }
    for (const LocalIndex t : at_hand.neighbour) {
      if (t < 0)
        return false; // beyond the frame all is unknown
      const PatchMesh::Triangle* next = &mesh.triangles()[at(t)];
      const auto end = found.begin() + static_cast<std::ptrdiff_t>(count);
      if (count < most && std::find(found.begin(), end, next) == end)
        found[count++] = next;
    }
  }
  return false;
}

} // namespace trime::cleanup
