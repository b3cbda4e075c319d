// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_report.hpp"

#include "core/random.hpp"

#include <algorithm>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using polygon::EditKind;

} // namespace

/// The boundary site of a vertex; of a new one on the boundary, that of the last old one before it.
BoundaryName PatchReport::site_before(const Patch& now, LocalIndex v) const {
  while (is_new(v) && !now.is_gone(v) && now.on_boundary(v))
    v = now.boundary[at(v)].previous;
  return now.boundary[at(v)].site;
}

/// This bit distinguishes new sites on the boundary from old ones, whose names are indices.
BoundaryName PatchReport::name(const Patch& now, LocalIndex v, std::uint64_t patch) const {
  constexpr BoundaryName new_site = BoundaryName{1} << 62;
  if (!is_new(v) || !now.on_boundary(v))
    return now.boundary[at(v)].site;
  return new_site | static_cast<BoundaryName>(mix_bits(patch + static_cast<std::uint64_t>(v)) >> 2);
}

std::vector<SiteEdit> PatchReport::edits(const Patch& now, std::uint64_t patch) const {
  std::vector<SiteEdit> edits;
  for (LocalIndex v = PatchMesh::frame; v < now.mesh.vertices(); ++v) {
    const bool is_gone = now.is_gone(v);
    const Vec2 to = now.mesh.position(v), from = is_new(v) ? to : start_.patch().mesh.position(v);
    const BoundaryVertex& its = now.boundary[at(v)];
    if (is_new(v) && !is_gone)
      edits.push_back({to, to, EditKind::insert, its.loop, site_before(now, v), name(now, v, patch), its.arc, patch});
    else if (!is_new(v) && is_gone)
      edits.push_back({from, from, EditKind::remove, its.loop, its.site, mesh::free_site, its.arc, patch});
    else if (to != from)
      edits.push_back({from, to, EditKind::move, its.loop, its.site, mesh::free_site, its.arc, patch});
  }
  return edits;
}

std::vector<BoundaryLink> PatchReport::links(const Patch& now, std::uint64_t patch) const {
  std::vector<BoundaryLink> links;
  for (const LocalIndex v : now.rim) {
    const LocalIndex next = now.boundary[at(v)].next;
    if (!now.is_gone(v) && next >= 0 && (start_.has_changed(now, v) || next != start_.patch().boundary[at(v)].next))
      links.push_back({now.mesh.position(v), name(now, v, patch), name(now, next, patch)});
  }
  return links;
}

void PatchReport::find_worst(const Patch& patch, double bad_alpha, std::vector<double>& worst) {
  for (const PatchMesh::Triangle& triangle : patch.mesh.triangles())
    if (patch.is_bad(triangle, bad_alpha))
      for (const LocalIndex v : triangle.vertex)
        worst[at(v)] = std::max(worst[at(v)], patch.alpha(triangle.vertex));
}

bool PatchReport::is_news(const Patch& now, LocalIndex v) const {
  return start_.has_changed(now, v) || worst_after_[at(v)] != worst_before_[at(v)] || rests_.has_changed(v);
}

std::vector<SiteVerdict> PatchReport::verdicts(const Patch& now, double bad_alpha) {
  worst_before_.assign(at(now.mesh.vertices()), 0);
  worst_after_.assign(at(now.mesh.vertices()), 0);
  find_worst(start_.patch(), bad_alpha, worst_before_);
  find_worst(now, bad_alpha, worst_after_);
  std::vector<SiteVerdict> verdicts;
  for (LocalIndex v = PatchMesh::frame; v < now.mesh.vertices(); ++v)
    if (now.role[at(v)] >= VertexRole::scored && (worst_before_[at(v)] > 0 || worst_after_[at(v)] > 0) &&
        is_news(now, v))
      verdicts.push_back({now.mesh.position(v), now.size[at(v)], worst_after_[at(v)], rests_.rests(v)});
  return verdicts;
}

} // namespace trime::cleanup
