// SPDX-License-Identifier: BSD-3-Clause
// Decides quickly whether a point lies in a region, if it lies in few of very many parts.
#pragma once

#include "geometry/segment_tree.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <cstdint>
#include <optional>
#include <vector>

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

/// @brief Whether a point lies in a region, while the parts that contain the point change. At first no part contains
/// it.
///
/// Each operation counts the operands that decide it, so a change costs O(occurrences of the part x depth), however
/// many parts there are.
class RegionState {
public:
  /// O(parts). @param parts number of parts, the domain included @pre `region` outlives it
  RegionState(const Region& region, std::size_t parts);
  /// Notes that one more image of the part contains the point, or one fewer; in a periodic container there may be
  /// several.
  void enter(int part) {
    if (places_[static_cast<std::size_t>(part)]++ == 0)
      change(part, true);
  }
  void leave(int part) {
    if (--places_[static_cast<std::size_t>(part)] == 0)
      change(part, false);
  }
  /// Returns Region::contains for a point in the parts that were entered and not left.
  bool contains() const { return values_[0] != 0; }
  /// Number of operations and parts whose value was examined so far.
  std::int64_t looked_at() const { return looked_at_; }

private:
  void change(int part, bool inside);
  bool is_deciding(int node) const;

  const Region& region_;
  std::vector<int> parent_;              // parent of each node; -1 for the root
  std::vector<char> negates_;            // whether the operand is subtracted
  std::vector<int> deciding_;            // number of operands with the value that decides the operation
  std::vector<char> values_;             // value of each node
  std::vector<std::vector<int>> leaves_; // leaves of each part
  std::vector<int> places_;              // number of images of each part that contain the point
  std::int64_t looked_at_ = 0;
};

} // namespace trime::shape
