// SPDX-License-Identifier: BSD-3-Clause
// Segments of closed polygons in bins: nearest segment and inside test, both exact in their decisions.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::geometry {

struct Segment {
  Vec2 a, b;
};

/// Squared distance from p to the segment.
double squared_distance(Vec2 p, const Segment& segment);

/// @brief Bins over the bounding box of M segments; O(M log M) to build, O(M) memory, immutable and thread-safe after.
///
/// The segments together must form closed polygons (every end is shared by an even number of segments) for `inside`;
/// the distance queries need nothing. All coordinates, of segments and of queries to `inside`, must be points of one
/// lattice, so that orient2d is exact.
class SegmentGrid {
public:
  SegmentGrid() = default;
  explicit SegmentGrid(std::vector<Segment> segments);

  struct Nearest {
    LocalIndex segment;
    double squared_distance;
  };
  /// Nearest segment (lowest index on ties) within `reach` of p; nothing if there is none. Visits only the bins
  /// within reach, or fewer.
  std::optional<Nearest> nearest(Vec2 p, double reach) const;
  /// Nearest segment at any distance. @pre at least one segment
  Nearest nearest(Vec2 p) const;
  /// Even-odd rule with symbolic perturbation: exact; a point on the boundary gets the side of the point moved by
  /// (epsilon^2, epsilon). O(segments in one bin).
  bool inside(Vec2 p) const;
  /// Calls visit(index) for every segment that may meet `box`, each once in ascending order per bin, possibly more
  /// than once over bins; stops when visit returns false.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const;

  std::span<const Segment> segments() const { return segments_; }
  std::size_t memory_bytes() const;

private:
  int column(double x) const;
  int row(double y) const;

  std::vector<Segment> segments_;
  Box box_;
  int columns_ = 0, rows_ = 0;
  double inverse_width_ = 0, inverse_height_ = 0, cell_width_ = 0, cell_height_ = 0;
  std::vector<LocalIndex> cell_start_;   // columns*rows + 1
  std::vector<LocalIndex> cell_segment_; // segment indices, ascending in each cell
  std::vector<std::uint8_t> corner_inside_; // lower-left corner of each cell
};

template <class Visit>
void SegmentGrid::for_each_near(const Box& box, const Visit& visit) const {
  if (segments_.empty() || box.max.x < box_.min.x || box.min.x > box_.max.x || box.max.y < box_.min.y ||
      box.min.y > box_.max.y)
    return;
  const int i0 = column(box.min.x), i1 = column(box.max.x), j0 = row(box.min.y), j1 = row(box.max.y);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const std::size_t cell = static_cast<std::size_t>(j) * columns_ + i;
      for (LocalIndex k = cell_start_[cell]; k < cell_start_[cell + 1]; ++k)
        if (!visit(cell_segment_[k]))
          return;
    }
}

} // namespace trime::geometry
