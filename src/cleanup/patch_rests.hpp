// SPDX-License-Identifier: BSD-3-Clause
// The sites of a patch that rest, since nothing helped at their bad triangles.
#pragma once

#include "cleanup/patch.hpp"
#include "cleanup/patch_data.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief A triangle whose three sites rest is left alone. A site that moves or is new does not rest.
class PatchRests {
public:
  /// @param sites of the patch, in the order of its vertices
  void start(std::span<const PatchSite> sites) {
    rests_.assign(PatchMesh::frame, 0);
    for (const PatchSite& site : sites)
      rests_.push_back(site.rests != 0);
    at_start_ = rests_;
  }
  bool rests(LocalIndex v) const { return rests_[at(v)] != 0; }
  bool all_rest(const Corners& corners) const { return rests(corners[0]) && rests(corners[1]) && rests(corners[2]); }
  /// @pre the site was there at the start
  bool has_changed(LocalIndex v) const { return rests_[at(v)] != at_start_[at(v)]; }

  void let_rest(const Corners& corners) {
    for (const LocalIndex v : corners)
      rests_[at(v)] = 1;
  }
  void wake(std::span<const LocalIndex> vertices) {
    for (const LocalIndex v : vertices)
      rests_[at(v)] = 0;
  }
  /// Sites that have moved far no longer rest, and new sites do not rest.
  void wake_moved(const Patch& before, const Patch& now) {
    rests_.resize(at(now.mesh.vertices()), 0);
    for (LocalIndex v = PatchMesh::frame; v < before.mesh.vertices(); ++v) {
      const double limit = CleanupRules::waking_move * now.size[at(v)];
      if (rests(v) && geometry::squared_length(now.mesh.position(v) - before.mesh.position(v)) > limit * limit)
        rests_[at(v)] = 0;
    }
  }

private:
  std::vector<std::uint8_t> rests_, at_start_; // by vertex
};

} // namespace trime::cleanup
