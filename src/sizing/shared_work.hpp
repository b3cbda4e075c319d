// SPDX-License-Identifier: BSD-3-Clause
// Work that ranks and threads share and whose results every rank needs.
#pragma once

#include "trime/comm/agree.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/thread_loop.hpp"

#include <string>
#include <vector>

namespace trime::sizing {

/// The values of all ranks one after the other, on every rank. Collective.
template <class T>
std::vector<T> gather_everywhere(const comm::Communicator& comm, std::vector<T> mine) {
  if (comm.size() == 1)
    return mine;
  std::string all;
  for (const std::string& part :
       comm.gather(std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(T))))
    all += part;
  return comm::from_bytes<T>(std::as_bytes(std::span<const char>(comm.broadcast(std::move(all)))));
}

/// @brief work(k) for k = 0 .. n-1, of type T, on every rank: each rank computes a contiguous share. Collective.
/// @param work thread-safe, does not communicate; what it throws, all ranks throw
template <class T, class Work>
std::vector<T> compute_shared(const comm::Communicator& comm, std::size_t n, const Work& work) {
  const auto ranks = static_cast<std::size_t>(comm.size()), rank = static_cast<std::size_t>(comm.rank());
  const std::size_t first = n * rank / ranks, last = n * (rank + 1) / ranks;
  std::vector<T> mine;
  comm::run_agreed(comm, [&] {
    mine.resize(last - first);
    thread_loop(static_cast<std::ptrdiff_t>(mine.size()), 256,
                [&](std::ptrdiff_t k, int) { mine[k] = work(first + static_cast<std::size_t>(k)); });
  });
  return gather_everywhere(comm, std::move(mine));
}

} // namespace trime::sizing
