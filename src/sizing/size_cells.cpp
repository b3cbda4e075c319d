// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/size_cells.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

using geometry::Box;
using geometry::Vec2;

namespace {

constexpr double half_diagonal = 0.70710678118654757; // of a unit square
constexpr double rounding = 1 + 1e-12;                // of distances
constexpr int row = 3;                                // points of a row of the 3 x 3 of a cell
constexpr std::array<int, 4> corners{0, 2, 6, 8};

/// Corners of a quarter of a cell among the points of the cell.
constexpr std::array<int, 4> corners_of_quarter(int quarter) {
  const int first = (quarter & 1) + row * (quarter >> 1);
  return {first, first + 1, first + row, first + row + 1};
}

} // namespace

Vec2 lowest_point(const double* cones, std::size_t count, const Box& cell, double slope) {
  Vec2 where = cell.min;
  double low = std::numeric_limits<double>::infinity();
  for (const double* cone = cones; cone != cones + 3 * count; cone += 3) {
    const Vec2 nearest{std::clamp(cone[0], cell.min.x, cell.max.x), std::clamp(cone[1], cell.min.y, cell.max.y)};
    const double value = lowest_cone(cone, 1, nearest, slope, low);
    if (value < low) {
      low = value;
      where = nearest;
    }
  }
  return where;
}

CellPart CellBuilder::build(const CellPlace& place, std::int64_t columns, std::int64_t rows) {
  const std::int64_t along = std::int64_t{1} << -place.level;
  first_column_ = along * place.i;
  first_row_ = along * place.j;
  columns_ = std::min(along, columns - first_column_);
  rows_ = std::min(along, rows - first_row_);
  part_ = {};
  part_.roots.resize(static_cast<std::size_t>(columns_ * rows_));
  collect(place);
  build_blocks(place);
  return std::move(part_);
}

void CellBuilder::Level::reserve(std::size_t cones) {
  if (cones <= capacity)
    return;
  capacity = 2 * cones;
  numbers.resize(capacity * (points + 3));
}

/// The cones of a group of blocks.
void CellBuilder::collect(const CellPlace& place) {
  constexpr int along = 4; // points where the lowest cones are sought: between the blocks
  std::array<Vec2, 4> ends;
  for (int k = 0; k < 4; ++k)
    ends[k] = grid_.corner({place.level, place.i + (k & 1), place.j + (k >> 1)});
  struct Winner {
    std::array<double, 4> distance; // times the slope, from the corners
    double height;
    LocalIndex index;
  };
  std::vector<Winner> winners;
  const auto cones = source_.cones.cones();
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= along; ++i) {
      const double x = ends[0].x + (ends[3].x - ends[0].x) * i / along,
                   y = ends[0].y + (ends[3].y - ends[0].y) * j / along;
      const LocalIndex index = source_.cones.lowest({x, y}, std::numeric_limits<double>::infinity());
      if (index < 0 || std::any_of(winners.begin(), winners.end(), [&](const Winner& w) { return w.index == index; }))
        continue;
      Winner winner{{}, cones[index].height, index};
      for (int k = 0; k < 4; ++k)
        winner.distance[k] = source_.slope * length(ends[k] - cones[index].apex) * rounding;
      winners.push_back(winner);
    }
  const auto covered = [&](const std::array<double, 4>& squared, double height) {
    std::array<double, 4> distance;
    for (int k = 0; k < 4; ++k)
      distance[k] = source_.slope * std::sqrt(squared[k]);
    return std::any_of(winners.begin(), winners.end(), [&](const Winner& w) {
      const double higher = std::max(0.0, w.height - height);
      return w.distance[0] + higher <= distance[0] && w.distance[1] + higher <= distance[1] &&
             w.distance[2] + higher <= distance[2] && w.distance[3] + higher <= distance[3];
    });
  };
  const auto from_box = [&](const Box& apexes, double least) {
    return covered({apexes.squared_distance(ends[0]), apexes.squared_distance(ends[1]),
                    apexes.squared_distance(ends[2]), apexes.squared_distance(ends[3])},
                   least);
  };
  found_.clear();
  source_.cones.visit_unless(from_box, [&](LocalIndex k) { found_.push_back(k); });
  Level& level = level_of(place);
  level.reserve(found_.size());
  level.count = 0;
  for (const LocalIndex k : found_) {
    const Cone& cone = cones[k];
    level.x()[level.count] = cone.apex.x;
    level.y()[level.count] = cone.apex.y;
    level.height()[level.count++] = cone.height;
  }
  for (int k = 0; k < 4; ++k)
    evaluate(level, corners[k], ends[k]);
  evaluate(level, center, grid_.corner({place.level + 1, 2 * place.i + 1, 2 * place.j + 1}));
}

void CellBuilder::evaluate(Level& level, int point, Vec2 p) const {
  double* const at = level.at(point);
  const double* const x = level.x();
  const double* const y = level.y();
  const double* const height = level.height();
  const double slope = source_.slope;
  for (std::size_t k = 0; k < level.count; ++k)
    at[k] = slope * geometry::length({p.x - x[k], p.y - y[k]}) + height[k];
  find_lowest(level, point);
}

void CellBuilder::find_lowest(Level& level, int point) const {
  const double* const at = level.at(point);
  double low = std::numeric_limits<double>::infinity();
  std::size_t lowest = 0;
  for (std::size_t k = 0; k < level.count; ++k)
    if (at[k] < low) {
      low = at[k];
      lowest = k;
    }
  level.lowest[point] = lowest;
  level.low[point] = std::min(low, source_.cap);
}

/// Marks what a cone covers in a cell, or would if all others were higher by their slack.
void CellBuilder::cover(Level& level, const std::array<int, 4>& at, std::size_t by, const double* slack) {
  const double* const height = level.height();
  const double *const at0 = level.at(at[0]), *const at1 = level.at(at[1]), *const at2 = level.at(at[2]),
                      *const at3 = level.at(at[3]);
  const double v0 = at0[by], v1 = at1[by], v2 = at2[by], v3 = at3[by];
  const double own = height[by];
  const std::int64_t before = covered_[by];
  std::int64_t* const covered = covered_.data();
  for (std::size_t k = 0; k < level.count; ++k) {
    const double difference = own - height[k];
    double lower = difference < 0 ? difference : 0;
    if (slack != nullptr)
      lower = lower < slack[k] ? slack[k] : lower;
    const bool all =
        (v0 <= at0[k] + lower) & (v1 <= at1[k] + lower) & (v2 <= at2[k] + lower) & (v3 <= at3[k] + lower);
    covered[k] |= all ? 1 : 0;
  }
  covered_[by] = before;
}

void CellBuilder::pass_on(Level& level, int quarter, Level& below) {
  const std::array<int, 4> ends = corners_of_quarter(quarter);
  const std::array<int, 5> from{ends[0], ends[1], ends[2], ends[3], first_quarter + quarter};
  constexpr std::array<int, 5> to{corners[0], corners[1], corners[2], corners[3], center};
  covered_.assign(level.count, 0);
  for (std::size_t n = 0; n < from.size() && level.count > 1; ++n) {
    const std::size_t by = level.lowest[from[n]];
    if (std::none_of(from.begin(), from.begin() + n, [&](int before) { return level.lowest[before] == by; }))
      cover(level, ends, by, nullptr);
  }
  below.reserve(level.count);
  std::size_t count = 0;
  for (std::size_t k = 0; k < level.count; ++k) {
    if (covered_[k] != 0)
      continue;
    for (int n = 0; n < 5; ++n)
      below.at(to[n])[count] = level.at(from[n])[k];
    below.x()[count] = level.x()[k];
    below.y()[count] = level.y()[k];
    below.height()[count++] = level.height()[k];
  }
  below.count = count;
  for (const int point : to)
    find_lowest(below, point);
}

void CellBuilder::evaluate_inside(Level& level, const CellPlace& place) const {
  const int half = place.level + 1, quarter = place.level + 2;
  const std::int64_t i = place.i, j = place.j;
  evaluate(level, 1, grid_.corner({half, 2 * i + 1, 2 * j}));
  evaluate(level, 3, grid_.corner({half, 2 * i, 2 * j + 1}));
  evaluate(level, 5, grid_.corner({half, 2 * i + 2, 2 * j + 1}));
  evaluate(level, 7, grid_.corner({half, 2 * i + 1, 2 * j + 2}));
  for (int k = 0; k < 4; ++k)
    evaluate(level, first_quarter + k, grid_.corner({quarter, 4 * i + 1 + 2 * (k & 1), 4 * j + 1 + 2 * (k >> 1)}));
}

void CellBuilder::build_blocks(const CellPlace& place) {
  if (place.level == 0) {
    quarters_.clear();
    const std::int64_t block = (place.j - first_row_) * columns_ + place.i - first_column_;
    part_.roots[static_cast<std::size_t>(block)] = in_pairs(build_cell(place));
    return;
  }
  Level& level = level_of(place);
  evaluate_inside(level, place);
  for (int k = 0; k < 4; ++k) {
    const CellPlace below{place.level + 1, 2 * place.i + (k & 1), 2 * place.j + (k >> 1)};
    const std::int64_t along = std::int64_t{1} << -below.level;
    if (along * below.i >= first_column_ + columns_ || along * below.j >= first_row_ + rows_)
      continue;
    pass_on(level, k, level_of(below));
    build_blocks(below);
  }
}

CellNode CellBuilder::build_cell(const CellPlace& place) {
  Level& level = level_of(place);
  const double side = grid_.side_at(place.level);
  const double least = std::min({level.low[0], level.low[2], level.low[6], level.low[8]});
  const double change = source_.slope * half_diagonal * side; // to the nearest corner at most
  if (change <= limits_.tolerance * least)
    return bilinear_leaf(level);
  if (choose_cones(level, place, limits_.tolerance * (least - change)) && is_low(level))
    return cones_leaf(level, place);
  if (side <= source_.least_side || place.level >= limits_.most_levels)
    return bilinear_leaf(level);
  evaluate_inside(level, place);
  const auto node = static_cast<CellNode>(quarters_.size());
  quarters_.emplace_back();
  for (int k = 0; k < 4; ++k) {
    const CellPlace below{place.level + 1, 2 * place.i + (k & 1), 2 * place.j + (k >> 1)};
    pass_on(level, k, level_of(below));
    const CellNode quarter = build_cell(below);
    quarters_[node][k] = quarter;
  }
  return node;
}

/// A few cones that are together higher by `slack` at most than all: those that are the lowest at the corners first,
/// so that the field is exact there.
bool CellBuilder::choose_cones(Level& level, const CellPlace& place, double slack) {
  chosen_.clear();
  covered_.assign(level.count, 0);
  const Box cell = grid_.box(place);
  const double bend = 0.25 * source_.slope * cell.width() * cell.width();
  slack_.resize(level.count);
  for (std::size_t k = 0; k < level.count; ++k) {
    const double distance = std::sqrt(cell.squared_distance({level.x()[k], level.y()[k]}));
    slack_[k] = distance > 0 ? slack - bend / distance : -1e300;
  }
  const auto choose = [&](std::size_t cone) {
    if (std::find(chosen_.begin(), chosen_.end(), cone) != chosen_.end())
      return;
    chosen_.push_back(cone);
    cover(level, corners, cone, slack_.data());
  };
  for (const int point : corners)
    choose(level.lowest[point]);
  const double* const at = level.at(center);
  while (chosen_.size() <= limits_.most_cones) {
    for (const std::size_t k : chosen_)
      covered_[k] = 1;
    std::size_t next = level.count;
    for (std::size_t k = 0; k < level.count; ++k)
      if (covered_[k] == 0 && (next == level.count || at[k] < at[next]))
        next = k;
    if (next == level.count)
      return true;
    choose(next);
  }
  return false;
}

CellNode CellBuilder::bilinear_leaf(const Level& level) {
  const std::size_t first = part_.numbers.size();
  for (const int corner : corners) {
    part_.numbers.push_back(level.low[corner]);
    part_.least = std::min(part_.least, level.low[corner]);
    part_.largest = std::max(part_.largest, level.low[corner]);
  }
  ++part_.leaves;
  return CellLeaf::bilinear(first).node();
}

CellNode CellBuilder::cones_leaf(Level& level, const CellPlace& place) {
  const std::size_t first = part_.numbers.size(), count = chosen_.size();
  for (const std::size_t k : chosen_)
    part_.numbers.insert(part_.numbers.end(), {level.x()[k], level.y()[k], level.height()[k]});
  const double* const cones = &part_.numbers[first];
  const Vec2 lowest = lowest_point(cones, count, grid_.box(place), source_.slope);
  part_.least = std::min(part_.least, lowest_cone(cones, count, lowest, source_.slope, source_.cap));
  for (const int corner : corners) {
    part_.least = std::min(part_.least, level.low[corner]);
    part_.largest = std::max(part_.largest, level.low[corner]);
  }
  ++part_.leaves;
  return CellLeaf::with_cones(first, count).node();
}

/// Cones are highest at corners of the cell, but between them the field can be higher than at all its corners.
bool CellBuilder::is_low(Level& level) const {
  return source_.cap <= limits_.highest || std::any_of(chosen_.begin(), chosen_.end(), [&](std::size_t k) {
           return std::max({level.at(0)[k], level.at(2)[k], level.at(6)[k], level.at(8)[k]}) <= limits_.highest;
         });
}

/// Joins each node of the plain quadtree of a block with its children.
CellNode CellBuilder::in_pairs(CellNode node) {
  if (node < 0)
    return node;
  const auto joined = static_cast<CellNode>(part_.children.size());
  part_.children.emplace_back();
  for (int k = 0; k < 16; ++k) {
    const int column = k & 3, row_of = k >> 2;
    const CellNode quarter = quarters_[node][(column >> 1) + 2 * (row_of >> 1)];
    CellNode child = quarter;
    if (quarter >= 0) {
      child = in_pairs(quarters_[quarter][(column & 1) + 2 * (row_of & 1)]);
    } else if (CellLeaf leaf = CellLeaf::of(quarter); leaf.is_bilinear()) {
      leaf.kind = 1;
      child = leaf.node();
    }
    part_.children[joined][k] = child;
  }
  return joined;
}

} // namespace trime::sizing
