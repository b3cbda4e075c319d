// SPDX-License-Identifier: BSD-3-Clause
// Finds which points of a sequence lie inside a part. It is fast even between many long slanted spikes.
#pragma once

#include "geometry/segment_tree.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <optional>

namespace trime::shape {

/// @brief Gives exactly the results of Part::inside, for points that mostly are near the point before.
///
/// If a bin has very many segments, it examines only those between a point and the point before, because each of them
/// changes the side. It never does more than twice the work of Part::inside. Keeps a reference.
class InsideWalk {
public:
  explicit InsideWalk(const Part& part) : part_(&part) {}

  /// Returns Part::inside. @param p lies on the lattice, as the vertices of the part do
  bool inside(geometry::Vec2 p);
  /// Number of segments of crowded bins that were examined.
  std::int64_t looked_at() const { return looked_at_; }

private:
  std::optional<bool> walked_to(geometry::Vec2 p, LocalIndex most);

  const Part* part_;
  std::int64_t looked_at_ = 0;
  geometry::Vec2 last_; ///< the last point in a crowded bin
  std::optional<bool> last_inside_;
  std::optional<geometry::SegmentTree> tree_; ///< made once it saves time, after many segments were examined
};

} // namespace trime::shape
