// SPDX-License-Identifier: BSD-3-Clause
// Finds which points of a sequence lie inside a part, quickly also between very many long slanted spikes.
#pragma once

#include "geometry/segment_tree.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <optional>

namespace trime::shape {

/// @brief Gives the answers of Part::inside, bit for bit, for points that are mostly near the one before.
///
/// Where a bin has very many segments, only those between a point and the one before are looked at, if they are fewer:
/// the side changes with each of them. Never more than twice the work of Part::inside. Keeps a reference.
class InsideWalk {
public:
  explicit InsideWalk(const Part& part) : part_(&part) {}

  /// Returns Part::inside. @param p a point of the lattice, as are the vertices of the part
  bool inside(geometry::Vec2 p);
  /// Segments of crowded bins that were looked at.
  std::int64_t looked_at() const { return looked_at_; }

private:
  std::optional<bool> walked_to(geometry::Vec2 p, LocalIndex most);

  const Part* part_;
  std::int64_t looked_at_ = 0;
  geometry::Vec2 last_; ///< in a crowded bin
  std::optional<bool> last_inside_;
  std::optional<geometry::SegmentTree> tree_; ///< once so much was looked at that it pays
};

} // namespace trime::shape
