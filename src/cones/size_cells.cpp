// SPDX-License-Identifier: BSD-3-Clause
#include "cones/size_cells.hpp"

#include "core/angle.hpp"
#include <algorithm>
#include <cmath>

namespace trime::cones {

using geometry::Box;
using geometry::Vec2;

namespace {

constexpr double rounding = 1 + 1e-12; // of distances

/// Cones that are the lowest at some points of a cell: those that they cover need not be looked at.
class Winners {
public:
  Winners(const SizeSource& source, const std::array<Vec2, 4>& corners) : source_(source), corners_(corners) {}

  void add_lowest_at(Vec2 p) {
    const LocalIndex index = source_.cones.lowest(p, std::numeric_limits<double>::infinity());
    if (index < 0 || std::any_of(winners_.begin(), winners_.end(), [&](const Winner& w) { return w.index == index; }))
      return;
    const Cone& cone = source_.cones.cones()[index];
    Winner winner{index, cone.height, {}};
    for (int k = 0; k < 4; ++k)
      winner.at[k] = source_.slope * length(corners_[k] - cone.apex) * rounding;
    winners_.push_back(winner);
  }

  /// Do they cover all cones with apexes in the box and at least this height?
  bool cover(const Box& apexes, double height) const {
    std::array<double, 4> nearest;
    for (int k = 0; k < 4; ++k)
      nearest[k] = source_.slope * std::sqrt(apexes.squared_distance(corners_[k]));
    return std::any_of(winners_.begin(), winners_.end(), [&](const Winner& w) {
      const double higher = std::max(0.0, w.height - height);
      return w.at[0] + higher <= nearest[0] && w.at[1] + higher <= nearest[1] && w.at[2] + higher <= nearest[2] &&
             w.at[3] + higher <= nearest[3];
    });
  }

private:
  struct Winner {
    LocalIndex index;
    double height;
    std::array<double, 4> at; ///< slope times the distance from the corners
  };
  const SizeSource& source_;
  std::array<Vec2, 4> corners_;
  std::vector<Winner> winners_;
};

} // namespace

Vec2 lowest_point(const double* pairs, std::size_t count, const Box& cell, double slope) {
  Vec2 where = cell.min;
  double low = std::numeric_limits<double>::infinity();
  for (const double* pair = pairs; pair != pairs + ConePair::numbers * count; pair += ConePair::numbers) {
    using Lanes = ConePair::Lanes;
    const Lanes x = lanes::larger(lanes::smaller(ConePair::load(pair), Lanes{} + cell.max.x), Lanes{} + cell.min.x);
    const Lanes y = lanes::larger(lanes::smaller(ConePair::load(pair + 2), Lanes{} + cell.max.y), Lanes{} + cell.min.y);
    const Lanes values = ConePair::values(pair, x, y, slope);
    for (int lane = 0; lane < 2; ++lane)
      if (values[lane] < low) {
        low = values[lane];
        where = {x[lane], y[lane]};
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

void CellBuilder::Level::reserve(std::int64_t count) {
  if (count <= cones.stride)
    return;
  cones.stride = 2 * count + ConeList::padding - 2 * count % ConeList::padding;
  numbers.resize(static_cast<std::size_t>(cones.stride * ConeList::arrays));
  cones.numbers = numbers.data();
}

ConeList& CellBuilder::cones_of(const CellPlace& place, std::int64_t room) {
  Level& level = levels_[static_cast<std::size_t>(place.level + top)];
  level.reserve(room);
  return level.cones;
}

std::array<Vec2, 4> CellBuilder::corners_of(const CellPlace& place) const {
  const Box cell = grid_.box(place);
  return {cell.min, {cell.max.x, cell.min.y}, {cell.min.x, cell.max.y}, cell.max};
}

CornerValues CellBuilder::values(const ConeList& cones) const {
  return {std::min(source_.cap, cones.low[0]), std::min(source_.cap, cones.low[2]), std::min(source_.cap, cones.low[6]),
          std::min(source_.cap, cones.low[8])};
}

/// The cones of a group of blocks.
void CellBuilder::collect(const CellPlace& place) {
  constexpr int along = 4; // parts of a side, between which winners are sought
  const std::array<Vec2, 4> corners = corners_of(place);
  Winners winners(source_, corners);
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= along; ++i)
      winners.add_lowest_at({corners[0].x + (corners[3].x - corners[0].x) * i / along,
                             corners[0].y + (corners[3].y - corners[0].y) * j / along});
  std::vector<LocalIndex> found;
  source_.cones.visit_unless([&](const Box& apexes, double least) { return winners.cover(apexes, least); },
                             [&](LocalIndex k) { found.push_back(k); });
  ConeList& cones = cones_of(place, std::ssize(found));
  cones.count = std::ssize(found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Cone& cone = source_.cones.cones()[found[k]];
    cones.x()[k] = cone.apex.x;
    cones.y()[k] = cone.apex.y;
    cones.height()[k] = cone.height;
  }
  const Vec2 middle = grid_.corner({place.level + 1, 2 * place.i + 1, 2 * place.j + 1});
  kernel_.evaluate(cones, source_.slope,
                   {5,
                    {0, 2, 6, 8, ConeList::center},
                    {corners[0].x, corners[1].x, corners[2].x, corners[3].x, middle.x},
                    {corners[0].y, corners[1].y, corners[2].y, corners[3].y, middle.y}});
}

/// At the middles of the edges and the centres of the quarters.
void CellBuilder::evaluate_inside(ConeList& cones, const CellPlace& place) const {
  const Vec2 low = grid_.corner({place.level + 2, 4 * place.i + 1, 4 * place.j + 1});
  const Vec2 high = grid_.corner({place.level + 2, 4 * place.i + 3, 4 * place.j + 3});
  const Box cell = grid_.box(place);
  const Vec2 middle = grid_.corner({place.level + 1, 2 * place.i + 1, 2 * place.j + 1});
  constexpr int quarter = ConeList::first_quarter;
  kernel_.evaluate(cones, source_.slope,
                   {8,
                    {1, 3, 5, 7, quarter, quarter + 1, quarter + 2, quarter + 3},
                    {middle.x, cell.min.x, cell.max.x, middle.x, low.x, high.x, low.x, high.x},
                    {cell.min.y, middle.y, middle.y, cell.max.y, low.y, low.y, high.y, high.y}});
}

void CellBuilder::build_blocks(const CellPlace& place) {
  if (place.level == 0) {
    quarters_.clear();
    const std::int64_t block = (place.j - first_row_) * columns_ + place.i - first_column_;
    part_.roots[static_cast<std::size_t>(block)] = in_pairs(build_cell(place));
    return;
  }
  ConeList& cones = cones_of(place);
  evaluate_inside(cones, place);
  for (int k = 0; k < 4; ++k) {
    const CellPlace below = place.quarter(k);
    const std::int64_t along = std::int64_t{1} << -below.level;
    if (along * below.i >= first_column_ + columns_ || along * below.j >= first_row_ + rows_)
      continue;
    kernel_.pass_on(cones, k, cones_of(below, cones.count));
    build_blocks(below);
  }
}

CellNode CellBuilder::build_cell(const CellPlace& place) {
  ConeList& cones = cones_of(place);
  const CornerValues at = values(cones);
  const double side = grid_.side_at(place.level), least = *std::min_element(at.begin(), at.end());
  const double change = source_.slope * half_sqrt_2 * side; // to the nearest corner, at most
  if (change <= limits_.tolerance * least || cones.count == 0)
    return bilinear_leaf(cones);
  if (const int count = choose_cones(cones, place, limits_.tolerance * (least - change)); count > 0)
    return cones_leaf(cones, place, count);
  if (side <= source_.least_side || place.level >= limits_.most_levels)
    return bilinear_leaf(cones);
  evaluate_inside(cones, place);
  const auto node = static_cast<CellNode>(quarters_.size());
  quarters_.emplace_back();
  for (int k = 0; k < 4; ++k) {
    kernel_.pass_on(cones, k, cones_of(place.quarter(k), cones.count));
    const CellNode quarter = build_cell(place.quarter(k));
    quarters_[node][k] = quarter;
  }
  return node;
}

/// How many are enough; 0 if too many, or if the cell could be higher inside than all corners of groups.
int CellBuilder::choose_cones(const ConeList& cones, const CellPlace& place, double slack) {
  const Box cell = grid_.box(place);
  const double side = grid_.side_at(place.level);
  choice_.min_x = cell.min.x;
  choice_.min_y = cell.min.y;
  choice_.max_x = cell.max.x;
  choice_.max_y = cell.max.y;
  choice_.slack = slack;
  choice_.bend = 0.25 * source_.slope * side * side;
  const int count = kernel_.choose(cones, limits_.most_cones, choice_);
  // A cone is highest at a corner of the cell.
  const auto is_low = [&](std::int64_t k) {
    return std::max({cones.at(0)[k], cones.at(2)[k], cones.at(6)[k], cones.at(8)[k]}) <= limits_.highest;
  };
  const bool low = source_.cap <= limits_.highest || std::any_of(choice_.chosen, choice_.chosen + count, is_low);
  return low ? count : 0;
}

void CellBuilder::include_in_range(const CornerValues& corners) {
  for (const double value : corners) {
    part_.least = std::min(part_.least, value);
    part_.largest = std::max(part_.largest, value);
  }
}

CellNode CellBuilder::bilinear_leaf(const ConeList& cones) {
  const std::size_t first = part_.numbers.size();
  const CornerValues at = values(cones);
  part_.numbers.insert(part_.numbers.end(), at.begin(), at.end());
  include_in_range(at);
  return CellLeaf::bilinear(first).node();
}

/// An odd cone comes twice.
CellNode CellBuilder::cones_leaf(const ConeList& cones, const CellPlace& place, int count) {
  const std::size_t first = part_.numbers.size(), pairs = (static_cast<std::size_t>(count) + 1) / 2;
  for (int n = 0; n < count; n += 2) {
    const std::int64_t a = choice_.chosen[n], b = choice_.chosen[std::min(n + 1, count - 1)];
    part_.numbers.insert(part_.numbers.end(), {cones.x()[a], cones.x()[b], cones.y()[a], cones.y()[b],
                                               cones.height()[a], cones.height()[b]});
  }
  const double* const numbers = &part_.numbers[first];
  const Vec2 lowest = lowest_point(numbers, pairs, grid_.box(place), source_.slope);
  part_.least = std::min(part_.least, lowest_cone(numbers, pairs, lowest, source_.slope, source_.cap));
  include_in_range(values(cones));
  return CellLeaf::with_pairs(first, pairs).node();
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

} // namespace trime::cones
