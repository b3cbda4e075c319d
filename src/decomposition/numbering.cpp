// SPDX-License-Identifier: BSD-3-Clause
#include "trime/decomposition/numbering.hpp"

#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <numeric>

namespace trime::decomposition {

Numbering canonical_numbering(const comm::Communicator& comm, const mesh::BinnedPoints& points, const Halo& halo) {
  Numbering result;
  const std::size_t owned = static_cast<std::size_t>(points.owned());
  result.first = comm.exclusive_scan(points.owned());
  result.total = comm.sum(std::int64_t{points.owned()});
  result.order.resize(owned);
  std::iota(result.order.begin(), result.order.end(), 0);
  std::vector<std::uint64_t> keys(owned);
  const mesh::TileGrid& grid = points.grid();
  const LocalIndex first_tile = points.first_tile();
  thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int) {
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i)
      keys[static_cast<std::size_t>(i)] = grid.point_key(points.position(i));
    std::sort(result.order.begin() + begin, result.order.begin() + end, [&](LocalIndex a, LocalIndex b) {
      const std::uint64_t ka = keys[static_cast<std::size_t>(a)], kb = keys[static_cast<std::size_t>(b)];
      return ka != kb ? ka < kb : geometry::lexicographically_less(points.position(a), points.position(b));
    });
  });
  result.global_ids.resize(owned);
  for (std::size_t k = 0; k < owned; ++k)
    result.global_ids[static_cast<std::size_t>(result.order[k])] = result.first + static_cast<GlobalId>(k);
  const std::vector<GlobalId> ghosts = halo.exchange(points, result.global_ids);
  result.global_ids.insert(result.global_ids.end(), ghosts.begin(), ghosts.end());
  return result;
}

} // namespace trime::decomposition
