// SPDX-License-Identifier: BSD-3-Clause
// The chords of the curves and interfaces inside a shape: edges that the mesh must have, with the shape on both sides.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/region_loss.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::polygon {

/// A straight edge between two neighbouring sites on a curve or an interface inside the shape, in the direction of it.
struct InnerChord {
  geometry::Segment ends;
  std::int32_t curve = 0; ///< number of the curve, an index into geometry::InnerCurves::names; -1: an interface only
  std::int32_t left = 0, right = 0; ///< regions on both sides, as indices into geometry::Regions::names
};

/// A circle on which sites of an interface or a curve may move.
struct SlideCircle {
  geometry::Vec2 center;
  double radius = 0;
  std::int32_t left = 0;  ///< region on the left of the arc
  std::int32_t loss = -1; ///< entry of InnerChords::losses for the arc; -1: the arc divides no two regions
};

/// A new position of a site on a curve.
struct InnerMove {
  LocalIndex site; ///< index into InnerChords::sites
  geometry::Vec2 position;
};

/// @brief The chords of all curves inside a shape, and the sites on the curves. Only the clean-up moves the sites.
/// An end of a chord is one of `sites`, or a corner on the boundary. Invariant: the open diametral circle of a chord
/// contains no boundary site and no other end of a chord.
struct InnerChords {
  /// Values of `track`; other values are indices into `circles`.
  static constexpr std::int32_t held = -1, straight = -2, bent = -3;

  std::vector<InnerChord> chords;    ///< arc by arc, in the direction of each arc
  std::vector<geometry::Vec2> sites; ///< sites inside the shape, each once, in lexicographic order
  std::vector<std::uint8_t> corner;  ///< by site: whether it is a node or a corner, which must be a vertex of the mesh
  std::vector<std::int32_t> track;  ///< by site: how the clean-up may move it: not at all (held), along its two chords,
                                    ///< which lie on one straight piece (straight), parallel to the line between its
                                    ///< neighbours on a simplified interface (bent), or along one of `circles`
  std::vector<SlideCircle> circles; ///< circles to which `track` refers, arc by arc
  std::int64_t joined_nodes = 0;    ///< see geometry::InnerCurves
  std::vector<geometry::RegionLoss> losses{}; ///< what regions lose to each other by interfaces that are not the given
                                              ///< ones, place by place
  std::vector<LocalIndex> by_end; ///< each chord k as 2 k (first end) and 2 k + 1 (second end), by place of that end

  bool empty() const { return chords.empty(); }
  geometry::Vec2 end(LocalIndex half) const {
    const geometry::Segment& ends = chords[static_cast<std::size_t>(half / 2)].ends;
    return half % 2 == 0 ? ends.a : ends.b;
  }
  geometry::Vec2 other_end(LocalIndex half) const { return end(half ^ 1); }
  /// Sets by_end.
  void sort_ends();
  /// Returns the entries of by_end at p. Cost: O(log chords).
  std::span<const LocalIndex> at(geometry::Vec2 p) const {
    const auto low = std::lower_bound(by_end.begin(), by_end.end(), p, [this](LocalIndex half, geometry::Vec2 q) {
      return geometry::lexicographically_less(end(half), q);
    });
    auto high = low;
    while (high != by_end.end() && end(*high) == p)
      ++high;
    return {low, high};
  }
  /// Returns the index of the site at p, or -1 if no site is there. Cost: O(log sites).
  LocalIndex index_of(geometry::Vec2 p) const {
    const auto found = std::lower_bound(sites.begin(), sites.end(), p, geometry::lexicographically_less);
    return found != sites.end() && *found == p ? static_cast<LocalIndex>(found - sites.begin()) : -1;
  }
  /// Returns whether there is a site at p that is a corner or a node.
  bool is_corner(geometry::Vec2 p) const {
    const LocalIndex site = index_of(p);
    return site >= 0 && corner[static_cast<std::size_t>(site)] != 0;
  }
  /// @brief Moves sites with the ends of their chords, and brings the losses of arcs on circles up to date. The indices
  /// of sites change. Cost: O(chords log chords). @pre each site occurs once, and its track is not `held`
  void move_sites(std::span<const InnerMove> moves);

private:
  void sort_sites();
};

} // namespace trime::polygon
