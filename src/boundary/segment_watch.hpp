// SPDX-License-Identifier: BSD-3-Clause
// Which segments may have a new site in their diametral discs? Grids of cells as large as the segments, one for each
// power of two of their lengths. Finds candidates only: the exact question is SiteTree's.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace trime::boundary {

/// O(1) to add a segment; to find those near a site, O(levels + found). 50 to 100 bytes a segment.
class SegmentWatch {
public:
  explicit SegmentWatch(const geometry::Periods& periods) : periods_(periods) {}

  /// The segment `index` from the canonical place `a` to a + along. One that was divided may be added again: what is
  /// known of its former self only makes it a candidate more often.
  void add(geometry::Vec2 a, geometry::Vec2 along, LocalIndex index);

  /// Appends all segments in whose closed diametral disc, or in an image of it, `site` lies, and others near it.
  void find(geometry::Vec2 site, std::vector<LocalIndex>& found) const;

private:
  /// Cells of one size, 2^(level + 1), for lengths of 2^level and more.
  struct WatchedSegment {
    geometry::Vec2 middle;
    LocalIndex index;
  };
  using Cells = std::unordered_map<std::uint64_t, std::vector<WatchedSegment>>;

  const geometry::Periods periods_;
  std::map<int, Cells> levels_;
};

} // namespace trime::boundary
