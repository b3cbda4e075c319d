// SPDX-License-Identifier: BSD-3-Clause
// A search structure over the segments of closed polygons. The structure finds
// the nearest segment and decides whether a point lies inside, both exactly.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::geometry {

/// @brief A tree of square cells over M segments. A cell that meets more than a few segments is split into 4 x 4 cells;
/// the others are the bins. If a smooth curve consists of many short segments, each bin has 1 to 4 of them. Takes O(M
/// log M) time to build and O(M) memory; afterwards it is immutable and thread-safe.
///
/// For the query `inside`, the segments together must form closed polygons (each end is shared by an even number of
/// segments); the distance queries do not need that. The coordinates of segments and of points passed to `inside` must
/// lie on one coordinate lattice, so that orient2d is exact. Corners of cells have few bits and are exact with any such
/// lattice.
class SegmentGrid {
public:
  SegmentGrid() = default;
  explicit SegmentGrid(std::vector<Segment> segments);

  /// The nearest segment and its squared distance.
  struct Nearest {
    LocalIndex segment;
    double squared_distance;
  };
  /// Returns the nearest segment within the distance `reach` of p (on ties the one with the lowest index), or nothing.
  /// The search visits only bins within this distance.
  std::optional<Nearest> nearest(Vec2 p, double reach) const;
  /// Returns the nearest segment at any distance. @pre at least one segment
  Nearest nearest(Vec2 p) const;
  /// Returns whether p lies inside, by the even-odd rule. The answer is exact; by symbolic perturbation, a point on the
  /// boundary counts as the point moved by (epsilon^2, epsilon). Cost: O(depth + segments in one bin).
  bool inside(Vec2 p) const;
  /// Returns how many segments inside(p) examines: few, unless long slanted segments lie side by side. Cost: O(depth).
  LocalIndex looked_at_for(Vec2 p) const;
  /// Calls visit(index) for every segment that may meet `box`, in ascending order in each bin; a segment that lies in
  /// several bins may be visited several times. Stops when visit returns false.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const;
  /// Does the same only for bins that may lie within `margin` of `segment`. A long slanted segment meets few of the
  /// bins in its bounding box.
  template <class Visit>
  void for_each_near(const Box& box, const Segment& segment, double margin, const Visit& visit) const;
  /// Does the same bin by bin: calls visit(indices of the bin's segments, ascending).
  template <class Visit>
  void for_each_bin_near(const Box& box, const Segment& segment, double margin, const Visit& visit) const;

  /// Returns the number of cells. Bin k lists the segments that meet cell k, in ascending order; it is empty if the
  /// cell is split. Two segments that meet have a bin in common.
  std::size_t bins() const { return cells_.size(); }
  std::span<const LocalIndex> bin(std::size_t k) const {
    return cells_[k].split ? std::span<const LocalIndex>{} : listed_in(cells_[k]);
  }

  std::span<const Segment> segments() const { return segments_; }
  std::size_t memory_bytes() const;

private:
  /// A cell of the tree. A leaf lists the segments that meet the closed cell; a split cell has 16 children, row by row
  /// from below.
  struct Cell {
    LocalIndex first = 0; ///< for a leaf its first index in cell_segment_, for a split cell its first child in cells_
    std::uint32_t listed : 30 = 0; ///< number of segments in a leaf
    std::uint32_t split : 1 = 0;
    std::uint32_t corner_inside : 1 = 0; ///< whether the lower-left corner, perturbed, lies inside the polygons

    LocalIndex count() const { return static_cast<LocalIndex>(listed); }
    LocalIndex last() const { return first + count(); }
  };
  /// A cell with its lower-left corner and its side.
  struct Placed {
    LocalIndex cell;
    Vec2 corner;
    double side;

    Placed child(LocalIndex first, int i, int j) const {
      return {first + 4 * j + i, {corner.x + 0.25 * side * i, corner.y + 0.25 * side * j}, 0.25 * side};
    }
    /// Returns the squared distance from p to the closed cell.
    double squared_distance(Vec2 p) const;
    /// Returns whether a point of the closed cell may lie within `margin` of the line through the segment. The answer
    /// is never false if such a point exists.
    bool may_be_near(const Segment& segment, double margin) const;
  };
  class Builder;

  std::span<const LocalIndex> listed_in(const Cell& cell) const {
    return {cell_segment_.data() + cell.first, cell.listed};
  }
  Placed bin_of(Vec2 p) const;
  void look_in_leaf(const Cell& cell, Vec2 p, Nearest& best) const;
  void nearest_in(Placed place, Vec2 p, Nearest& best) const;
  template <class Visit>
  static auto one_by_one(const Visit& visit);
  template <class Wanted, class Visit>
  bool visit_near(const Placed& place, const Box& box, const Wanted& wanted, const Visit& visit) const;
  template <class Wanted, class Visit>
  void visit_wanted(const Box& box, const Wanted& wanted, const Visit& visit) const;

  std::vector<Segment> segments_;
  Box box_;
  Placed root_{0, {}, 0};
  std::vector<Cell> cells_;              // the root first
  std::vector<LocalIndex> cell_segment_; // segment indices, ascending in each leaf
};

/// Calls visit(segments of the cell) for all leaf cells that meet the box and for which `wanted` is true.
template <class Wanted, class Visit>
bool SegmentGrid::visit_near(const Placed& place, const Box& box, const Wanted& wanted, const Visit& visit) const {
  const Cell& cell = cells_[place.cell];
  if (!cell.split)
    return visit(listed_in(cell));
  // Children outside of this range do not meet the box. The range is slightly too large, to allow for rounding.
  const double inverse = 4 / place.side;
  const auto first = [&](double v) { return static_cast<int>(std::clamp(v * inverse - 0x1p-20, 0.0, 3.0)); };
  const auto last = [&](double v) { return static_cast<int>(std::clamp(v * inverse + 0x1p-20, 0.0, 3.0)); };
  const int i0 = first(box.min.x - place.corner.x), i1 = last(box.max.x - place.corner.x);
  const int j0 = first(box.min.y - place.corner.y), j1 = last(box.max.y - place.corner.y);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const Placed child = place.child(cell.first, i, j);
      if (box.max.x < child.corner.x || box.min.x > child.corner.x + child.side || box.max.y < child.corner.y ||
          box.min.y > child.corner.y + child.side || !wanted(child))
        continue;
      if (!visit_near(child, box, wanted, visit))
        return false;
    }
  return true;
}

template <class Wanted, class Visit>
void SegmentGrid::visit_wanted(const Box& box, const Wanted& wanted, const Visit& visit) const {
  if (segments_.empty() || box.max.x < box_.min.x || box.min.x > box_.max.x || box.max.y < box_.min.y ||
      box.min.y > box_.max.y)
    return;
  visit_near(root_, box, wanted, visit);
}

/// Visits the segments of a bin one by one.
template <class Visit>
auto SegmentGrid::one_by_one(const Visit& visit) {
  return [&visit](std::span<const LocalIndex> bin) {
    return std::all_of(bin.begin(), bin.end(), [&](LocalIndex k) { return visit(k); });
  };
}

template <class Visit>
void SegmentGrid::for_each_near(const Box& box, const Visit& visit) const {
  visit_wanted(
      box, [](const Placed&) { return true; }, one_by_one(visit));
}

template <class Visit>
void SegmentGrid::for_each_near(const Box& box, const Segment& segment, double margin, const Visit& visit) const {
  for_each_bin_near(box, segment, margin, one_by_one(visit));
}

template <class Visit>
void SegmentGrid::for_each_bin_near(const Box& box, const Segment& segment, double margin, const Visit& visit) const {
  visit_wanted(
      box, [&](const Placed& cell) { return cell.may_be_near(segment, margin); }, visit);
}

} // namespace trime::geometry
