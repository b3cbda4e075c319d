// SPDX-License-Identifier: BSD-3-Clause
// A patch before any change: its sites, and which of them may take part.
#pragma once

#include "cleanup/patch.hpp"
#include "cleanup/patch_data.hpp"
#include "polygon/boundary_curve.hpp"
#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The place of a patch and the sites around it before any change. Trials are compared with it. One object is
/// used for one patch after the other.
class PatchStart {
public:
  /// The arguments must outlive the object. @param boundary sites at the beginning; only loops and periods are used
  PatchStart(const polygon::BoundarySites& boundary, const polygon::BoundaryCurve& curve,
             const geometry::Lattice& lattice)
      : boundary_(boundary), curve_(curve), lattice_(lattice), patch_(lattice, boundary.periods) {}

  /// @brief Triangulates the sites. @return false if nothing can be changed, because there are too many sites or all
  /// are near the rim
  /// @param sites see PatchOptimizer::improve
  bool build(geometry::Vec2 center, double size, std::span<const PatchSite> sites);

  const Patch& patch() const { return patch_; }
  LocalIndex vertices() const { return patch_.mesh.vertices(); }
  LocalIndex missing_chords() const { return missing_chords_; }
  const geometry::Periods& periods() const { return boundary_.periods; }
  const polygon::BoundaryCurve& curve() const { return curve_; }
  /// Returns the number of sites of a loop at the beginning of the clean-up.
  LocalIndex sites_of_loop(LocalIndex loop) const {
    return boundary_.loop_start[at(loop) + 1] - boundary_.loop_start[at(loop)];
  }
  const geometry::Lattice& lattice() const { return lattice_; }
  geometry::Vec2 center() const { return center_; }
  double size() const { return size_; }

  /// Returns whether a vertex is new or has moved.
  bool has_changed(const Patch& now, LocalIndex v) const {
    return v >= vertices() || now.mesh.position(v) != patch_.mesh.position(v);
  }
  /// Returns whether a place is far enough from the sites that are held.
  bool is_in_core(geometry::Vec2 p) const {
    return distance(p) < (CleanupRules::reach - CleanupRules::free_depth - CleanupRules::core_depth) * size_;
  }
  /// Returns whether a new site with size h would be far enough from the rim.
  bool has_room(geometry::Vec2 p, double h) const {
    return distance(p) + CleanupRules::free_depth * std::fmax(h, size_) < CleanupRules::reach * size_;
  }
  /// Returns whether a place is far enough from the rim for a site to move there.
  bool is_off_rim(geometry::Vec2 p) const {
    return !(distance(p) > (CleanupRules::reach - CleanupRules::free_depth + CleanupRules::most_outwards) * size_);
  }
  double distance(geometry::Vec2 p) const { return geometry::length(p - center_); }

private:
  bool is_deep(const PatchSite& site) const;
  VertexRole role_of(const PatchSite& site) const;
  static BoundaryVertex on_boundary(const PatchSite& site);
  void link_boundary();

  const polygon::BoundarySites& boundary_;
  const polygon::BoundaryCurve& curve_;
  geometry::Lattice lattice_;
  Patch patch_;
  std::vector<BoundaryName> next_; // next site of each vertex on the boundary
  geometry::Vec2 center_;
  double size_ = 1;
  LocalIndex missing_chords_ = 0;
};

/// @brief The sites that rest. A triangle whose three sites rest is not tried. A site that moves or is new does not
/// rest.
class PatchRests {
public:
  /// @param sites sites of the patch, in the order of its vertices
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
  /// Ends the rest of sites that have moved far, and of new sites.
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
