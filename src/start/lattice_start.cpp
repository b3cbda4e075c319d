// SPDX-License-Identifier: BSD-3-Clause
#include "start/start.hpp"

#include "core/thread_loop.hpp"
#include "start/row_lattice.hpp"
#include "start/rules.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace trime::start {
namespace {

using geometry::Vec2;
using polygon::BoundaryGuard;

/// Smallest and largest t with from + t * direction inside the box; empty (first > second) if the line misses it.
std::pair<double, double> clip_line(Vec2 from, Vec2 direction, const geometry::Box& box) {
  double low = -INFINITY, high = INFINITY;
  const auto clip = [&](double start, double slope, double min, double max) {
    if (std::fabs(slope) < 1e-12) {
      if (start < min || start > max)
        low = INFINITY;
      return;
    }
    const double a = (min - start) / slope, b = (max - start) / slope;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  };
  clip(from.x, direction.x, box.min.x, box.max.x);
  clip(from.y, direction.y, box.min.y, box.max.y);
  return {low, high};
}

} // namespace

LatticeStart::LatticeStart(const geometry::Boundary& boundary, const BoundaryGuard& guard,
                           const geometry::Lattice& lattice)
    : guard_(guard), lattice_(lattice), periods_(boundary.periods) {
  origin_ = periods_.any() ? periods_.min : boundary.bounding_box().min;
  along_ = {1, 0};
  double longest = 0;
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces) {
      const Vec2 side = piece.end - piece.start;
      if (piece.circular || geometry::squared_length(side) <= longest)
        continue;
      const bool along_period = (periods_.x > 0 && side.y == 0) || (periods_.y > 0 && side.x == 0);
      if (periods_.any() && !along_period)
        continue;
      longest = geometry::squared_length(side);
      origin_ = piece.start;
      along_ = (1 / std::sqrt(longest)) * side;
      has_side_ = true;
    }
}

RowLattice LatticeStart::rows_of(double spacing) const {
  if (!periods_.any())
    return {origin_, along_, spacing, row_height * spacing};
  RowLattice rows;
  const Vec2 axis{std::fabs(along_.x), std::fabs(along_.y)};
  if (periods_.x > 0 && periods_.y > 0)
    rows = has_side_ ? fit_to_periods(periods_, spacing, axis) : fit_to_periods(periods_, spacing);
  else
    rows = fit_to_periods(periods_, spacing, periods_.x > 0 ? Vec2{1, 0} : Vec2{0, 1});
  // Without a side to start from, no site lies on the border of the container.
  rows.origin = has_side_ ? origin_
                          : periods_.min + 0.25 * rows.spacing * rows.along +
                                0.5 * rows.height * Vec2{rows.along.y, rows.along.x};
  return rows;
}

/// @brief Is all of a tile, and a margin around it, inside the shape? Never true if not. Its sites then need no look at
/// the boundary; and since coordinates ascend or descend along a row, those of a row are the ones between two of them.
bool LatticeStart::is_clear(const mesh::TileGrid& grid, LocalIndex tile, double margin) const {
  if (periods_.any())
    return false;
  const geometry::Box box = grid.tile_box(tile);
  const Vec2 middle = lattice_.snap(0.5 * (box.min + box.max));
  const double reach = 0.5 * geometry::length(box.max - box.min) + 2 * margin;
  return guard_.distance(middle, reach) >= reach && guard_.inside(middle);
}

/// Visits the lattice sites of one tile, row by row. A site belongs to the tile of its snapped coordinates; rows and
/// columns reach a little beyond the tile's box, so rounding cannot lose any. Rows and columns of a periodic lattice
/// are reduced to the first so many, so that a site has one position from wherever it is seen.
/// @param visit visit(first, last, site): the sites site(first) .. site(last) of one row
template <class Visit>
void LatticeStart::for_each_in_tile(const mesh::TileGrid& grid, LocalIndex tile, const RowLattice& rows, double spacing,
                                    const Visit& visit) const {
  geometry::Box box = grid.tile_box(tile);
  box = {box.min - Vec2{0.1 * spacing, 0.1 * spacing}, box.max + Vec2{0.1 * spacing, 0.1 * spacing}};
  const Vec2 across = geometry::left_normal(rows.along);
  const double free = StartRules::lattice_strip * spacing;
  double low = INFINITY, high = -INFINITY, begin = INFINITY, end = -INFINITY;
  for (const Vec2 corner : {box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}}) {
    low = std::min(low, geometry::dot(corner - rows.origin, across));
    high = std::max(high, geometry::dot(corner - rows.origin, across));
    begin = std::min(begin, geometry::dot(corner - rows.origin, rows.along));
    end = std::max(end, geometry::dot(corner - rows.origin, rows.along));
  }
  const bool clear = is_clear(grid, tile, spacing);
  const auto last_of = [](std::int64_t first, double limit, std::int64_t period) {
    const auto last = static_cast<std::int64_t>(std::ceil(limit));
    return period > 0 ? std::min(last, first + period - 1) : last;
  };
  const auto reduced = [](std::int64_t k, std::int64_t period) {
    return period > 0 ? (k % period + period) % period : k;
  };
  const auto first_row = static_cast<std::int64_t>(std::floor(low / rows.height));
  for (std::int64_t j = first_row; j <= last_of(first_row, high / rows.height, rows.rows); ++j) {
    const std::int64_t row = reduced(j, rows.rows);
    const Vec2 start = rows.origin + (static_cast<double>(row) * rows.height) * across;
    const double shift = rows.shift(row);
    const auto [first, last] = periods_.any() ? std::pair{begin, end} : clip_line(start, rows.along, box);
    if (!(first <= last))
      continue;
    auto column = static_cast<std::int64_t>(std::floor(first / rows.spacing - shift));
    std::int64_t last_column = last_of(column, last / rows.spacing - shift, rows.columns);
    const auto site = [&](std::int64_t i) {
      const double along = (static_cast<double>(reduced(i, rows.columns)) + shift) * rows.spacing;
      return periods_.wrap(lattice_.snap(start + along * rows.along));
    };
    const auto in_tile = [&](Vec2 p) { return grid.container().contains(p) && grid.place(p).tile == tile; };
    if (clear) {
      while (column <= last_column && !in_tile(site(column)))
        ++column;
      while (column < last_column && !in_tile(site(last_column)))
        --last_column;
      if (column <= last_column)
        visit(column, last_column, site);
      continue;
    }
    for (; column <= last_column; ++column) {
      const Vec2 p = site(column);
      if (!in_tile(p) || !guard_.inside(p))
        continue;
      // Where even the lower bound is far enough, no disc is near: one look-up does for nearly all.
      if (guard_.distance_below(p, free) < free && (guard_.distance(p, free) < free || guard_.encroaches(p)))
        continue;
      visit(column, column, site);
    }
  }
}

mesh::SiteList LatticeStart::sites(const mesh::TileRange& tiles, double spacing, std::size_t more) const {
  const RowLattice rows = rows_of(spacing);
  if (!(rows.spacing > 0))
    return {};
  std::vector<std::int64_t> before = counts(tiles, rows, spacing);
  before.push_back(0);
  std::exclusive_scan(before.begin(), before.end(), before.begin(), std::int64_t{0});
  const auto n = static_cast<std::size_t>(before.back());
  mesh::SiteList all;
  all.reserve(n + more);
  all.resize(n);
  thread_loop(tiles.last - tiles.first, 1, [&](std::ptrdiff_t t, int) {
    auto to = all.begin() + static_cast<std::ptrdiff_t>(before[static_cast<std::size_t>(t)]);
    for_each_in_tile(tiles.grid, tiles.first + static_cast<LocalIndex>(t), rows, spacing,
                     [&](std::int64_t column, std::int64_t last, const auto& site) {
                       for (; column <= last; ++column, ++to)
                         *to = {site(column)};
                     });
  });
  return all;
}

std::vector<std::int64_t> LatticeStart::counts(const mesh::TileRange& tiles, const RowLattice& rows,
                                               double spacing) const {
  std::vector<std::int64_t> of_tile(static_cast<std::size_t>(tiles.last - tiles.first), 0);
  thread_loop(tiles.last - tiles.first, 1, [&](std::ptrdiff_t t, int) {
    for_each_in_tile(tiles.grid, tiles.first + static_cast<LocalIndex>(t), rows, spacing,
                     [&](std::int64_t column, std::int64_t last, const auto&) {
                       of_tile[static_cast<std::size_t>(t)] += last - column + 1;
                     });
  });
  return of_tile;
}

std::int64_t LatticeStart::count(const mesh::TileRange& tiles, double spacing) const {
  const RowLattice rows = rows_of(spacing);
  if (!(rows.spacing > 0))
    return 0;
  const std::vector<std::int64_t> of_tile = counts(tiles, rows, spacing);
  return std::accumulate(of_tile.begin(), of_tile.end(), std::int64_t{0});
}

} // namespace trime::start
