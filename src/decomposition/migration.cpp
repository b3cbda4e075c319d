// SPDX-License-Identifier: BSD-3-Clause
#include "trime/decomposition/migration.hpp"

#include <map>

namespace trime::decomposition {

std::vector<std::int64_t> tile_weights(const comm::Communicator& comm, const mesh::TileGrid& grid,
                                       std::span<const mesh::Site> sites) {
  std::vector<std::int64_t> weights(static_cast<std::size_t>(grid.tile_count()), 0);
  for (const mesh::Site& site : sites)
    ++weights[static_cast<std::size_t>(grid.place(site.position).tile)];
  comm.sum(weights);
  return weights;
}

void migrate(const comm::Communicator& comm, const mesh::TileGrid& grid, const Partition& partition,
             std::vector<mesh::Site>& sites, std::vector<LocalIndex>* stays) {
  const LocalIndex first = partition.first_tile(comm.rank()), last = partition.last_tile(comm.rank());
  std::map<int, std::vector<mesh::Site>> leaving; // by rank, ascending
  if (stays)
    stays->assign(sites.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const LocalIndex tile = grid.place(sites[i].position).tile;
    if (tile < first || tile >= last) {
      leaving[partition.owner(tile)].push_back(sites[i]);
      continue;
    }
    if (stays)
      (*stays)[i] = static_cast<LocalIndex>(kept);
    sites[kept++] = sites[i];
  }
  sites.resize(kept);
  if (comm.size() == 1)
    return;
  std::vector<comm::Message> outgoing;
  for (const auto& [rank, list] : leaving)
    outgoing.push_back({rank, comm::to_bytes(std::span<const mesh::Site>(list))});
  for (const comm::Message& message : comm.exchange_any(outgoing)) {
    const std::vector<mesh::Site> arrived = comm::from_bytes<mesh::Site>(message.data);
    sites.insert(sites.end(), arrived.begin(), arrived.end());
  }
}

} // namespace trime::decomposition
