// SPDX-License-Identifier: BSD-3-Clause
// Finds the segments that may have a new site in their diametral discs, with one grid for each power of two of their
// lengths. It finds only candidates; SiteTree answers exactly.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace trime::boundary {

/// Adding a segment takes O(1), and finding the segments near a site O(levels + found). 50 to 100 bytes per segment.
class SegmentWatch {
public:
  explicit SegmentWatch(const geometry::Periods& periods) : periods_(periods) {}

  /// Adds the segment `index` from the canonical place `a` to a + along. A segment that was divided may be added again;
  /// its old entry only makes it a candidate more often.
  void add(geometry::Vec2 a, geometry::Vec2 along, LocalIndex index);

  /// Appends all segments in whose closed diametral disc, or in an image of it, `site` lies, and others near it.
  void find(geometry::Vec2 site, std::vector<LocalIndex>& found) const;

private:
  /// A segment in the cells of a level. Cells are 2^(level + 1) wide, for lengths of at least 2^level.
  struct WatchedSegment {
    geometry::Vec2 middle;
    LocalIndex index;
  };
  using Cells = std::unordered_map<std::uint64_t, std::vector<WatchedSegment>>;

  const geometry::Periods periods_;
  std::map<int, Cells> levels_;
};

} // namespace trime::boundary
