// SPDX-License-Identifier: BSD-3-Clause
// Building the tree of cells, and the queries. The parity at every cell corner is found by walking from corner to
// corner along cell edges, from a corner outside of everything; a query walks from its cell's corner to the point.
#include "trime/geometry/segment_grid.hpp"

#include "geometry/predicates.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>

namespace trime::geometry {

namespace {

constexpr int max_depth = 20;                         // the side of the smallest cell is 2^-40 of the root's
constexpr int enough_for_a_leaf = 4;                  // a cell with more segments is split
constexpr double max_spread = 32;                     // largest number of cells that list a segment, on average,
constexpr double free_entries = 1e5;                  // or this many entries are made, if that is more
constexpr std::uint32_t most_listed = (1u << 30) - 1; // more segments than there may be

/// Does the segment cross the leg from (x0, y) to (x1, y), both moved by (epsilon^2, epsilon)?
bool crosses_horizontal(const Segment& s, double y, double x0, double x1) {
  return (s.a.y > y) != (s.b.y > y) && perturbed_side(s, {x0, y}) != perturbed_side(s, {x1, y});
}

bool crosses_vertical(const Segment& s, double x, double y0, double y1) {
  return (s.a.x > x) != (s.b.x > x) && perturbed_side(s, {x, y0}) != perturbed_side(s, {x, y1});
}

/// May the segment, made thicker by `margin` on each side, meet the closed cell? Its bounding box does; never false if
/// it does.
bool may_meet(const Segment& s, Vec2 corner, double side, double margin) {
  const double half = 0.5 * side;
  const Vec2 d = s.b - s.a, c{corner.x + half - s.a.x, corner.y + half - s.a.y};
  const double left = d.x * c.y, right = d.y * c.x;
  const double reach = (half + margin) * (std::fabs(d.x) + std::fabs(d.y));
  return std::fabs(left - right) <= reach + 1e-14 * (reach + std::fabs(left) + std::fabs(right));
}

/// Smallest power of two that is at least v > 0.
double power_of_two_above(double v) {
  int exponent = 0;
  const double fraction = std::frexp(v, &exponent);
  return std::ldexp(1.0, fraction == 0.5 ? exponent - 1 : exponent);
}

} // namespace

double SegmentGrid::Placed::squared_distance(Vec2 p) const {
  const double dx = std::max(0.0, std::max(corner.x - p.x, p.x - (corner.x + side)));
  const double dy = std::max(0.0, std::max(corner.y - p.y, p.y - (corner.y + side)));
  return dx * dx + dy * dy;
}

bool SegmentGrid::Placed::may_be_near(const Segment& segment, double margin) const {
  return may_meet(segment, corner, side, margin);
}

/// Splits cells depth first; keeps one set of 16 lists per depth.
class SegmentGrid::Builder {
public:
  explicit Builder(SegmentGrid& grid) : grid_(grid), lists_(max_depth) {
    const double width = grid.box_.width(), height = grid.box_.height();
    const Box& box = grid.box_;
    const double extent = std::fmax(std::fmax(std::fabs(box.min.x), std::fabs(box.max.x)),
                                    std::fmax(std::fabs(box.min.y), std::fabs(box.max.y)));
    const double quantum = power_of_two_above(std::fmax(std::fmax(width, height), std::fmax(extent * 0x1p-52, 1e-300)));
    // At least a little below the box, so that the lower-left corners of the first column and row are outside.
    grid.root_ = {0, {below(box.min.x, quantum), below(box.min.y, quantum)}, 4 * quantum};
    smallest_ = std::fmax(extent * 0x1p-52, 4 * quantum * 0x1p-40);
    std::vector<LocalIndex> all(grid.segments_.size());
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k] = static_cast<LocalIndex>(k);
    grid.cells_.resize(1);
    build(grid.root_, all, 0, std::fmax(max_spread, free_entries / static_cast<double>(all.size())));
  }

private:
  using List = std::vector<LocalIndex>;

  static double below(double v, double quantum) {
    const double multiple = std::floor(v / quantum) * quantum;
    return multiple < v ? multiple : multiple - quantum;
  }

  /// Fills cell `place`; `spread` is by how much its entries may still multiply.
  void build(const Placed& place, const List& list, int depth, double spread) {
    if (list.size() > enough_for_a_leaf && depth < max_depth && 0.25 * place.side >= smallest_) {
      auto& children = lists_[depth];
      const double ratio = static_cast<double>(distribute(place, list, children)) / static_cast<double>(list.size());
      if (ratio <= spread) {
        split(place, children, depth, std::fmin(spread, spread / ratio));
        return;
      }
    }
    Cell& cell = grid_.cells_[place.cell];
    cell.first = static_cast<LocalIndex>(grid_.cell_segment_.size());
    cell.listed = static_cast<std::uint32_t>(list.size()) & most_listed;
    grid_.cell_segment_.insert(grid_.cell_segment_.end(), list.begin(), list.end());
  }

  void split(const Placed& place, const std::array<List, 16>& children, int depth, double spread) {
    const LocalIndex first = static_cast<LocalIndex>(grid_.cells_.size());
    grid_.cells_[place.cell].first = first;
    grid_.cells_[place.cell].split = 1;
    grid_.cells_.resize(grid_.cells_.size() + 16);
    set_corners(place, first, children);
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        build(place.child(first, i, j), children[4 * j + i], depth + 1, spread);
  }

  /// Lists for each child the segments that meet it; returns the number of entries.
  std::size_t distribute(const Placed& place, const List& list, std::array<List, 16>& children) const {
    for (List& child : children)
      child.clear();
    const double inverse = 4 / place.side;
    const auto first = [](double v) { return (v > 1) + (v > 2) + (v > 3); }; // of the closed children
    const auto last = [](double v) { return (v >= 1) + (v >= 2) + (v >= 3); };
    std::size_t entries = 0;
    for (const LocalIndex k : list) {
      const Segment& s = grid_.segments_[k];
      const int i0 = first((std::min(s.a.x, s.b.x) - place.corner.x) * inverse);
      const int i1 = last((std::max(s.a.x, s.b.x) - place.corner.x) * inverse);
      const int j0 = first((std::min(s.a.y, s.b.y) - place.corner.y) * inverse);
      const int j1 = last((std::max(s.a.y, s.b.y) - place.corner.y) * inverse);
      const bool straight = i0 == i1 || j0 == j1;
      for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i) {
          const Placed child = place.child(0, i, j);
          if (!straight && !may_meet(s, child.corner, child.side, 0))
            continue;
          children[4 * j + i].push_back(k);
          ++entries;
        }
    }
    return entries;
  }

  /// Parity at the children's corners: up along the left edges, then right along the bottom edge of each row.
  void set_corners(const Placed& place, LocalIndex first, const std::array<List, 16>& children) {
    bool row_start = grid_.cells_[place.cell].corner_inside != 0;
    for (int j = 0; j < 4; ++j) {
      bool parity = row_start;
      for (int i = 0; i < 4; ++i) {
        const Placed child = place.child(first, i, j);
        grid_.cells_[child.cell].corner_inside = parity ? 1 : 0;
        for (const LocalIndex k : children[4 * j + i]) {
          const Segment& s = grid_.segments_[k];
          parity ^= crosses_horizontal(s, child.corner.y, child.corner.x, child.corner.x + child.side);
          if (i == 0)
            row_start ^= crosses_vertical(s, child.corner.x, child.corner.y, child.corner.y + child.side);
        }
      }
    }
  }

  SegmentGrid& grid_;
  std::vector<std::array<List, 16>> lists_; // per depth
  double smallest_ = 0;                     // side below which no cell may go: corners must be doubles
};

SegmentGrid::SegmentGrid(std::vector<Segment> segments) : segments_(std::move(segments)) {
  for (const Segment& s : segments_) {
    box_.include(s.a);
    box_.include(s.b);
  }
  if (!segments_.empty())
    Builder{*this};
  cells_.shrink_to_fit();
  cell_segment_.shrink_to_fit();
}

SegmentGrid::Placed SegmentGrid::bin_of(Vec2 p) const {
  Placed place = root_;
  while (cells_[place.cell].split) {
    const double inverse = 4 / place.side;
    const int i = std::clamp(static_cast<int>((p.x - place.corner.x) * inverse), 0, 3);
    const int j = std::clamp(static_cast<int>((p.y - place.corner.y) * inverse), 0, 3);
    place = place.child(cells_[place.cell].first, i, j);
  }
  return place;
}

LocalIndex SegmentGrid::looked_at_for(Vec2 p) const {
  return segments_.empty() || !box_.contains(p) ? 0 : cells_[bin_of(p).cell].count();
}

bool SegmentGrid::inside(Vec2 p) const {
  if (segments_.empty() || !box_.contains(p))
    return false;
  const Placed place = bin_of(p);
  const Cell& cell = cells_[place.cell];
  bool parity = cell.corner_inside != 0;
  for (LocalIndex k = cell.first; k < cell.last(); ++k) {
    const Segment& s = segments_[cell_segment_[k]];
    parity ^= crosses_horizontal(s, place.corner.y, place.corner.x, p.x);
    parity ^= crosses_vertical(s, p.x, place.corner.y, p.y);
  }
  return parity;
}

void SegmentGrid::look_in_leaf(const Cell& cell, Vec2 p, Nearest& best) const {
  for (LocalIndex k = cell.first; k < cell.last(); ++k) {
    const LocalIndex index = cell_segment_[k];
    const double d = geometry::squared_distance(p, segments_[index]);
    if (d < best.squared_distance || (d == best.squared_distance && (best.segment < 0 || index < best.segment)))
      best = {index, d};
  }
}

/// Mostly one child alone lies within reach: the way down is a loop then.
void SegmentGrid::nearest_in(Placed place, Vec2 p, Nearest& best) const {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
  for (;;) {
    if (!cells_[place.cell].split)
      return look_in_leaf(cells_[place.cell], p, best);
    // Slightly more than the distance: rounding must not hide a segment that is as near.
    const double inverse = 4 / place.side;
    const double x = (p.x - place.corner.x) * inverse, y = (p.y - place.corner.y) * inverse;
    const double reach = std::sqrt(best.squared_distance) * inverse * (1 + 1e-12) + 1e-12;
    i0 = static_cast<int>(std::clamp(x - reach, 0.0, 3.0));
    i1 = static_cast<int>(std::clamp(x + reach, 0.0, 3.0));
    j0 = static_cast<int>(std::clamp(y - reach, 0.0, 3.0));
    j1 = static_cast<int>(std::clamp(y + reach, 0.0, 3.0));
    if (i0 != i1 || j0 != j1)
      break;
    place = place.child(cells_[place.cell].first, i0, j0);
  }
  struct Entry {
    double squared_distance;
    Placed place;
  };
  std::array<Entry, 16> entries;
  int n = 0;
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const Placed child = place.child(cells_[place.cell].first, i, j);
      if (!cells_[child.cell].split && cells_[child.cell].listed == 0)
        continue;
      const Entry entry{child.squared_distance(p), child};
      int at = n++;
      for (; at > 0 && entry.squared_distance < entries[at - 1].squared_distance; --at)
        entries[at] = entries[at - 1];
      entries[at] = entry;
    }
  for (int k = 0; k < n && entries[k].squared_distance <= best.squared_distance * (1 + 1e-12); ++k)
    nearest_in(entries[k].place, p, best);
}

std::optional<SegmentGrid::Nearest> SegmentGrid::nearest(Vec2 p, double reach) const {
  if (segments_.empty())
    return std::nullopt;
  Nearest best{-1, reach * reach};
  nearest_in(root_, p, best);
  if (best.segment < 0)
    return std::nullopt;
  return best;
}

SegmentGrid::Nearest SegmentGrid::nearest(Vec2 p) const {
  TRIME_ASSERT(!segments_.empty());
  Nearest best{-1, std::numeric_limits<double>::infinity()};
  nearest_in(root_, p, best);
  TRIME_ASSERT(best.segment >= 0, "p = ({}, {})", p.x, p.y);
  return best;
}

std::size_t SegmentGrid::memory_bytes() const {
  return segments_.capacity() * sizeof(Segment) + cells_.capacity() * sizeof(Cell) +
         cell_segment_.capacity() * sizeof(LocalIndex);
}

} // namespace trime::geometry
