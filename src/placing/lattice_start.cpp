// SPDX-License-Identifier: BSD-3-Clause
#include "placing/lattice_start.hpp"

#include "core/thread_loop.hpp"
#include "placing/rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trime::placing {

using geometry::Vec2;

namespace {

// [points asked for] See tolerated_stretch.
constexpr double tolerated_shortage = 0.002;

// [1] A lattice between two periods is stretched to fit them. A stretch of this much counts as bad as a shortage of
// tolerated_shortage when rows and columns are chosen.
constexpr double tolerated_stretch = 0.02;

constexpr double never = std::numeric_limits<double>::infinity();

struct Fit {
  std::int64_t columns = 0, rows = 0;
  double cost = never;
};

double square(double v) {
  return v * v;
}

Fit judge(std::int64_t columns, std::int64_t rows, double length, double width, double wanted) {
  const double m = static_cast<double>(columns), n = static_cast<double>(rows);
  const double stretch = (width / n) / (row_height * length / m) - 1;
  const double shear = rows % 2 == 0 ? 0 : 0.5 / n / row_height;
  const double shortage = std::fmax(0, wanted - m * n) / wanted;
  return {columns, rows,
          (square(stretch) + square(shear)) / square(tolerated_stretch) + square(shortage / tolerated_shortage)};
}

/// Best pair for rows of a `length`, as many as fit a `width`.
Fit best_fit(double length, double width, double spacing) {
  // A hair more, so that a lattice that fits exactly is not lost to rounding.
  const double wanted = length * width / (row_height * spacing * spacing) * (1 + 1e-9);
  const double ideal = length / spacing;
  const auto low = static_cast<std::int64_t>(std::fmax(1, std::floor(0.9 * ideal) - 2));
  const auto high = static_cast<std::int64_t>(std::ceil(1.1 * ideal) + 2);
  Fit best;
  for (std::int64_t columns = low; columns <= high; ++columns) {
    const auto rows = static_cast<std::int64_t>(wanted / static_cast<double>(columns));
    for (std::int64_t n = std::max<std::int64_t>(1, rows - 1); n <= rows; ++n)
      if (const Fit fit = judge(columns, n, length, width, wanted); fit.cost < best.cost)
        best = fit;
  }
  return best;
}

RowLattice make_lattice(const geometry::Periods& periods, const Fit& fit, Vec2 along) {
  const bool by_x = along.y == 0;
  const double length = by_x ? periods.x : periods.y, width = by_x ? periods.y : periods.x;
  if (fit.columns == 0)
    return {periods.min, along, 0, 0, 0, 0, 0};
  return {periods.min,
          along,
          length / static_cast<double>(fit.columns),
          width / static_cast<double>(fit.rows),
          fit.columns,
          fit.rows,
          fit.rows / 2};
}

} // namespace

RowLattice fit_to_periods(const geometry::Periods& periods, double spacing, Vec2 along) {
  const bool by_x = along.y == 0;
  const double length = by_x ? periods.x : periods.y, width = by_x ? periods.y : periods.x;
  if (width > 0)
    return make_lattice(periods, best_fit(length, width, spacing), along);
  if (spacing > length)
    return make_lattice(periods, {}, along);
  const double columns = std::round(length / spacing), fitted = length / columns;
  return {periods.min, along, fitted, row_height * spacing * spacing / fitted, static_cast<std::int64_t>(columns),
          0,           0};
}

RowLattice fit_to_periods(const geometry::Periods& periods, double spacing) {
  const Fit by_x = best_fit(periods.x, periods.y, spacing), by_y = best_fit(periods.y, periods.x, spacing);
  return by_y.cost < by_x.cost ? make_lattice(periods, by_y, {0, 1}) : make_lattice(periods, by_x, {1, 0});
}

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
                           const geometry::Lattice& lattice, const LoweredZones* zones)
    : guard_(guard), zones_(zones), lattice_(lattice), periods_(boundary.periods) {
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
  return guard_.distance(middle, reach) >= reach && guard_.inside(middle) &&
         !(zones_ && zones_->may_touch(middle, reach));
}

/// Columns of a periodic lattice are reduced to the first `columns`, so that all images of a site give one position.
Vec2 LatticeStart::site(const RowLattice& rows, std::int64_t row, std::int64_t column) const {
  const Vec2 start = rows.origin + (static_cast<double>(row) * rows.height) * geometry::left_normal(rows.along);
  const double along = (static_cast<double>(reduced(column, rows.columns)) + rows.shift(row)) * rows.spacing;
  return periods_.wrap(lattice_.snap(start + along * rows.along));
}

/// Inside, and not in the strip along the boundary.
bool LatticeStart::is_free(Vec2 p, double spacing) const {
  if (!guard_.inside(p) || (zones_ && zones_->hold(p)))
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
  if (guard_.distance_below(p, reach) < reach || (zones_ && zones_->may_touch(p, reach))) {
    add_row(rows, {row.row, row.first, middle - 1}, spacing, runs);
    add_row(rows, {row.row, middle, row.last}, spacing, runs);
  } else if (guard_.inside(p)) {
    add(row.first, row.last);
  }
}

namespace {

/// The box of a tile and a little more, and how far it reaches across the rows and along them.
struct TileReach {
  geometry::Box box;
  double low = INFINITY, high = -INFINITY, begin = INFINITY, end = -INFINITY;

  TileReach(const geometry::Box& tile, const RowLattice& rows, double margin)
      : box{tile.min - Vec2{margin, margin}, tile.max + Vec2{margin, margin}} {
    const Vec2 across = geometry::left_normal(rows.along);
    for (const Vec2 corner : {box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}}) {
      low = std::min(low, geometry::dot(corner - rows.origin, across));
      high = std::max(high, geometry::dot(corner - rows.origin, across));
      begin = std::min(begin, geometry::dot(corner - rows.origin, rows.along));
      end = std::max(end, geometry::dot(corner - rows.origin, rows.along));
    }
  }
};

} // namespace

/// The lattice sites of one tile, row by row. A site belongs to the tile of its snapped coordinates; rows and columns
/// reach a little beyond the tile's box, so rounding cannot lose any.
std::vector<LatticeRun> LatticeStart::runs_in(const mesh::TileGrid& grid, LocalIndex tile, const RowLattice& rows,
                                              double spacing) const {
  std::vector<LatticeRun> runs;
  const TileReach reach(grid.tile_box(tile), rows, 0.1 * spacing);
  const Vec2 across = geometry::left_normal(rows.along);
  const bool clear = is_clear(grid, tile, spacing);
  const auto first_row = static_cast<std::int64_t>(std::floor(reach.low / rows.height));
  for (std::int64_t j = first_row; j <= last_of(first_row, reach.high / rows.height, rows.rows); ++j) {
    const std::int64_t row = reduced(j, rows.rows);
    const Vec2 start = rows.origin + (static_cast<double>(row) * rows.height) * across;
    const double shift = rows.shift(row);
    const auto [first, last] =
        periods_.any() ? std::pair{reach.begin, reach.end} : clip_line(start, rows.along, reach.box);
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
