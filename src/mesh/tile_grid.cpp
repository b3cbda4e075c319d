// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/tile_grid.hpp"

#include "core/angle.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trime::mesh {
namespace {

constexpr int max_cells = 1 << 28;

int auto_cells(double extent, double spacing) {
  const double cell = std::sqrt(MeshRules::points_per_cell * row_height) * spacing;
  return static_cast<int>(std::clamp(std::floor(extent / cell), 1.0, static_cast<double>(max_cells)));
}

} // namespace

TileGrid::TileGrid(const geometry::Box& container, const GridOptions& options)
    : container_(container), periods_(options.periods) {
  TRIME_ASSERT(container.width() > 0 && container.height() > 0);
  cells_x_ = options.cells_x.value_or(auto_cells(container.width(), options.point_spacing));
  cells_y_ = options.cells_y.value_or(auto_cells(container.height(), options.point_spacing));
  set_axes();
  choose_typical(options.point_spacing);
  std::vector<Tile> tiles;
  add_tiles({}, tiles);
  set_tiles(std::move(tiles));
}

/// The longer side of the container is that of the curve's square. The shorter one has a number of nearly square units,
/// in the middle of a power of two of them. So halves and quarters of its curve are halves and quarters of the
/// container, and the container is not cut along its length.
void TileGrid::set_axes() {
  const double width = periods_.x > 0 ? periods_.x : container_.width(),
               height = periods_.y > 0 ? periods_.y : container_.height();
  const double ratio = std::min(width, height) / std::max(width, height);
  while (unit_level_ < MeshRules::finest_unit_level &&
         std::ldexp(ratio, unit_level_) < static_cast<double>(MeshRules::units_across))
    ++unit_level_;
  const auto longer = std::uint32_t{1} << unit_level_;
  const auto shorter = static_cast<std::uint32_t>(std::max(1L, std::lround(std::ldexp(ratio, unit_level_))));
  std::uint32_t power = 1;
  while (power < shorter)
    power *= 2;
  const auto axis = [&](double start, double extent, bool is_longer, bool periodic) {
    const std::uint32_t units = is_longer ? longer : shorter, first = is_longer ? 0 : (power - shorter) / 2;
    return FixedAxis(start, extent / units, first, units, 32 - unit_level_, periodic);
  };
  x_axis_ = axis(container_.min.x, width, width >= height, periods_.x > 0);
  y_axis_ = axis(container_.min.y, height, width<height, periods_.y> 0);
}

/// The largest tiles that do not hold too many points of the typical density, and their bins.
void TileGrid::choose_typical(double spacing) {
  const double density = 1 / (row_height * spacing * spacing);
  expected_points_ = density * container_.width() * container_.height();
  const geometry::Box unit =
      box_of(FixedRect{0, 0, (std::int64_t{1} << (32 - unit_level_)) - 1, (std::int64_t{1} << (32 - unit_level_)) - 1});
  const auto points_at = [&](int level) {
    return std::ldexp(density * unit.width() * unit.height(), 2 * (unit_level_ - level));
  };
  const double most = static_cast<double>(most_per_tile(expected_points_));
  while (typical_level_ < MeshRules::finest_typical_level && points_at(typical_level_) > most)
    ++typical_level_;
  // The nearest power of 4, from the exponent alone: a logarithm may round otherwise on other machines.
  typical_bin_bits_ =
      std::clamp((std::ilogb(std::max(1.0, points_at(typical_level_) / MeshRules::points_per_cell)) + 1) / 2, 0,
                 std::min(MeshRules::finest_bin_bits, 32 - typical_level_));
}

/// All tiles of the typical level in a square.
void TileGrid::add_tiles(const CurveSquare& square, std::vector<Tile>& tiles) const {
  if (square.level == typical_level_) {
    tiles.push_back(mesh::tile_of(square, typical_bin_bits_));
    return;
  }
  for (const CurveSquare& quarter : quarters(square))
    add_tiles(quarter, tiles);
}

std::vector<CurveSquare> TileGrid::quarters(const CurveSquare& square) const {
  std::vector<CurveSquare> all;
  for (unsigned k = 0; k < 4; ++k)
    if (const CurveSquare quarter = square.quarter(k); limits().meets(rect_of(mesh::tile_of(quarter, 0))))
      all.push_back(quarter);
  return all;
}

void TileGrid::set_tiles(std::vector<Tile> tiles) {
  tree_ = TileTree(limits(), std::move(tiles));
}

void TileGrid::set_bin_bits(const std::vector<std::uint8_t>& bits) {
  TRIME_ASSERT(static_cast<LocalIndex>(bits.size()) == tile_count());
  for (LocalIndex tile = 0; tile < tile_count(); ++tile)
    tree_.set_bits(tile, bits[at(tile)]);
}

geometry::Vec2 TileGrid::nearest_in(LocalIndex tile, geometry::Vec2 p) const {
  const FixedRect rect = rect_of(tree_[tile]);
  const std::int64_t x = std::clamp<std::int64_t>(x_axis_.fixed(p.x), rect.x0, rect.x1),
                     y = std::clamp<std::int64_t>(y_axis_.fixed(p.y), rect.y0, rect.y1);
  return 0.5 * (geometry::Vec2{x_axis_.coordinate(x), y_axis_.coordinate(y)} +
                geometry::Vec2{x_axis_.coordinate(x + 1), y_axis_.coordinate(y + 1)});
}

double TileGrid::side_of(LocalIndex tile) const {
  const geometry::Box box = tile_box(tile);
  return std::min(box.width(), box.height());
}

namespace {

class Fit {
public:
  Fit(const TileGrid& grid, std::span<const std::int64_t> weights, std::int64_t most)
      : grid_(grid), most_(most), before_(weights.size() + 1, 0) {
    std::partial_sum(weights.begin(), weights.end(), before_.begin() + 1);
  }

  /// The tiles [first, last) fill a square.
  void visit(const CurveSquare& square, LocalIndex first, LocalIndex last) {
    const std::int64_t weight = before_[at(last)] - before_[at(first)];
    const bool is_tile = last - first == 1 && grid_.tile(first).level() == square.level;
    if (square.level > 0 && (weight <= most_ || (is_tile && square.level >= MeshRules::finest_tile_level))) {
      const int bits = is_tile ? grid_.tile(first).bits : std::min(grid_.typical_bin_bits(), 32 - square.level);
      fit_.tiles.push_back(tile_of(square, bits));
      fit_.weights.push_back(weight);
    } else if (is_tile) {
      divide(square, weight);
    } else {
      for (const CurveSquare& quarter : grid_.quarters(square)) {
        const LocalIndex next = end_in(quarter, first, last);
        visit(quarter, first, next);
        first = next;
      }
    }
  }
  WeightedTiles result() { return std::move(fit_); }

private:
  /// How far the tiles of a quarter go, which come first: by their places, since a key on the curve takes longer.
  LocalIndex end_in(const CurveSquare& quarter, LocalIndex first, LocalIndex last) const {
    const int shift = 32 - quarter.level;
    const auto begin = grid_.tiles().begin();
    const auto end = std::partition_point(begin + first, begin + last, [&](const Tile& tile) {
      return tile.x >> shift == quarter.x && tile.y >> shift == quarter.y;
    });
    return static_cast<LocalIndex>(end - begin);
  }
  /// Deeper at once where a tile is far too heavy: what is too light joins again.
  void divide(const CurveSquare& square, std::int64_t weight) {
    fit_.divided = true;
    for (const CurveSquare& quarter : grid_.quarters(square))
      if (weight > 16 * most_ && quarter.level < MeshRules::finest_tile_level) {
        divide(quarter, weight / 4);
      } else {
        fit_.tiles.push_back(tile_of(quarter, std::min(grid_.typical_bin_bits(), 32 - quarter.level)));
        fit_.weights.push_back(0);
      }
  }

  const TileGrid& grid_;
  std::int64_t most_;
  std::vector<std::int64_t> before_; // weights of the tiles before each; all of them
  WeightedTiles fit_;
};

} // namespace

std::int64_t most_per_tile(double points) {
  const double few =
      std::clamp(points / MeshRules::wanted_tiles, MeshRules::fewest_per_tile, MeshRules::points_per_tile);
  return static_cast<std::int64_t>(std::max(few, std::min(points / MeshRules::many_tiles, MeshRules::most_per_tile)));
}

WeightedTiles fit_tiles(const TileGrid& grid, std::span<const std::int64_t> weights, std::int64_t most) {
  Fit fit(grid, weights, most);
  fit.visit({}, 0, grid.tile_count());
  return fit.result();
}

} // namespace trime::mesh
