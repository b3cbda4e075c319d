// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/size_cells.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

using geometry::Box;
using geometry::Vec2;

namespace {

constexpr double half_diagonal = 0.70710678118654757; // of a unit square
constexpr double rounding = 1 + 1e-12;
constexpr int row = 3; // points of a row of the 3 x 3 of a cell
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

/// Candidates of a group of blocks.
void CellBuilder::collect(const CellPlace& place) {
  const Vec2 middle = grid_.corner({place.level + 1, 2 * place.i + 1, 2 * place.j + 1});
  const double low = source_.cones.value(middle, source_.cap);
  found_.clear();
  source_.cones.collect(middle, (low + 2 * half_diagonal * grid_.side_at(place.level) * source_.slope) * rounding,
                        found_);
  Level& level = level_of(place);
  Candidates& cones = level.cones;
  cones.x.clear();
  cones.y.clear();
  cones.height.clear();
  for (const LocalIndex k : found_) {
    const Cone& cone = source_.cones.cones()[k];
    cones.x.push_back(cone.apex.x);
    cones.y.push_back(cone.apex.y);
    cones.height.push_back(cone.height);
  }
  for (int k = 0; k < 4; ++k)
    evaluate(level, corners[k], grid_.corner({place.level, place.i + (k & 1), place.j + (k >> 1)}));
  evaluate(level, center, middle);
}

void CellBuilder::evaluate(Level& level, int point, Vec2 p) const {
  const std::size_t count = level.cones.size();
  std::vector<double>& at = level.cones.at[point];
  at.resize(count);
  const double* const x = level.cones.x.data();
  const double* const y = level.cones.y.data();
  const double* const height = level.cones.height.data();
  const double slope = source_.slope;
  for (std::size_t k = 0; k < count; ++k)
    at[k] = slope * geometry::length({p.x - x[k], p.y - y[k]}) + height[k];
  const auto lowest = std::min_element(at.begin(), at.end());
  level.lowest[point] = static_cast<std::size_t>(lowest - at.begin());
  level.low[point] = lowest == at.end() ? source_.cap : std::min(source_.cap, *lowest);
}

void CellBuilder::pass_on(const Level& level, int quarter, Level& below) {
  const Candidates& cones = level.cones;
  const std::size_t count = cones.size();
  const std::array<int, 4> from = corners_of_quarter(quarter);
  const double* const height = cones.height.data();
  const std::array<const double*, 4> at{cones.at[from[0]].data(), cones.at[from[1]].data(), cones.at[from[2]].data(),
                                        cones.at[from[3]].data()};
  covered_.assign(count, 0);
  const std::array<int, 5> winners_at{from[0], from[1], from[2], from[3], first_quarter + quarter};
  for (std::size_t n = 0; n < winners_at.size() && count > 0; ++n) {
    const std::size_t winner = level.lowest[winners_at[n]];
    if (std::any_of(winners_at.begin(), winners_at.begin() + n,
                    [&](int before) { return level.lowest[before] == winner; }))
      continue;
    const double v0 = at[0][winner], v1 = at[1][winner], v2 = at[2][winner], v3 = at[3][winner];
    const double own = height[winner];
    const char before = covered_[winner];
    char* const covered = covered_.data();
    for (std::size_t k = 0; k < count; ++k) {
      const double higher = std::max(0.0, height[k] - own);
      covered[k] |=
          static_cast<char>(static_cast<int>(v0 + higher <= at[0][k]) & static_cast<int>(v1 + higher <= at[1][k]) &
                            static_cast<int>(v2 + higher <= at[2][k]) & static_cast<int>(v3 + higher <= at[3][k]));
    }
    covered_[winner] = before;
  }
  Candidates& kept = below.cones;
  kept.x.clear();
  kept.y.clear();
  kept.height.clear();
  const std::array<int, 5> to{corners[0], corners[1], corners[2], corners[3], center};
  for (int n = 0; n < 5; ++n) {
    kept.at[to[n]].clear();
    below.low[to[n]] = level.low[winners_at[n]];
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (covered_[k] != 0)
      continue;
    for (int n = 0; n < 5; ++n)
      kept.at[to[n]].push_back(cones.at[winners_at[n]][k]);
    kept.x.push_back(cones.x[k]);
    kept.y.push_back(cones.y[k]);
    kept.height.push_back(height[k]);
  }
  for (int n = 0; n < 5; ++n) {
    const std::vector<double>& values = kept.at[to[n]];
    below.lowest[to[n]] = static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
  }
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
  // No point of the cell is farther from its nearest corner than half the diagonal.
  if (source_.slope * half_diagonal * side <= limits_.tolerance * least)
    return bilinear_leaf(level);
  if (level.cones.size() <= limits_.most_cones && is_low(level))
    return cones_leaf(level, place);
  if (side <= source_.least_side || place.level >= limits_.most_levels)
    return bilinear_leaf(level);
  evaluate_inside(level, place);
  if (is_smooth(level))
    return bilinear_leaf(level);
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

CellNode CellBuilder::cones_leaf(const Level& level, const CellPlace& place) {
  const Candidates& cones = level.cones;
  const std::size_t first = part_.numbers.size(), count = cones.size();
  for (std::size_t k = 0; k < count; ++k)
    part_.numbers.insert(part_.numbers.end(), {cones.x[k], cones.y[k], cones.height[k]});
  const auto lowest_at = [&](Vec2 p) {
    return lowest_cone(&part_.numbers[first], count, p, source_.slope, source_.cap);
  };
  const Box cell = grid_.box(place);
  part_.least = std::min(part_.least, lowest_at(lowest_point(&part_.numbers[first], count, cell, source_.slope)));
  for (const int corner : corners) {
    const auto at = cones.at[corner].begin();
    const double value = std::min(source_.cap, *std::min_element(at, at + static_cast<std::ptrdiff_t>(count)));
    part_.least = std::min(part_.least, value);
    part_.largest = std::max(part_.largest, value);
  }
  ++part_.leaves;
  return CellLeaf::with_cones(first, count).node();
}

/// Cones are highest at corners of the cell, but between them the field can be higher than at all its corners.
bool CellBuilder::is_low(const Level& level) const {
  const auto& at = level.cones.at;
  for (std::size_t k = 0; k < level.cones.size(); ++k)
    if (std::max({at[0][k], at[2][k], at[6][k], at[8][k]}) <= limits_.highest)
      return true;
  return source_.cap <= limits_.highest;
}

/// A ridge between cones may pass by the middles of edges and cell, so that the quarters are asked too.
bool CellBuilder::is_smooth(const Level& level) const {
  const auto& low = level.low;
  const auto within = [&](int point, double interpolated) {
    return std::fabs(low[point] - interpolated) <= limits_.tolerance * low[point];
  };
  if (!(within(center, 0.25 * (low[0] + low[2] + low[6] + low[8])) && within(1, 0.5 * (low[0] + low[2])) &&
        within(7, 0.5 * (low[6] + low[8])) && within(3, 0.5 * (low[0] + low[6])) && within(5, 0.5 * (low[2] + low[8]))))
    return false;
  for (int k = 0; k < 4; ++k) {
    const double x = (k & 1) != 0 ? 0.75 : 0.25, y = (k >> 1) != 0 ? 0.75 : 0.25;
    const double below = low[0] + x * (low[2] - low[0]), above = low[6] + x * (low[8] - low[6]);
    if (!within(first_quarter + k, below + y * (above - below)))
      return false;
  }
  return true;
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
