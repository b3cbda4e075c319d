// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/tile_fit.hpp"

#include <algorithm>
#include <numeric>

namespace trime::mesh {
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
