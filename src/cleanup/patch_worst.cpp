// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_worst.hpp"

#include <algorithm>

namespace trime::cleanup {

Corners PatchWorst::largest_first(Corners corners) {
  std::rotate(corners.begin(), std::max_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

bool PatchWorst::is_tried(const Corners& corners) const {
  return !tried_.empty() && std::find(tried_.begin(), tried_.end(), largest_first(corners)) != tried_.end();
}

std::optional<Corners> PatchWorst::next(const Patch& now) {
  if (!is_listed_)
    list(now);
  const BadTriangle* worst = nullptr;
  for (const BadTriangle& bad : bad_)
    if ((!worst || bad.alpha > worst->alpha) && !rests_.all_rest(bad.corners) && !is_tried(bad.corners))
      worst = &bad;
  return worst ? std::optional(worst->corners) : std::nullopt;
}

void PatchWorst::list(const Patch& now) {
  bad_.clear();
  is_listed_ = true;
  for (const PatchMesh::Triangle& triangle : now.mesh.triangles()) {
    const Corners& vertex = triangle.vertex;
    if (vertex[0] < 0 || !start_.is_in_core(now.middle_of(vertex)) || now.is_surely_below(above_, vertex) ||
        !now.counts(triangle))
      continue;
    if (const double alpha = now.alpha(vertex); alpha > above_)
      bad_.push_back({largest_first(vertex), alpha});
  }
}

} // namespace trime::cleanup
