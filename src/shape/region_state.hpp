// SPDX-License-Identifier: BSD-3-Clause
// Decides whether a point lies in a shape. The decision is fast if the shape has
// very many parts and the point lies in few of them.
#pragma once

#include "geometry/segment_tree.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace trime::shape {

/// @brief Gives the same results as Part::inside. This class is faster if most points are near the point of the call
/// before.
///
/// If a bin has very many segments, only those between a point and the point before are examined, because each crossed
/// segment leads from inside to outside or back. The work is never more than twice that of Part::inside. Keeps a
/// reference to the part.
class InsideWalk {
public:
  explicit InsideWalk(const Part& part) : part_(&part) {}

  /// Returns Part::inside(p).
  /// @param p a point of the coordinate lattice on which the vertices of the part lie
  bool inside(geometry::Vec2 p);
  /// Returns how many segments of crowded bins were examined.
  std::int64_t looked_at() const { return looked_at_; }

private:
  std::optional<bool> walked_to(geometry::Vec2 p, LocalIndex most);

  const Part* part_;
  std::int64_t looked_at_ = 0;
  geometry::Vec2 last_; ///< the last point in a crowded bin
  std::optional<bool> last_inside_;
  std::optional<geometry::SegmentTree> tree_; ///< made only after many segments were examined, when it saves time
};

/// @brief Knows whether a point lies in a shape, while the set of parts that contain the point changes. At first no
/// part contains the point.
///
/// Each operation counts the operands that decide its value, so a change of a part costs O(occurrences of the part x
/// depth), for any number of parts.
class RegionState {
public:
  /// Takes O(parts) time.
  /// @param parts number of parts, including the domain
  /// @pre `region` outlives this object
  RegionState(const Region& region, std::size_t parts);
  /// Notes that one more periodic image of the part contains the point (enter), or one fewer (leave).
  void enter(int part) {
    if (places_[static_cast<std::size_t>(part)]++ == 0)
      change(part, true);
  }
  void leave(int part) {
    if (--places_[static_cast<std::size_t>(part)] == 0)
      change(part, false);
  }
  /// Returns whether the shape contains a point that lies in exactly those parts that were entered and not left.
  bool contains() const { return values_[0] != 0; }
  /// Returns how many values of operations and parts were examined so far.
  std::int64_t looked_at() const { return looked_at_; }

private:
  void change(int part, bool inside);
  bool is_deciding(int node) const;

  const Region& region_;
  std::vector<int> parent_;              // parent of each node in the expression; -1 for the root
  std::vector<char> negates_;            // whether the operand is subtracted from the first one
  std::vector<int> deciding_;            // number of operands with the value that decides the operation
  std::vector<char> values_;             // whether the point lies inside each node
  std::vector<std::vector<int>> leaves_; // the leaves of the expression in which each part occurs
  std::vector<int> places_;              // number of periodic images of each part that contain the point
  std::int64_t looked_at_ = 0;
};

} // namespace trime::shape
