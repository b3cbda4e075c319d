// SPDX-License-Identifier: BSD-3-Clause
// Samples the wanted density of sites, which is proportional to h^-2, as integer weights of small cells along the
// Hilbert curve.
#pragma once

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "core/hilbert.hpp"
#include "core/thread_loop.hpp"
#include "mesh/tile_grid.hpp"
#include "placing/lowered_zones.hpp"
#include "placing/rules.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/core/error.hpp"
#include "trime/core/sum.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::placing {

/// @brief Divides a tile into cells in the order of the Hilbert curve. A cell is divided into quarters while its weight
/// is more than a quarter of a site, or more than a sixteenth near the boundary. Cells that do not touch the shape are
/// left out. If only the integral of the density is needed, cells may be `coarsening` times as wide. Cells are squares
/// of the quadtree of the grid. The cells do not depend on the tiles, as long as no tile is smaller than a cell.
/// Immutable, thread-safe.
class DensitySampler {
public:
  static constexpr double weight_unit = 0x1p20; ///< the integer weight that stands for one site

  /// @param most_in_part [sites] the sampling of a part of a tile ends when it has this weight
  /// @param zones cells outside of these zones are left out; null: none are
  DensitySampler(const mesh::TileGrid& grid, const polygon::BoundaryGuard& guard, const sizing::SizeField& size,
                 const geometry::Lattice& lattice, double coarsening = 1, double most_in_part = INFINITY,
                 const LoweredZones* zones = nullptr)
      : grid_(grid), guard_(guard), size_(size), zones_(zones), lattice_(lattice),
        most_inside_(PlacingRules::sites_in_cell * coarsening * coarsening),
        most_near_(PlacingRules::sites_in_cell_near * coarsening * coarsening), most_in_part_(most_in_part) {}

  /// A cell that is not divided, with its weight.
  struct Cell {
    geometry::Box box;
    std::uint64_t key; ///< identifies the cell among cells of its level
    int level;
    double size;         ///< target edge length h at the centre of the cell
    std::int64_t weight; ///< number of sites that belong into the cell, in units of 2^-20
  };
  /// Number of parts of a tile that threads sample separately, because there may be fewer tiles than threads.
  static constexpr int parts_per_tile() { return 1 << (2 * part_levels); }
  /// Calls visit(cell) for all cells with a weight in a part of the tile, in the order of the Hilbert curve. The parts
  /// have this order, too.
  /// @throws GeometryError on this rank alone, if the size at a place in the shape is not positive and finite, or so
  /// small that the part would have more than 2^27 cells
  template <class Visit>
  void for_each_cell(LocalIndex tile, int part, const Visit& visit) const {
    CurveSquare square = grid_.tile(tile).on_curve();
    for (int level = part_levels - 1; level >= 0; --level)
      square = square.quarter(static_cast<unsigned>(part) >> (2 * level) & 3U);
    Work work;
    const geometry::Box box = grid_.box_of(square);
    divide({square, box, false, {}, size_.size(middle(box)), {}}, visit, work);
  }

private:
  static constexpr int part_levels = 1; // number of quadtree levels between a tile and its parts
  /// Returns the coarsest level of cells. This level is fine enough to sample every bin of the typical density, because
  /// sizes may jump, and no cell of this level lies partly outside of the container.
  int least_level() const {
    return std::max({grid_.unit_level(), grid_.typical_level() + grid_.typical_bin_bits() + 1,
                     grid_.typical_level() + part_levels});
  }

  /// The boundary edges (chords) nearer to a part than `reach`, as a range of Work::chords. A negative `reach` means
  /// that they are not known.
  struct NearChords {
    std::size_t first = 0, last = 0;
    double reach = -1;
  };
  /// The sizes at the middles of the quarters of a part, of their quarters, and so on, as a range of Work::sizes. Each
  /// quarter has its own size and then the sizes below it.
  struct SizesBelow {
    std::size_t first = 0;
    int levels = 0; ///< number of levels of quarters
    static constexpr std::size_t count(int levels) { return ((std::size_t{4} << (2 * levels)) - 4) / 3; }
    /// Returns where the size of a quarter is. @pre levels > 0
    std::size_t place_of(unsigned quarter) const { return first + quarter * (1 + count(levels - 1)); }
  };
  struct Part {
    CurveSquare square;
    geometry::Box box;
    bool clear; ///< whether a larger part around this one lies inside the shape and does not touch the boundary or the
                ///< strip along it (PlacingRules::density_strip)
    NearChords near; ///< chords near the part that was divided to give this one
    double size;     ///< at the middle
    SizesBelow below;
  };
  struct Work {
    std::int64_t cells = 0;
    double sites = 0;          ///< weight in sites of the cells in the container so far
    std::vector<double> sizes; ///< a stack: the sizes below a part lie above those of the larger parts around it
    std::vector<LocalIndex>
        chords; ///< a stack: the chords near a part lie above the chords near the larger parts around it
  };

  geometry::Vec2 middle(const geometry::Box& box) const { return lattice_.snap(0.5 * (box.min + box.max)); }

  /// Returns in how many levels below a part with this weight sizes are needed, if h changes little.
  /// @pre the part is divided
  int levels_below(const Part& part, double sites) const {
    const int most = std::min(PlacingRules::most_levels_together, PlacingRules::deepest_cell - part.square.level);
    int levels = std::clamp(least_level() - part.square.level, 1, most);
    const double enough = part.clear ? most_inside_ : most_near_;
    for (double left = std::ldexp(sites, -2 * levels); left > enough && levels < most; left *= 0.25)
      ++levels;
    return levels;
  }

  void list_middles(const CurveSquare& square, int levels, std::vector<geometry::Vec2>& places) const {
    for (unsigned k = 0; k < 4 && levels > 0; ++k) {
      places.push_back(middle(grid_.box_of(square.quarter(k))));
      list_middles(square.quarter(k), levels - 1, places);
    }
  }

  /// Asks for the sizes in some levels below a part, all at once.
  SizesBelow find_sizes(const CurveSquare& square, int levels, Work& work) const {
    std::vector<geometry::Vec2> places;
    places.reserve(SizesBelow::count(levels));
    list_middles(square, levels, places);
    const std::size_t first = work.sizes.size();
    work.sizes.resize(first + places.size());
    size_.sizes(places, std::span(work.sizes).subspan(first));
    return {first, levels};
  }

  static double half_diagonal(const geometry::Box& box) {
    return 0.5 * std::sqrt(box.width() * box.width() + box.height() * box.height());
  }

  /// @brief Returns the distance from the centre p of a part to the nearest chord, at most half of its diagonal plus
  /// `free`. Stores the chords that its quarters need in part.near.
  double distance(Part& part, geometry::Vec2 p, double free, Work& work) const {
    const double half = half_diagonal(part.box), reach = half + free;
    const double far = guard_.distance_below(p, reach);
    if (far >= reach)
      return far;
    if (part.near.reach < free)
      part.near = collect(part.box, 2 * free, work);
    if (part.near.reach < free)
      return guard_.distance(p, reach);
    const NearChords outer = part.near;
    const double limit = (half + outer.reach) * (1 + 1e-9);
    double nearest = reach * reach;
    part.near.first = work.chords.size();
    for (std::size_t k = outer.first; k < outer.last; ++k) {
      const LocalIndex chord = work.chords[k];
      const double squared = geometry::squared_distance(p, guard_.chords().segments()[static_cast<std::size_t>(chord)]);
      nearest = std::min(nearest, squared);
      if (squared <= limit * limit)
        work.chords.push_back(chord);
    }
    part.near.last = work.chords.size();
    return nearest < reach * reach ? std::sqrt(nearest) : reach;
  }

  /// Returns the chords in the search structure, if they are few. In a periodic container nothing is returned, because
  /// the guard also knows the periodic images.
  NearChords collect(const geometry::Box& box, double reach, Work& work) const {
    const geometry::Vec2 margin{reach * (1 + 1e-9), reach * (1 + 1e-9)};
    if (grid_.periods().any())
      return {};
    const std::size_t first = work.chords.size();
    guard_.chords().for_each_near({box.min - margin, box.max + margin}, [&](LocalIndex chord) {
      work.chords.push_back(chord);
      return work.chords.size() < first + 2 * PlacingRules::most_near_chords;
    });
    const auto begin = work.chords.begin() + static_cast<std::ptrdiff_t>(first);
    const bool all = work.chords.size() < first + 2 * PlacingRules::most_near_chords;
    std::sort(begin, work.chords.end());
    work.chords.erase(std::unique(begin, work.chords.end()), work.chords.end());
    if (all && work.chords.size() <= first + PlacingRules::most_near_chords)
      return {first, work.chords.size(), reach};
    work.chords.resize(first);
    return {};
  }

  template <class Visit>
  void divide(Part part, const Visit& visit, Work& work) const {
    if (work.sites > most_in_part_)
      return;
    const geometry::Box& box = part.box;
    const std::size_t chords_before = work.chords.size();
    const geometry::Vec2 p = middle(box);
    if (zones_ && !zones_->may_touch(p, half_diagonal(box)))
      return;
    const double h = part.size;
    const bool valid = sizing::is_valid_size(h);
    const bool inside = part.clear || guard_.inside(p);
    if (!valid && inside && grid_.container().contains(p))
      sizing::fail_for_size(p, h);
    const double free = valid && inside ? PlacingRules::density_strip * h : 0; // not used outside of the shape
    double to_boundary = INFINITY;
    bool clear = part.clear;
    if (!clear) {
      to_boundary = distance(part, p, free, work);
      clear = to_boundary >= half_diagonal(box) + free;
      if (clear && !inside)
        return work.chords.resize(chords_before);
    }
    const double sites = valid ? box.width() * box.height() / (row_height * h * h) : 0;
    if (++work.cells > PlacingRules::most_density_cells ||
        (part.square.level == PlacingRules::deepest_cell && sites > PlacingRules::most_in_deepest))
      fail_for_small_size(p, h);
    if (part.square.level < PlacingRules::deepest_cell &&
        (part.square.level < least_level() || sites > (clear ? most_inside_ : most_near_))) {
      part.clear = clear;
      divide_quarters(part, sites, visit, work);
      return work.chords.resize(chords_before);
    }
    work.chords.resize(chords_before);
    if (!clear && (to_boundary < free || !inside))
      return;
    if (!grid_.container().contains(p) || (zones_ && !zones_->hold(p)))
      return;
    work.sites += sites;
    visit(Cell{box, part.square.key, part.square.level, h, std::llround(weight_unit * sites)});
  }

  template <class Visit>
  void divide_quarters(const Part& part, double sites, const Visit& visit, Work& work) const {
    const std::size_t sizes_before = work.sizes.size();
    const SizesBelow below = part.below.levels == 0 && size_.prefers_blocks()
                                 ? find_sizes(part.square, levels_below(part, sites), work)
                                 : part.below;
    for (unsigned k = 0; k < 4; ++k) {
      const CurveSquare quarter = part.square.quarter(k);
      Part its{quarter, grid_.box_of(quarter), part.clear, part.near, 0, {}};
      if (below.levels > 0) {
        its.size = work.sizes[below.place_of(k)];
        its.below = {below.place_of(k) + 1, below.levels - 1};
      } else {
        its.size = size_.size(middle(its.box));
      }
      divide(its, visit, work);
    }
    work.sizes.resize(sizes_before);
  }

  [[noreturn]] static void fail_for_small_size(geometry::Vec2 p, double h) {
    throw GeometryError(fmt::format("the size near {} is {}: such a small size needs far more points than are "
                                    "possible; make the size larger there, or set min_size",
                                    Place(p, 0), h));
  }

  const mesh::TileGrid& grid_;
  const polygon::BoundaryGuard& guard_;
  const sizing::SizeField& size_;
  const LoweredZones* zones_;
  const geometry::Lattice& lattice_;
  double most_inside_, most_near_; // largest weight of a cell, in sites
  double most_in_part_;            // in sites
};

/// Calls body(item) for all items on all threads. If a size field throws, all ranks throw the error. Collective.
template <class Body>
void agreed_loop(const comm::Communicator& comm, std::ptrdiff_t n, const Body& body) {
  comm::run_agreed(comm, [&] { thread_loop(n, 1, [&](std::ptrdiff_t item, int) { body(item); }); });
}

/// All parts of the tiles of this rank, in the order of the Hilbert curve.
struct DensityParts {
  const mesh::TileRange& tiles;
  const DensitySampler& sampler;

  std::ptrdiff_t count() const { return std::ptrdiff_t{tiles.last - tiles.first} * sampler.parts_per_tile(); }
  LocalIndex tile(std::ptrdiff_t part) const {
    return tiles.first + static_cast<LocalIndex>(part / sampler.parts_per_tile());
  }
  template <class Visit>
  void for_each_cell(std::ptrdiff_t part, const Visit& visit) const {
    sampler.for_each_cell(tile(part), static_cast<int>(part % sampler.parts_per_tile()), visit);
  }
};

} // namespace trime::placing
