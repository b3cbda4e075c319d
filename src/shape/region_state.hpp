// SPDX-License-Identifier: BSD-3-Clause
// Finds whether a point is in the region, if it lies in few of very many parts, and which points of a sequence lie
// inside a part, quickly also between very many long slanted spikes.
#pragma once

#include "geometry/segment_tree.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <cstdint>
#include <optional>
#include <vector>

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

/// @brief The value of a region while parts come and go. It begins with no part.
///
/// Each operation knows how many of its operands decide it, so that a change costs O(occurrences of the part x depth),
/// however many parts there are.
class RegionState {
public:
  /// O(parts). @param parts number of parts, the domain included @pre `region` outlives it
  RegionState(const Region& region, std::size_t parts);
  /// One more place of the part (it may have several, in a periodic container) holds the point, or one less.
  void enter(int part) {
    if (places_[static_cast<std::size_t>(part)]++ == 0)
      change(part, true);
  }
  void leave(int part) {
    if (--places_[static_cast<std::size_t>(part)] == 0)
      change(part, false);
  }
  /// Region::contains for a point in those parts that were entered and not left.
  bool contains() const { return values_[0] != 0; }
  /// Operations and parts whose value was looked at so far.
  std::int64_t looked_at() const { return looked_at_; }

private:
  void change(int part, bool inside);
  bool is_deciding(int node) const;

  const Region& region_;
  std::vector<int> parent_;              // of each node; the root has none: -1
  std::vector<char> negates_;            // is the operand subtracted?
  std::vector<int> deciding_;            // operands with the value that decides their operation
  std::vector<char> values_;             // of each node
  std::vector<std::vector<int>> leaves_; // of each part
  std::vector<int> places_;              // of each part that hold the point
  std::int64_t looked_at_ = 0;
};

} // namespace trime::shape
