// SPDX-License-Identifier: BSD-3-Clause
// The wanted density of sites, h^-2 up to a factor, as integer weights of small cells along the Hilbert curve.
#pragma once

#include "trime/core/error.hpp"
#include "trime/core/sum.hpp"
#include "trime/meshing/start.hpp"

#include <cmath>
#include <cstdint>

namespace trime::meshing {

/// @brief Divides a tile into cells in Hilbert order: into quarters while a cell wants more than a quarter of a site,
/// or a sixteenth where the boundary is near; cells clear of the shape are left out whole. For a mere integral the
/// cells may be larger, `coarsening` times as wide. Immutable, thread-safe.
class DensitySampler {
public:
  static constexpr double weight_unit = 0x1p20; ///< integer weight of one site
  static constexpr double strip = 0.43;         ///< of h along the boundary stays free of sites

  DensitySampler(const mesh::TileGrid& grid, const BoundaryGuard& guard, const sizing::SizeField& size,
                 const geometry::Lattice& lattice, double coarsening = 1)
      : grid_(grid), guard_(guard), size_(size), lattice_(lattice), most_inside_(0.25 * coarsening * coarsening),
        most_near_(0.0625 * coarsening * coarsening) {}

  /// A leaf with a weight; `key` and `level` name it within its tile.
  struct Cell {
    geometry::Box box;
    std::uint64_t key;
    int level;
    double size;         ///< h in its middle
    std::int64_t weight; ///< sites that belong into it, in units of 2^-20
  };
  /// Calls visit(cell) for all cells of the tile with a weight, in Hilbert order.
  /// @throws GeometryError on this rank alone: at a place in the shape the size is not positive and finite, or so small
  /// that the tile would get more than 2^27 cells
  template <class Visit>
  void for_each_cell(LocalIndex tile, const Visit& visit) const {
    std::int64_t cells = 0;
    divide({grid_.tile_box(tile), 0, 0, false}, visit, cells);
  }

private:
  static constexpr int most_levels = 24;
  static constexpr double most_in_smallest = 64; // sites
  static constexpr std::int64_t most_cells = 1 << 27;

  /// Every bin is looked into, wherever its tile's middle lies: sizes may jump.
  int least_levels() const { return grid_.typical_bin_bits() + 1; }

  struct Part {
    geometry::Box box;
    std::uint64_t key;
    int level;
    bool clear; ///< a larger part around it is clear of the boundary and its strip, and inside
  };

  template <class Visit>
  void divide(const Part& part, const Visit& visit, std::int64_t& cells) const {
    const geometry::Box& box = part.box;
    const geometry::Vec2 p = lattice_.snap(0.5 * (box.min + box.max));
    const double h = size_.size(p);
    const bool valid = sizing::is_valid_size(h);
    const bool inside = part.clear || guard_.inside(p);
    if (!valid && inside && grid_.container().contains(p))
      sizing::fail_for_size(p, h);
    const double free = valid && inside ? strip * h : 0; // outside the shape any value will do
    double distance = INFINITY;
    bool clear = part.clear;
    if (!clear) {
      const double reach = 0.5 * std::hypot(box.width(), box.height()) + free;
      distance = guard_.distance(p, reach);
      clear = distance >= reach;
      if (clear && !inside)
        return;
    }
    const double sites = valid ? box.width() * box.height() / (row_height * h * h) : 0;
    if (++cells > most_cells || (part.level == most_levels && sites > most_in_smallest))
      fail_for_small_size(p, h);
    if (part.level < most_levels && (part.level < least_levels() || sites > (clear ? most_inside_ : most_near_))) {
      for (std::uint64_t quarter = 0; quarter < 4; ++quarter)
        divide({quarter_of(box, part.key, part.level, quarter), 4 * part.key + quarter, part.level + 1, clear}, visit,
               cells);
      return;
    }
    if (!clear && (distance < free || !inside))
      return;
    if (grid_.container().contains(p))
      visit(Cell{box, part.key, part.level, h, std::llround(weight_unit * sites)});
  }

  [[noreturn]] static void fail_for_small_size(geometry::Vec2 p, double h) {
    throw GeometryError(fmt::format("the size near ({}, {}) is {}: so small a size asks for far more points than there "
                                    "can be; give the size field a larger least value, or set min_size",
                                    p.x, p.y, h));
  }

  static geometry::Box quarter_of(const geometry::Box& box, std::uint64_t key, int level, std::uint64_t quarter) {
    const mesh::GridPosition at = mesh::hilbert_position(4 * key + quarter, level + 1);
    const geometry::Vec2 middle = 0.5 * (box.min + box.max);
    return {{at.x & 1 ? middle.x : box.min.x, at.y & 1 ? middle.y : box.min.y},
            {at.x & 1 ? box.max.x : middle.x, at.y & 1 ? box.max.y : middle.y}};
  }

  static constexpr double row_height = 0.8660254037844386; // of a hexagonal lattice of spacing 1

  const mesh::TileGrid& grid_;
  const BoundaryGuard& guard_;
  const sizing::SizeField& size_;
  const geometry::Lattice& lattice_;
  double most_inside_, most_near_; // sites in a leaf
};

/// Sums over the cells of all tiles.
struct DensityTotals {
  double sites = 0;     ///< inner sites that the size field asks for
  double mean_size = 0; ///< mean of h over these sites
};
/// Collective. Threads over the tiles of this rank; integers inside.
/// @throws GeometryError as DensitySampler::for_each_cell, on all ranks together
DensityTotals integrate_density(const comm::Communicator& comm, const TileRange& tiles, const DensitySampler& sampler);

} // namespace trime::meshing
