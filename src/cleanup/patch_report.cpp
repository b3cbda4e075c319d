// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_report.hpp"

#include <algorithm>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using polygon::EditKind;

} // namespace

/// The boundary site of a vertex; of a new one on the boundary, that of the last old one before it.
std::int32_t PatchReport::site_before(const Patch& now, LocalIndex v, LocalIndex first_new) {
  while (v >= first_new && !now.is_gone(v) && now.on_boundary(v))
    v = now.boundary[at(v)].previous;
  return now.boundary[at(v)].site;
}

std::vector<SiteEdit> PatchReport::edits(const Patch& now) const {
  std::vector<SiteEdit> edits;
  for (LocalIndex v = PatchMesh::frame; v < now.mesh.vertices(); ++v) {
    const bool is_new = v >= start_.vertices(), is_gone = now.is_gone(v);
    const Vec2 to = now.mesh.position(v), from = is_new ? to : start_.patch().mesh.position(v);
    const BoundaryVertex& on_boundary = now.boundary[at(v)];
    if (is_new && !is_gone)
      edits.push_back({to, to, EditKind::insert, site_before(now, v, start_.vertices()), on_boundary.arc});
    else if (!is_new && is_gone)
      edits.push_back({from, from, EditKind::remove, on_boundary.site, on_boundary.arc});
    else if (to != from)
      edits.push_back({from, to, EditKind::move, on_boundary.site, on_boundary.arc});
  }
  return edits;
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
