// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch.hpp"

#include "geometry/predicates.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::cleanup {

using geometry::Vec2;

void Patch::start(Vec2 center, double half_width, double h) {
  mesh.start(center, half_width);
  role.assign(PatchMesh::frame, VertexRole::held);
  size.assign(PatchMesh::frame, h);
  boundary.assign(PatchMesh::frame, {});
  rim.clear();
  walls.clear();
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
  for (const auto& [u, w] : walls)
    missing += !mesh.apexes(u, w);
  return missing;
}

std::optional<geometry::Segment> Patch::entered_disc(Vec2 p) const {
  for (const LocalIndex v : rim)
    if (const LocalIndex next = boundary[at(v)].next;
        next >= 0 && !is_gone(v) && geometry::diametral_side(mesh.position(v), mesh.position(next), p) <= 0)
      return chord(v);
  for (const auto& [u, w] : walls) {
    const Vec2 a = mesh.position(u), b = mesh.position(w);
    if (geometry::diametral_side(a, b, p) <= 0)
      return geometry::cross(b - a, p - a) < 0 ? geometry::Segment{b, a} : geometry::Segment{a, b};
  }
  return std::nullopt;
}

bool Patch::is_behind_wall(Vec2 p, Vec2 q) const {
  const auto parts = [](Vec2 a, Vec2 b, Vec2 u, Vec2 w) {
    const double of_u = geometry::cross(b - a, u - a), of_w = geometry::cross(b - a, w - a);
    return (of_u < 0 && of_w > 0) || (of_u > 0 && of_w < 0);
  };
  return std::any_of(walls.begin(), walls.end(), [&](const auto& wall) {
    const Vec2 u = mesh.position(wall.first), w = mesh.position(wall.second);
    return parts(p, q, u, w) && parts(u, w, p, q);
  });
}

bool Patch::is_surely_below(double limit, const Corners& corners) const {
  return mesh::is_surely_below(limit, mesh.position(corners[0]), mesh.position(corners[1]),
                               mesh.position(corners[2])) &&
         !(ear_alpha > 0 && is_ear(corners));
}

bool Patch::is_ear(const Corners& corners) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const LocalIndex before = corners[k], v = corners[(k + 1) % 3], after = corners[(k + 2) % 3];
    if (is_chord(before, v) && is_chord(v, after))
      return is_wide_corner(mesh.position(v), mesh.position(before), mesh.position(after));
  }
  return false;
}

bool Patch::is_obtuse(const Corners& corners) const {
  return mesh::is_obtuse(mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2]));
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

namespace {

using geometry::Vec2;

// [lattice steps] Largest half side of the frame. The predicates are exact up to it, and it is more than the
// container at any place of it.
constexpr double widest_frame = 0x1.8p44;

} // namespace

bool PatchStart::build(Vec2 center, double size, std::span<const PatchSite> sites) {
  center_ = center;
  size_ = size;
  if (sites.size() > CleanupRules::most_in_patch)
    return false;
  const double reach = CleanupRules::reach * size;
  patch_.start(center, std::min(lattice_.snap(CleanupRules::frame_share * reach), widest_frame * lattice_.step()),
               size);
  next_.clear();
  for (const PatchSite& site : sites) {
    patch_.append(patch_.mesh.append(site.position), site.size, on_boundary(site), role_of(site));
    if (site.boundary >= 0)
      next_.push_back(site.on_boundary.next);
  }
  patch_.mesh.connect_all();
  patch_.gain = 0;
  link_boundary();
  link_curves();
  missing_chords_ = patch_.missing_chords();
  return std::any_of(sites.begin(), sites.end(), [this](const PatchSite& site) { return is_deep(site); });
}

bool PatchStart::may_move(const PatchSite& site) const {
  const LocalIndex on_curve = index_on_curve(site.boundary);
  return on_curve < 0 ? site.boundary != mesh::fixed_site : inner().track[at(on_curve)] != polygon::InnerChords::held;
}

/// Does nothing outside feel a change there? Where all such sites are corners, others may come.
bool PatchStart::is_deep(const PatchSite& site) const {
  return may_move(site) &&
         distance(site.position) + CleanupRules::free_depth * std::fmax(site.size, size_) < CleanupRules::reach * size_;
}

VertexRole PatchStart::role_of(const PatchSite& site) const {
  const double away = distance(site.position), reach = CleanupRules::reach * size_;
  const double coarser = std::fmax(site.size, size_);
  const bool is_corner = site.boundary >= 0 && site.on_boundary.corner;
  VertexRole role = VertexRole::held;
  if (is_deep(site))
    role = VertexRole::free;
  else if (away + CleanupRules::scored_depth * coarser < reach)
    role = VertexRole::scored;
  return is_corner ? std::min(role, VertexRole::scored) : role;
}

BoundaryVertex PatchStart::on_boundary(const PatchSite& site) {
  BoundaryVertex vertex;
  vertex.site = site.boundary;
  if (site.boundary < 0)
    return vertex;
  vertex.tolerance = site.on_boundary.tolerance;
  vertex.loop = site.on_boundary.loop;
  vertex.arc = site.on_boundary.arc;
  return vertex;
}

/// Joins neighbours along the boundary: the image of the next site that is near. A site whose neighbour there is beyond
/// the patch is held.
void PatchStart::link_boundary() {
  for (std::size_t k = 0; k < patch_.rim.size(); ++k) {
    const LocalIndex v = patch_.rim[k];
    const Vec2 p = patch_.mesh.position(v);
    for (const LocalIndex u : patch_.rim)
      if (const Vec2 q = patch_.mesh.position(u);
          patch_.boundary[at(u)].site == next_[k] && periods().nearest_image(q, p) == q) {
        patch_.boundary[at(v)].next = u;
        patch_.boundary[at(u)].previous = v;
      }
  }
  for (const LocalIndex v : patch_.rim) {
    const BoundaryVertex& own = patch_.boundary[at(v)];
    if (own.next < 0 || own.previous < 0)
      patch_.role[at(v)] = std::min(patch_.role[at(v)], VertexRole::scored);
  }
}

/// Finds the chords of inner curves whose ends are both in the patch, by the positions of the ends before the clean-up.
/// A site on a curve whose neighbour there is beyond the patch is held. Positions are those of the images in the patch.
void PatchStart::link_curves() {
  if (inner().empty())
    return;
  std::vector<std::pair<Vec2, LocalIndex>> vertices; // that may be ends
  for (LocalIndex v = PatchMesh::frame; v < patch_.mesh.vertices(); ++v)
    if (const LocalIndex site = index_on_curve(patch_.boundary[at(v)].site); site >= 0)
      vertices.emplace_back(periods().nearest_image(inner().sites[at(site)], patch_.mesh.position(v)), v);
    else if (patch_.role[at(v)] != VertexRole::free)
      vertices.emplace_back(patch_.mesh.position(v), v);
  const auto before = [](const auto& a, const auto& b) { return geometry::lexicographically_less(a.first, b.first); };
  std::sort(vertices.begin(), vertices.end(), before);
  for (const auto& [p, v] : vertices)
    for (const LocalIndex half : inner().at(periods().wrap(p))) {
      const Vec2 shift = p - periods().wrap(p);
      const std::pair<Vec2, LocalIndex> other{inner().other_end(half) + shift, -1};
      const auto found = std::lower_bound(vertices.begin(), vertices.end(), other, before);
      if (found == vertices.end() || found->first != other.first)
        patch_.role[at(v)] = std::min(patch_.role[at(v)], VertexRole::scored);
      else if (half % 2 == 0)
        patch_.walls.push_back({std::min(v, found->second), std::max(v, found->second)});
    }
}

} // namespace trime::cleanup
