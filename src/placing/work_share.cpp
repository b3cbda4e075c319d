// SPDX-License-Identifier: BSD-3-Clause
#include "placing/work_share.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "mesh/tile_grid.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace trime::placing {
namespace {

using geometry::Vec2;

constexpr double weight_of_site = 0x1p20;   // integer weight of one site
constexpr double largest_weight = 0x1p40;   // of a quarter of a square: sums of all squares stay within 63 bits
constexpr double most_divided = 4;          // times as many tiles as there were, and some, at most
constexpr double fewest_when_divided = 256; // tiles

// [tiles] Their sizes are asked for together, if the size prefers blocks.
constexpr std::ptrdiff_t tiles_together = 1024;

/// A tile and its weight, as ranks send it to each other.
struct Leaf {
  std::int64_t weight;
  std::uint32_t x, y, level; // of a square of the curve
  std::uint32_t unused = 0;  // no byte of a message is left to chance
};

/// About how many sites a square wants.
class Estimate {
public:
  Estimate(const sites::Stage& stage, const sizing::SizeField& size, const geometry::Lattice& lattice)
      : grid_(stage.state->grid()), guard_(*stage.guard), size_(size), lattice_(lattice) {}

  const mesh::TileGrid& grid() const { return grid_; }
  /// Sets weights[k] to the weight of squares[k].
  void weigh(std::span<const CurveSquare> squares, std::int64_t* weights) const {
    std::vector<Quarter> quarters;
    std::vector<Vec2> middles;
    for (std::size_t k = 0; k < squares.size(); ++k) {
      weights[k] = 0;
      for (unsigned quarter = 0; quarter < 4; ++quarter) {
        const geometry::Box box = grid_.box_of(squares[k].quarter(quarter));
        if (const Vec2 p = lattice_.snap(0.5 * (box.min + box.max)); is_in_shape(box, p)) {
          quarters.push_back({k, box.width() * box.height()});
          middles.push_back(p);
        }
      }
    }
    const std::vector<double> sizes = sizing::sizes_at(size_, middles);
    for (std::size_t k = 0; k < quarters.size(); ++k)
      weights[quarters[k].square] += weight_of(quarters[k].area, sizes[k]);
  }
  /// Lists a square, or its quarters where it weighs too much.
  void divide(const CurveSquare& square, std::int64_t weight, std::int64_t most, std::vector<Leaf>& leaves) const {
    if (weight <= most || square.level >= mesh::MeshRules::finest_tile_level) {
      leaves.push_back({weight, square.x, square.y, static_cast<std::uint32_t>(square.level)});
      return;
    }
    const std::vector<CurveSquare> quarters = grid_.quarters(square);
    std::vector<std::int64_t> weights(quarters.size());
    weigh(quarters, weights.data());
    for (std::size_t k = 0; k < quarters.size(); ++k)
      divide(quarters[k], weights[k], most, leaves);
  }

private:
  /// A quarter of a square that may have sites.
  struct Quarter {
    std::size_t square;
    double area;
  };
  /// May a box with the middle p have sites?
  bool is_in_shape(const geometry::Box& box, Vec2 p) const {
    const double half = 0.5 * geometry::length(box.max - box.min);
    return grid_.container().contains(p) && (guard_.distance_below(p, half) < half || guard_.inside(p));
  }
  static std::int64_t weight_of(double area, double h) {
    return sizing::is_valid_size(h)
               ? std::llround(std::min(largest_weight, weight_of_site * area / (row_height * h * h)))
               : 0;
  }

  const mesh::TileGrid& grid_;
  const polygon::BoundaryGuard& guard_;
  const sizing::SizeField& size_;
  const geometry::Lattice& lattice_;
};

/// A tile weighs so much at most, if all together weigh `all`.
std::int64_t most_of(double all, const mesh::TileGrid& grid, double grid_coarsening) {
  const double scale = weight_of_site * grid_coarsening * grid_coarsening;
  const double most = scale * static_cast<double>(mesh::most_per_tile(all / scale));
  const double tiles = most_divided * static_cast<double>(grid.tile_count()) + fewest_when_divided;
  return std::llround(std::max(most, all / tiles)) + 1;
}

} // namespace

void share_by_density(sites::Stage& stage, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      double grid_coarsening) {
  const comm::Communicator& comm = stage.state->comm();
  const Estimate estimate(stage, size, lattice);
  const decomposition::Partition even(estimate.grid().tile_count(), comm.size());
  const LocalIndex first = even.first_tile(comm.rank()), tiles = even.last_tile(comm.rank()) - first;
  std::vector<std::int64_t> weights(at(tiles));
  std::vector<CurveSquare> squares;
  for (LocalIndex t = 0; t < tiles; ++t)
    squares.push_back(estimate.grid().tile(first + t).on_curve());
  const std::ptrdiff_t group = size.prefers_blocks() ? tiles_together : 1;
  comm::run_agreed(comm, [&] {
    thread_loop((tiles + group - 1) / group, 4, [&](std::ptrdiff_t k, int) {
      const std::ptrdiff_t begin = k * group, end = std::min<std::ptrdiff_t>(tiles, begin + group);
      estimate.weigh(std::span(squares).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)),
                     weights.data() + begin);
    });
  });
  const std::int64_t all = comm.sum(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}));
  const std::int64_t most = most_of(static_cast<double>(all), estimate.grid(), grid_coarsening);
  std::vector<std::vector<Leaf>> of_tile(at(tiles));
  comm::run_agreed(comm, [&] {
    thread_loop(tiles, 4, [&](std::ptrdiff_t k, int) {
      const auto t = static_cast<std::size_t>(k);
      estimate.divide(squares[t], weights[t], most, of_tile[t]);
    });
  });
  std::vector<Leaf> own;
  for (const std::vector<Leaf>& leaves : of_tile)
    own.insert(own.end(), leaves.begin(), leaves.end());
  std::vector<mesh::Tile> shared;
  weights.clear();
  for (const Leaf& leaf : comm::from_bytes<Leaf>(comm.all_gather(std::as_bytes(std::span<const Leaf>(own))))) {
    const int level = static_cast<int>(leaf.level);
    shared.push_back(
        mesh::tile_of(CurveSquare{leaf.x, leaf.y, level}, std::min(estimate.grid().typical_bin_bits(), 32 - level)));
    weights.push_back(leaf.weight + static_cast<std::int64_t>(weight_of_site)); // it takes time even if it is empty
  }
  stage.state->share_out(std::move(shared), weights);
}

bool share_by_count(sites::Stage& stage, std::vector<std::int64_t> inside) {
  const mesh::TileRange tiles = own_share(stage);
  TRIME_ASSERT(std::ssize(inside) == tiles.last - tiles.first, "{} counts, {} tiles", inside.size(),
               tiles.last - tiles.first);
  for (const polygon::BoundarySite& site : stage.polygon.sites)
    if (const LocalIndex tile = tiles.grid.place(site.position).tile; tile >= tiles.first && tile < tiles.last)
      ++inside[at(tile - tiles.first)];
  const std::vector<std::int64_t> weights = comm::gather_everywhere(stage.state->comm(), std::move(inside));
  const std::int64_t all = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  mesh::WeightedTiles fit = mesh::fit_tiles(tiles.grid, weights, mesh::most_per_tile(static_cast<double>(all)));
  stage.state->share_out(std::move(fit.tiles), fit.weights);
  return !fit.divided;
}

mesh::TileRange own_share(const sites::Stage& stage) {
  const sites::SiteState& state = *stage.state;
  return {state.grid(), state.partition().first_tile(state.comm().rank()),
          state.partition().last_tile(state.comm().rank())};
}

} // namespace trime::placing
