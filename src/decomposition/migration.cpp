// SPDX-License-Identifier: BSD-3-Clause
#include "decomposition/migration.hpp"

#include "core/thread_loop.hpp"
#include "mesh/tile_grid.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace trime::decomposition {
namespace {

/// Parts of a list that threads count at the same time; their sum does not depend on how many there are.
int part_count(std::ptrdiff_t n) {
  constexpr std::ptrdiff_t least = 1 << 14; // items of a part
  return static_cast<int>(std::clamp<std::ptrdiff_t>(n / least, 1, thread_count()));
}

bool all_stay(const mesh::TileGrid& grid, LocalIndex first, LocalIndex last, std::span<const mesh::Site> sites) {
  if (first == 0 && last == grid.tile_count())
    return true;
  const std::ptrdiff_t n = std::ssize(sites);
  const int parts = part_count(n);
  std::vector<std::uint8_t> stay(static_cast<std::size_t>(parts), 1);
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    for (std::ptrdiff_t i = n * part / parts; i < n * (part + 1) / parts; ++i)
      if (const LocalIndex tile = grid.tile_at(sites[static_cast<std::size_t>(i)].position);
          tile < first || tile >= last) {
        stay[static_cast<std::size_t>(part)] = 0;
        return;
      }
  });
  return std::find(stay.begin(), stay.end(), 0) == stay.end();
}

} // namespace

std::vector<std::int64_t> tile_weights(const comm::Communicator& comm, const mesh::TileGrid& grid,
                                       std::span<const mesh::Site> sites) {
  const std::ptrdiff_t n = std::ssize(sites);
  const int parts = part_count(n);
  std::vector<std::vector<std::int64_t>> of_part(static_cast<std::size_t>(parts));
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    std::vector<std::int64_t>& weights = of_part[static_cast<std::size_t>(part)];
    weights.assign(static_cast<std::size_t>(grid.tile_count()), 0);
    for (std::ptrdiff_t i = n * part / parts; i < n * (part + 1) / parts; ++i)
      ++weights[static_cast<std::size_t>(grid.tile_at(sites[static_cast<std::size_t>(i)].position))];
  });
  std::vector<std::int64_t> weights = std::move(of_part.front());
  for (std::size_t part = 1; part < of_part.size(); ++part)
    std::transform(weights.begin(), weights.end(), of_part[part].begin(), weights.begin(), std::plus<>());
  comm.sum(weights);
  return weights;
}

std::vector<std::int64_t> fit_tiles(const comm::Communicator& comm, mesh::TileGrid& grid,
                                    std::span<const mesh::Site> sites) {
  for (;;) { // every division goes a level deeper, and levels are bounded
    const std::vector<std::int64_t> weights = tile_weights(comm, grid, sites);
    const std::int64_t all = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
    mesh::WeightedTiles fit = mesh::fit_tiles(grid, weights, mesh::most_per_tile(static_cast<double>(all)));
    grid.set_tiles(std::move(fit.tiles));
    if (!fit.divided)
      return fit.weights;
  }
}

void migrate(const comm::Communicator& comm, const mesh::TileGrid& grid, const Partition& partition,
             mesh::SiteList& sites) {
  const LocalIndex first = partition.first_tile(comm.rank()), last = partition.last_tile(comm.rank());
  std::map<int, mesh::SiteList> leaving; // by rank, ascending
  const bool none_leaves = all_stay(grid, first, last, sites);
  std::size_t kept = none_leaves ? sites.size() : 0;
  for (std::size_t i = kept; i < sites.size(); ++i) {
    const LocalIndex tile = grid.tile_at(sites[i].position);
    if (tile < first || tile >= last) {
      leaving[partition.owner(tile)].push_back(sites[i]);
      continue;
    }
    sites[kept++] = sites[i];
  }
  sites.resize(kept);
  if (comm.size() == 1)
    return;
  std::vector<comm::Message> outgoing;
  for (const auto& [rank, list] : leaving)
    outgoing.push_back({rank, comm::to_bytes(std::span<const mesh::Site>(list))});
  const std::vector<comm::Message> incoming = comm.exchange_any(outgoing);
  std::size_t bytes = 0;
  for (const comm::Message& message : incoming)
    bytes += message.data.size();
  if (const std::size_t all = sites.size() + bytes / sizeof(mesh::Site); all > sites.capacity())
    sites.reserve(all); // no more: what grows by itself doubles
  for (const comm::Message& message : incoming) {
    const std::vector<mesh::Site> arrived = comm::from_bytes<mesh::Site>(message.data);
    sites.insert(sites.end(), arrived.begin(), arrived.end());
    comm.counters().add(Counter::sites_migrated, std::ssize(arrived));
  }
}

} // namespace trime::decomposition
