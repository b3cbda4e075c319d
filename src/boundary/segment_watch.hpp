// SPDX-License-Identifier: BSD-3-Clause
// Finds the segments that may have a new site in their diametral circles, with one grid for each power of two of their
// lengths. The segments found are only candidates; SiteTree gives the exact answer.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace trime::boundary {

/// An index of segments. Adding a segment takes O(1) time, and finding the segments near a site O(levels + found).
/// Memory: 50 to 100 bytes per segment.
class SegmentWatch {
public:
  explicit SegmentWatch(const geometry::Periods& periods) : periods_(periods) {}

  /// Adds the segment with number `index`, which goes from `a` (a place in the container) to a + along. A segment that
  /// was divided may be added again; its old entry only makes it a candidate more often.
  void add(geometry::Vec2 a, geometry::Vec2 along, LocalIndex index);

  /// Appends all segments whose closed diametral circle, or a periodic image of it, contains `site`, and other segments
  /// near it.
  void find(geometry::Vec2 site, std::vector<LocalIndex>& found) const;

private:
  /// A segment in the grid cells of a level. The cells are 2^(level + 1) wide; the segments are at least 2^level long.
  struct WatchedSegment {
    geometry::Vec2 middle;
    LocalIndex index;
  };
  using Cells = std::unordered_map<std::uint64_t, std::vector<WatchedSegment>>;

  const geometry::Periods periods_;
  std::map<int, Cells> levels_;
};

} // namespace trime::boundary
