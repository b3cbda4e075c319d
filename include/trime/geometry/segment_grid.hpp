// SPDX-License-Identifier: BSD-3-Clause
// A search structure over the segments of closed polygons: nearest segment and inside test, both with exact decisions.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::geometry {

/// @brief Bins over M segments: a tree of square cells. A cell is split into 4 x 4 while it meets more than a few
/// segments. A smooth curve of many short segments has 1 to 4 of them in a bin. O(M log M) to build, O(M) memory,
/// immutable and thread-safe after.
///
/// The segments together must form closed polygons (every end is shared by an even number of segments) for `inside`;
/// the distance queries do not need that. All coordinates, of segments and of queries to `inside`, must be points of
/// one lattice, so that orient2d is exact. Cell corners have few bits and are exact with any such lattice.
class SegmentGrid {
public:
  SegmentGrid() = default;
  explicit SegmentGrid(std::vector<Segment> segments);

  /// The nearest segment and its squared distance.
  struct Nearest {
    LocalIndex segment;
    double squared_distance;
  };
  /// Returns the nearest segment within `reach` of p (the lowest index on ties), or nothing. Visits only the bins
  /// within reach, or fewer.
  std::optional<Nearest> nearest(Vec2 p, double reach) const;
  /// Returns the nearest segment at any distance. @pre at least one segment
  Nearest nearest(Vec2 p) const;
  /// Returns whether p lies inside, by the even-odd rule. Exact, with symbolic perturbation: a point on the boundary
  /// counts as the point moved by (epsilon^2, epsilon). O(depth + segments in one bin).
  bool inside(Vec2 p) const;
  /// Returns how many segments inside(p) examines: few, except if long slanted segments lie side by side. O(depth).
  LocalIndex looked_at_for(Vec2 p) const;
  /// Calls visit(index) for every segment that may meet `box`, in ascending order in each bin; a segment in several
  /// bins may be visited several times. Stops when visit returns false.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const;
  /// Does the same only for bins that may lie within `margin` of `segment`: a long slanted one meets few of the bins of
  /// its box.
  template <class Visit>
  void for_each_near(const Box& box, const Segment& segment, double margin, const Visit& visit) const;
  /// Does the same bin by bin: calls visit(span of indices, ascending).
  template <class Visit>
  void for_each_bin_near(const Box& box, const Segment& segment, double margin, const Visit& visit) const;

  /// Returns the number of cells. Bin k lists the segments that meet cell k, ascending; it is empty if the cell is
  /// split. Two segments that meet share a bin.
  std::size_t bins() const { return cells_.size(); }
  std::span<const LocalIndex> bin(std::size_t k) const {
    return cells_[k].split ? std::span<const LocalIndex>{} : listed_in(cells_[k]);
  }

  std::span<const Segment> segments() const { return segments_; }
  std::size_t memory_bytes() const;

private:
  /// A leaf lists the segments that meet the closed cell; a split cell has 16 children, row by row from below.
  struct Cell {
    LocalIndex first = 0;          ///< into cell_segment_, or the first child in cells_
    std::uint32_t listed : 30 = 0; ///< segments
    std::uint32_t split : 1 = 0;
    std::uint32_t corner_inside : 1 = 0; ///< parity at the lower-left corner, perturbed

    LocalIndex count() const { return static_cast<LocalIndex>(listed); }
    LocalIndex last() const { return first + count(); }
  };
  /// A cell with its place: lower-left corner and side.
  struct Placed {
    LocalIndex cell;
    Vec2 corner;
    double side;

    Placed child(LocalIndex first, int i, int j) const {
      return {first + 4 * j + i, {corner.x + 0.25 * side * i, corner.y + 0.25 * side * j}, 0.25 * side};
    }
    /// Squared distance from p to the closed cell.
    double squared_distance(Vec2 p) const;
    /// Returns whether a point of the closed cell may lie within `margin` of the line through the segment. Never false
    /// if one does.
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

/// Calls visit(segments of the cell) for cells that meet the box and are wanted.
template <class Wanted, class Visit>
bool SegmentGrid::visit_near(const Placed& place, const Box& box, const Wanted& wanted, const Visit& visit) const {
  const Cell& cell = cells_[place.cell];
  if (!cell.split)
    return visit(listed_in(cell));
  // No child beyond these, which are a little too many for rounding, meets the box.
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
