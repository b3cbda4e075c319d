// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/tile_grid.hpp"

#include "core/angle.hpp"
#include "mesh/rules.hpp"
#include "trime/core/error.hpp"

#include <cmath>

namespace trime::mesh {
namespace {

constexpr int max_cells = 1 << 28;

int curve_level(int tiles) {
  int level = 0;
  while ((1 << level) < tiles)
    ++level;
  return level;
}

int auto_cells(double extent, double spacing) {
  const double cell = std::sqrt(MeshRules::points_per_cell * row_height) * spacing;
  return static_cast<int>(std::clamp(std::floor(extent / cell), 1.0, static_cast<double>(max_cells)));
}

/// Columns and rows of the tiles in the order of the curve. @param offset of the first tile in its square
std::vector<GridPosition> tiles_along_curve(int tiles_x, int tiles_y, GridPosition offset, int level) {
  std::vector<std::pair<std::uint64_t, GridPosition>> order;
  order.reserve(static_cast<std::size_t>(tiles_x) * static_cast<std::size_t>(tiles_y));
  for (int y = 0; y < tiles_y; ++y)
    for (int x = 0; x < tiles_x; ++x) {
      const GridPosition tile{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
      order.emplace_back(hilbert_key(tile.x + offset.x, tile.y + offset.y, level), tile);
    }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<GridPosition> tiles;
  tiles.reserve(order.size());
  for (const auto& [key, tile] : order)
    tiles.push_back(tile);
  return tiles;
}

} // namespace

TileGrid::TileGrid(const geometry::Box& container, const GridOptions& options)
    : container_(container), periods_(options.periods) {
  TRIME_ASSERT(container.width() > 0 && container.height() > 0);
  cells_x_ = options.cells_x.value_or(auto_cells(container.width(), options.point_spacing));
  cells_y_ = options.cells_y.value_or(auto_cells(container.height(), options.point_spacing));
  choose_tiles(options);
  set_fixed_point();
  tile_position_ = tiles_along_curve(tiles_x_, tiles_y_, curve_offset_, curve_level_);
  tile_number_.resize(tile_position_.size());
  for (LocalIndex tile = 0; tile < tile_count(); ++tile) {
    const GridPosition place = tile_position(tile);
    tile_number_[static_cast<std::size_t>(place.y) * tiles_x_ + place.x] = tile;
  }
  bin_bits_.assign(tile_position_.size(), static_cast<std::uint8_t>(typical_bin_bits_));
}

/// A tile is as large as a block of 2^k cells a side, or a little smaller, so that equal ones divide the container.
void TileGrid::choose_tiles(const GridOptions& options) {
  const double cell_width = container_.width() / cells_x_, cell_height = container_.height() / cells_y_;
  const double density = 1 / (row_height * options.point_spacing * options.point_spacing);
  const double in_cell = density * cell_width * cell_height;
  const double all_points = in_cell * cells_x_ * cells_y_;
  const double tiles_to_have = options.graded ? MeshRules::wanted_tiles_graded : MeshRules::wanted_tiles;
  const double wanted = std::clamp(all_points / tiles_to_have, MeshRules::fewest_per_tile, MeshRules::points_per_tile);
  int block_bits = 0;
  while (block_bits < 15 && in_cell * std::ldexp(1.0, 2 * (block_bits + 1)) <= MeshRules::fullest_tile * wanted)
    ++block_bits;
  const int block = 1 << block_bits;
  tiles_x_ = (cells_x_ + block - 1) / block;
  tiles_y_ = (cells_y_ + block - 1) / block;
  tile_width_ = (periods_.x > 0 ? periods_.x : container_.width()) / tiles_x_;
  tile_height_ = (periods_.y > 0 ? periods_.y : container_.height()) / tiles_y_;
  const double in_tile = density * tile_width_ * tile_height_;
  // The nearest power of 4, from the exponent alone: a logarithm may round otherwise on other machines.
  typical_bin_bits_ = std::clamp((std::ilogb(std::max(1.0, in_tile / MeshRules::points_per_cell)) + 1) / 2, 0,
                                 MeshRules::finest_bin_bits);
}

/// From coordinates to fixed-point positions, and where the tiles lie in the square of the curve.
void TileGrid::set_fixed_point() {
  const int level = std::max(curve_level(tiles_x_), curve_level(tiles_y_));
  curve_level_ = std::max(1, level); // one tile: the shift stays below 32, three quarters of the square stay empty
  tile_shift_ = 32 - curve_level_;
  typical_bin_bits_ = std::min(typical_bin_bits_, most_bin_bits());
  x_axis_ = {container_.min.x, tile_width_, tiles_x_, tile_shift_, periods_.x > 0};
  y_axis_ = {container_.min.y, tile_height_, tiles_y_, tile_shift_, periods_.y > 0};
  // Parts of equally many tiles are compact then, and have equally much of the boundary.
  const auto offset = [](int tiles) { return static_cast<std::uint32_t>((1 << curve_level(tiles)) - tiles) / 2; };
  curve_offset_ = {offset(tiles_x_), offset(tiles_y_)};
}

void TileGrid::set_bin_bits(std::vector<std::uint8_t> bits) {
  TRIME_ASSERT(static_cast<LocalIndex>(bits.size()) == tile_count());
  bin_bits_ = std::move(bits);
}

geometry::Box TileGrid::tile_box(LocalIndex tile) const {
  const GridPosition at = tile_position(tile);
  return {{container_.min.x + at.x * tile_width_, container_.min.y + at.y * tile_height_},
          {container_.min.x + (at.x + 1) * tile_width_, container_.min.y + (at.y + 1) * tile_height_}};
}

} // namespace trime::mesh
