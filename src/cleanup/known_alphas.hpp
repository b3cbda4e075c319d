// SPDX-License-Identifier: BSD-3-Clause
// The aspect ratios of the triangles of a patch from one sweep to the next.
#pragma once

#include "cleanup/patch.hpp"

#include <vector>

namespace trime::cleanup {

/// @brief Aspect ratios that are computed again only where vertices have moved or edges have been flipped: the same
/// bits as Patch::alpha, without most of its roots.
class KnownAlphas {
public:
  /// Another patch, or another number of vertices, comes next.
  void forget() {
    places_.clear();
    known_.clear();
    time_ = 0;
  }
  /// @brief The patch may have moved. O(vertices). To be called before `alpha`.
  void follow(const Patch& patch) {
    const auto vertices = at(patch.mesh.vertices());
    has_moved_.assign(vertices, 1);
    for (std::size_t v = 0; v < places_.size(); ++v)
      has_moved_[v] = patch.mesh.position(static_cast<LocalIndex>(v)) != places_[v];
    places_.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
      places_[v] = patch.mesh.position(static_cast<LocalIndex>(v));
    known_.resize(patch.mesh.triangles().size(), {{-1, -1, -1}, 0, 1});
    ++time_;
  }
  /// Returns alpha of a triangle of the patch.
  double alpha(const Patch& patch, const PatchMesh::Triangle& triangle) {
    const auto& [a, b, c] = triangle.vertex;
    Known& known = known_[static_cast<std::size_t>(&triangle - patch.mesh.triangles().data())];
    if (known.vertex != triangle.vertex || known.time + 1 < time_ ||
        (has_moved_[at(a)] | has_moved_[at(b)] | has_moved_[at(c)]) != 0)
      known = {triangle.vertex, time_, patch.alpha(triangle.vertex)};
    known.time = time_;
    return known.alpha;
  }

private:
  struct Known {
    Corners vertex;
    int time; // when it was asked for the last time
    double alpha;
  };
  int time_ = 0;                        // counts the calls of follow
  std::vector<geometry::Vec2> places_;  // by vertex: the positions that `known_` was computed from
  std::vector<std::uint8_t> has_moved_; // by vertex, since then
  std::vector<Known> known_;            // by triangle
};

} // namespace trime::cleanup
