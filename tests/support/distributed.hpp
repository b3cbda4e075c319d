// SPDX-License-Identifier: BSD-3-Clause
// Helps tests on several ranks: collects values of all ranks, and distributes sites over the ranks.
#pragma once

#include "support/point_sets.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::testing {

/// Returns the values of all ranks, one rank after the other, on every rank. Collective.
template <class T, class Allocator>
std::vector<T> gather_all(const comm::Communicator& comm, const std::vector<T, Allocator>& values) {
  std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  std::string all;
  for (const std::string& part : comm.gather(bytes))
    all += part;
  all = comm.broadcast(std::move(all));
  return comm::from_bytes<T>(std::as_bytes(std::span<const char>(all)));
}

/// Returns for this rank the sites with the numbers k for which k mod size == rank. So ranks get sites in tiles that
/// they do not own.
inline mesh::SiteList dealt(const comm::Communicator& comm, const mesh::SiteList& sites) {
  mesh::SiteList mine;
  for (std::size_t k = static_cast<std::size_t>(comm.rank()); k < sites.size();
       k += static_cast<std::size_t>(comm.size()))
    mine.push_back(sites[k]);
  return mine;
}

} // namespace trime::testing
