// SPDX-License-Identifier: BSD-3-Clause
#include "placing/lattice_start.hpp"

#include "core/thread_loop.hpp"
#include "placing/row_lattice.hpp"
#include "placing/rules.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::placing {
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

/// The least and the largest coordinate of a box in a direction.
std::pair<double, double> extent_along(Vec2 direction, Vec2 origin, const geometry::Box& box) {
  double least = INFINITY, largest = -INFINITY;
  for (const Vec2 corner : {box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}}) {
    least = std::min(least, geometry::dot(corner - origin, direction));
    largest = std::max(largest, geometry::dot(corner - origin, direction));
  }
  return {least, largest};
}

/// The last row or column from `first` on up to a limit, and no more than one period of them.
std::int64_t last_of(std::int64_t first, double limit, std::int64_t period) {
  const auto last = static_cast<std::int64_t>(std::ceil(limit));
  return period > 0 ? std::min(last, first + period - 1) : last;
}

/// Into the first period, if there is one.
std::int64_t reduced(std::int64_t k, std::int64_t period) {
  return period > 0 ? (k % period + period) % period : k;
}

std::int64_t count_of(const std::vector<LatticeRun>& runs) {
  std::int64_t n = 0;
  for (const LatticeRun& run : runs)
    n += run.last - run.first + 1;
  return n;
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

/// Columns of a periodic lattice are reduced to the first `columns`, so that all images of a site give one position.
Vec2 LatticeStart::site(const RowLattice& rows, std::int64_t row, std::int64_t column) const {
  const Vec2 start = rows.origin + (static_cast<double>(row) * rows.height) * geometry::left_normal(rows.along);
  const double along = (static_cast<double>(reduced(column, rows.columns)) + rows.shift(row)) * rows.spacing;
  return periods_.wrap(lattice_.snap(start + along * rows.along));
}

/// Inside, and not in the strip along the boundary.
bool LatticeStart::is_free(Vec2 p, double spacing) const {
  if (!guard_.inside(p))
    return false;
  const double free = PlacingRules::lattice_strip * spacing;
  // Where even the lower bound is far enough, no disc is near: one look-up does for nearly all.
  return guard_.distance_below(p, free) >= free || (guard_.distance(p, free) >= free && !guard_.encroaches(p));
}

/// Adds what is free of a run to the others of its row. Halves of it that are clear of the boundary are in or out as a
/// whole.
void LatticeStart::add_row(const RowLattice& rows, LatticeRun row, double spacing,
                           std::vector<LatticeRun>& runs) const {
  const auto add = [&](std::int64_t first, std::int64_t last) {
    if (!runs.empty() && runs.back().row == row.row && runs.back().last + 1 == first)
      runs.back().last = last;
    else
      runs.push_back({row.row, first, last});
  };
  const std::int64_t sites = row.last - row.first + 1;
  if (periods_.any() || sites <= PlacingRules::shortest_half) {
    for (std::int64_t column = row.first; column <= row.last; ++column)
      if (is_free(site(rows, row.row, column), spacing))
        add(column, column);
    return;
  }
  const std::int64_t middle = row.first + sites / 2;
  const Vec2 p = site(rows, row.row, middle);
  const double reach = (static_cast<double>(sites / 2) + 2) * spacing;
  if (guard_.distance_below(p, reach) < reach) {
    add_row(rows, {row.row, row.first, middle - 1}, spacing, runs);
    add_row(rows, {row.row, middle, row.last}, spacing, runs);
  } else if (guard_.inside(p)) {
    add(row.first, row.last);
  }
}

/// The lattice sites of one tile, row by row. A site belongs to the tile of its snapped coordinates; rows and columns
/// reach a little beyond the tile's box, so rounding cannot lose any.
std::vector<LatticeRun> LatticeStart::runs_in(const mesh::TileGrid& grid, LocalIndex tile, const RowLattice& rows,
                                              double spacing) const {
  std::vector<LatticeRun> runs;
  geometry::Box box = grid.tile_box(tile);
  box = {box.min - Vec2{0.1 * spacing, 0.1 * spacing}, box.max + Vec2{0.1 * spacing, 0.1 * spacing}};
  const Vec2 across = geometry::left_normal(rows.along);
  const auto [low, high] = extent_along(across, rows.origin, box);
  const auto [begin, end] = extent_along(rows.along, rows.origin, box);
  const bool clear = is_clear(grid, tile, spacing);
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
    const auto in_tile = [&](std::int64_t i) {
      const Vec2 p = site(rows, row, i);
      return grid.container().contains(p) && grid.place(p).tile == tile;
    };
    if (periods_.any()) { // a row may come into the tile again
      for (; column <= last_column; ++column)
        if (in_tile(column))
          add_row(rows, {row, column, column}, spacing, runs);
      continue;
    }
    while (column <= last_column && !in_tile(column))
      ++column;
    while (column < last_column && !in_tile(last_column))
      --last_column;
    if (column <= last_column && clear)
      runs.push_back({row, column, last_column});
    else if (column <= last_column)
      add_row(rows, {row, column, last_column}, spacing, runs);
  }
  return runs;
}

LatticeRuns LatticeStart::runs(const mesh::TileRange& tiles, double spacing) const {
  LatticeRuns all{spacing, {}};
  all.of_tile.resize(static_cast<std::size_t>(tiles.last - tiles.first));
  const RowLattice rows = rows_of(spacing);
  if (!(rows.spacing > 0))
    return all;
  thread_loop(tiles.last - tiles.first, 1, [&](std::ptrdiff_t t, int) {
    all.of_tile[static_cast<std::size_t>(t)] =
        runs_in(tiles.grid, tiles.first + static_cast<LocalIndex>(t), rows, spacing);
  });
  return all;
}

mesh::SiteList LatticeStart::sites(const LatticeRuns& runs, std::size_t more) const {
  const RowLattice rows = rows_of(runs.spacing);
  std::vector<std::int64_t> before;
  std::int64_t n = 0;
  for (const std::vector<LatticeRun>& of_tile : runs.of_tile) {
    before.push_back(n);
    n += count_of(of_tile);
  }
  mesh::SiteList all;
  all.reserve(static_cast<std::size_t>(n) + more);
  all.resize(static_cast<std::size_t>(n));
  thread_loop(std::ssize(before), 1, [&](std::ptrdiff_t t, int) {
    auto to = all.begin() + static_cast<std::ptrdiff_t>(before[static_cast<std::size_t>(t)]);
    for (const LatticeRun& run : runs.of_tile[static_cast<std::size_t>(t)])
      for (std::int64_t column = run.first; column <= run.last; ++column, ++to)
        *to = {site(rows, run.row, column)};
  });
  return all;
}

std::int64_t LatticeRuns::count() const {
  std::int64_t n = 0;
  for (const std::vector<LatticeRun>& runs : of_tile)
    n += count_of(runs);
  return n;
}

std::vector<std::int64_t> LatticeRuns::counts() const {
  std::vector<std::int64_t> counts;
  counts.reserve(of_tile.size());
  for (const std::vector<LatticeRun>& runs : of_tile)
    counts.push_back(count_of(runs));
  return counts;
}

} // namespace trime::placing
