// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_start.hpp"

namespace trime::cleanup {
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
  missing_chords_ = patch_.missing_chords();
  return std::any_of(sites.begin(), sites.end(), [this](const PatchSite& site) { return is_deep(site); });
}

/// Does nothing outside feel a change there? Where all such sites are corners, others may come.
bool PatchStart::is_deep(const PatchSite& site) const {
  return site.boundary != mesh::fixed_site &&
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
  if (site.boundary < 0)
    return vertex;
  vertex.site = site.boundary;
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

} // namespace trime::cleanup
