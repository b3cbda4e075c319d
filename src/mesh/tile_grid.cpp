// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/tile_grid.hpp"

#include "trime/core/error.hpp"

#include <array>
#include <cmath>

namespace trime::mesh {
namespace {

constexpr double points_per_cell = 3.3;
constexpr double points_per_tile = 845; // 16 x 16 cells
constexpr double fewest_per_tile = 53;  // 4 x 4 cells
constexpr double wanted_tiles = 256, wanted_tiles_graded = 16384;
constexpr int max_cells = 1 << 28;

/// One step of the curve: the quadrant order is turned and mirrored so that pieces join end to end.
void rotate(std::uint32_t side, std::uint32_t& x, std::uint32_t& y, bool right, bool upper) {
  if (upper)
    return;
  if (right) {
    x = side - 1 - x;
    y = side - 1 - y;
  }
  std::swap(x, y);
}

/// Quadrants of the curve, and how the pieces in the last of them are turned: 1 stands for x and y exchanged, 2 for
/// both mirrored.
struct CurveStep {
  std::uint8_t key, turn;
};

constexpr CurveStep curve_step(unsigned x, unsigned y, unsigned turn) {
  const unsigned right = ((turn & 1) ? y : x) ^ (turn >> 1), upper = ((turn & 1) ? x : y) ^ (turn >> 1);
  const unsigned quadrant = right ? (upper ? 2 : 3) : upper;
  return {static_cast<std::uint8_t>(quadrant), static_cast<std::uint8_t>(upper ? turn : turn ^ (right ? 3U : 1U))};
}

/// Four steps at once, by turn and four bits of x and y each.
using FourSteps = std::array<std::array<CurveStep, 256>, 4>;
constexpr FourSteps make_four_steps() {
  FourSteps table{};
  for (unsigned turn = 0; turn < 4; ++turn)
    for (unsigned at = 0; at < 256; ++at) {
      unsigned key = 0, turned = turn;
      for (int bit = 3; bit >= 0; --bit) {
        const CurveStep step = curve_step((at >> (4 + bit)) & 1, (at >> bit) & 1, turned);
        key = (key << 2) | step.key;
        turned = step.turn;
      }
      table[turn][at] = {static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(turned)};
    }
  return table;
}
constexpr FourSteps four_steps = make_four_steps();

int curve_level(int tiles) {
  int level = 0;
  while ((1 << level) < tiles)
    ++level;
  return level;
}

int auto_cells(double extent, double spacing) {
  const double cell = std::sqrt(points_per_cell * 0.8660254037844386) * spacing;
  return static_cast<int>(std::clamp(std::floor(extent / cell), 1.0, static_cast<double>(max_cells)));
}

} // namespace

std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y, int level) {
  std::uint64_t key = 0;
  unsigned turn = 0;
  int bit = level;
  for (; bit % 4 != 0; --bit) {
    const CurveStep step = curve_step((x >> (bit - 1)) & 1, (y >> (bit - 1)) & 1, turn);
    key = (key << 2) | step.key;
    turn = step.turn;
  }
  for (; bit > 0; bit -= 4) {
    const CurveStep step = four_steps[turn][(((x >> (bit - 4)) & 15) << 4) | ((y >> (bit - 4)) & 15)];
    key = (key << 8) | step.key;
    turn = step.turn;
  }
  return key;
}

GridPosition hilbert_position(std::uint64_t key, int level) {
  std::uint32_t x = 0, y = 0;
  for (int bit = 0; bit < level; ++bit) {
    const unsigned quadrant = static_cast<unsigned>(key >> (2 * bit)) & 3;
    const bool right = quadrant >= 2, upper = quadrant == 1 || quadrant == 2;
    if (bit > 0)
      rotate(std::uint32_t{1} << bit, x, y, right, upper);
    x |= static_cast<std::uint32_t>(right) << bit;
    y |= static_cast<std::uint32_t>(upper) << bit;
  }
  return {x, y};
}

TileGrid::TileGrid(const geometry::Box& container, const GridOptions& options)
    : container_(container), periods_(options.periods) {
  TRIME_ASSERT(container.width() > 0 && container.height() > 0);
  cells_x_ = options.cells_x.value_or(auto_cells(container.width(), options.point_spacing));
  cells_y_ = options.cells_y.value_or(auto_cells(container.height(), options.point_spacing));
  const double cell_width = container.width() / cells_x_, cell_height = container.height() / cells_y_;
  const double density = 1 / (0.8660254037844386 * options.point_spacing * options.point_spacing);
  const double in_cell = density * cell_width * cell_height;

  // A tile is as large as a block of 2^k cells a side, or a little smaller, so that equal ones divide the container:
  // about 845 points, fewer where that would leave too few tiles to share out. With a density that varies, the densest
  // tiles hold up to a hundred times the mean.
  const double all_points = in_cell * cells_x_ * cells_y_;
  const double tiles_to_have = options.graded ? wanted_tiles_graded : wanted_tiles;
  const double wanted = std::clamp(all_points / tiles_to_have, fewest_per_tile, points_per_tile);
  int block_bits = 0;
  while (block_bits < 15 && in_cell * std::ldexp(1.0, 2 * (block_bits + 1)) <= 1.5 * wanted)
    ++block_bits;
  const int block = 1 << block_bits;
  tiles_x_ = (cells_x_ + block - 1) / block;
  tiles_y_ = (cells_y_ + block - 1) / block;
  tile_width_ = (periods_.x > 0 ? periods_.x : container.width()) / tiles_x_;
  tile_height_ = (periods_.y > 0 ? periods_.y : container.height()) / tiles_y_;
  const double in_tile = density * tile_width_ * tile_height_;
  // The nearest power of 4, from the exponent alone: a logarithm may round otherwise on other machines.
  typical_bin_bits_ = std::clamp((std::ilogb(std::max(1.0, in_tile / points_per_cell)) + 1) / 2, 0, 12);

  int level = std::max(curve_level(tiles_x_), curve_level(tiles_y_));
  tile_shift_ = 32 - level;
  if (level == 0) { // one tile: keep the shift below 32 by leaving the upper half of the square empty
    level = 1;
    tile_shift_ = 31;
  }
  typical_bin_bits_ = std::min(typical_bin_bits_, most_bin_bits());
  scale_x_ = std::ldexp(1.0, tile_shift_) / tile_width_;
  scale_y_ = std::ldexp(1.0, tile_shift_) / tile_height_;
  const auto limit = [&](int tiles) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(tiles) << tile_shift_) - 1);
  };
  limit_x_ = limit(tiles_x_);
  limit_y_ = limit(tiles_y_);
  // Parts of equally many tiles are compact then, and have equally much of the boundary.
  const auto offset = [](int tiles) { return static_cast<std::uint32_t>((1 << curve_level(tiles)) - tiles) / 2; };
  curve_offset_ = {offset(tiles_x_), offset(tiles_y_)};

  std::vector<std::pair<std::uint64_t, GridPosition>> order;
  order.reserve(static_cast<std::size_t>(tiles_x_) * tiles_y_);
  for (int y = 0; y < tiles_y_; ++y)
    for (int x = 0; x < tiles_x_; ++x) {
      const GridPosition at{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
      order.emplace_back(hilbert_key(at.x + curve_offset_.x, at.y + curve_offset_.y, level), at);
    }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  tile_number_.resize(order.size());
  tile_position_.reserve(order.size());
  for (const auto& [key, at] : order) {
    tile_number_[static_cast<std::size_t>(at.y) * tiles_x_ + at.x] = static_cast<LocalIndex>(tile_position_.size());
    tile_position_.push_back(at);
  }
  bin_bits_.assign(order.size(), static_cast<std::uint8_t>(typical_bin_bits_));
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
