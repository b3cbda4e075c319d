// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/start.hpp"

#include "trime/core/error.hpp"
#include "trime/core/random.hpp"
#include "trime/core/thread_loop.hpp"

#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;
__extension__ using Int128 = __int128;

constexpr double strip = 0.43;         // of h along the boundary stays free
constexpr int cells_per_bin_bits = 3;  // 8 x 8 sampling cells in a bin of about 3.3 sites
constexpr double weight_unit = 0x1p20; // integer weight of one site's share

/// The sampling cells of a tile in Hilbert order.
class TileSampler {
public:
  TileSampler(const mesh::TileGrid& grid, LocalIndex tile)
      : box_(grid.tile_box(tile)), level_(grid.typical_bin_bits() + cells_per_bin_bits), side_(1u << level_) {}

  std::uint64_t cells() const { return std::uint64_t{side_} * side_; }
  /// Point of cell `key` at fractions (u, v) of its sides.
  Vec2 point(std::uint64_t key, double u, double v) const {
    const mesh::GridPosition at = mesh::hilbert_position(key, level_);
    return {box_.min.x + (at.x + u) / side_ * box_.width(), box_.min.y + (at.y + v) / side_ * box_.height()};
  }
  double cell_area() const { return box_.width() / side_ * (box_.height() / side_); }

private:
  geometry::Box box_;
  int level_;
  std::uint32_t side_;
};

/// Sites that belong into a cell, in units of 2^-20: 0 outside the shape and in the strip.
std::int64_t cell_weight(const TileSampler& sampler, std::uint64_t key, const mesh::TileGrid& grid,
                         const BoundaryGuard& guard, const sizing::SizeField& size, const geometry::Lattice& lattice) {
  const Vec2 p = lattice.snap(sampler.point(key, 0.5, 0.5));
  if (!grid.container().contains(p) || !guard.inside(p))
    return 0;
  const double h = size.size(p);
  if (guard.distance(p, strip * h) < strip * h)
    return 0;
  return std::llround(weight_unit * sampler.cell_area() / (0.8660254037844386 * h * h));
}

} // namespace

std::vector<mesh::Site> hilbert_start(const comm::Communicator& comm, const TileRange& tiles,
                                      const BoundaryGuard& guard, const sizing::SizeField& size,
                                      const geometry::Lattice& lattice, std::int64_t n, std::uint64_t seed) {
  const std::ptrdiff_t count = tiles.last - tiles.first;
  std::vector<std::int64_t> before(static_cast<std::size_t>(count) + 1, 0);
  const auto weight = [&](const TileSampler& sampler, std::uint64_t key) {
    return cell_weight(sampler, key, tiles.grid, guard, size, lattice);
  };
  thread_loop(count, 1, [&](std::ptrdiff_t t, int) {
    const TileSampler sampler(tiles.grid, tiles.first + static_cast<LocalIndex>(t));
    for (std::uint64_t key = 0; key < sampler.cells(); ++key)
      before[static_cast<std::size_t>(t) + 1] += weight(sampler, key);
  });
  for (std::size_t t = 1; t < before.size(); ++t)
    before[t] += before[t - 1];
  const std::int64_t total = comm.sum(before.back()), first = comm.exclusive_scan(before.back());
  if (total == 0 || n <= 0)
    return {};

  // Site j sits where the running weight passes (2j + 1) total / (2n).
  std::vector<std::vector<mesh::Site>> of_tile(static_cast<std::size_t>(count));
  thread_loop(count, 1, [&](std::ptrdiff_t t, int) {
    const LocalIndex tile = tiles.first + static_cast<LocalIndex>(t);
    const TileSampler sampler(tiles.grid, tile);
    const std::uint64_t stream = mix_bits(static_cast<std::uint64_t>(tile));
    std::int64_t running = first + before[static_cast<std::size_t>(t)];
    std::int64_t j = static_cast<std::int64_t>((Int128{2} * running * n + total - 1) / (Int128{2} * total));
    for (std::uint64_t key = 0; key < sampler.cells(); ++key) {
      running += weight(sampler, key);
      for (std::uint64_t slot = 0; j < n && (Int128{2} * j + 1) * total < Int128{2} * running * n; ++j, slot += 2) {
        const double u = random_unit(seed, RandomPurpose::site_position, stream + key, slot);
        const double v = random_unit(seed, RandomPurpose::site_position, stream + key, slot + 1);
        of_tile[static_cast<std::size_t>(t)].push_back({lattice.snap(sampler.point(key, u, v))});
      }
    }
  });
  std::vector<mesh::Site> all;
  for (const std::vector<mesh::Site>& list : of_tile)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

} // namespace trime::meshing
