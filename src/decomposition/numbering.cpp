// SPDX-License-Identifier: BSD-3-Clause
#include "decomposition/numbering.hpp"

#include "core/hilbert.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>

namespace trime::decomposition {
namespace {

/// Puts the sites of tiles into canonical order, bin after bin along the curve.
class TileOrder {
public:
  explicit TileOrder(const mesh::BinnedPoints& points) : points_(points), grid_(points.grid()) {}

  /// Fills order[begin, end) of the sites of a tile.
  void sort(LocalIndex tile, std::span<LocalIndex> order) {
    const int bits = grid_.bin_bits(tile);
    LocalIndex next = points_.tile_range(tile).begin;
    list_bins(tile, bits);
    for (const std::int32_t bin : bins_) {
      const auto [begin, end] = points_.bin_range({tile, bin});
      keyed_.clear();
      for (LocalIndex i = begin; i < end; ++i)
        keyed_.push_back({end - begin > 1 ? grid_.point_key(points_.position(i)) : 0, i});
      std::sort(keyed_.begin(), keyed_.end(), [&](const Keyed& a, const Keyed& b) {
        return a.key != b.key ? a.key < b.key
                              : geometry::lexicographically_less(points_.position(a.site), points_.position(b.site));
      });
      for (const Keyed& site : keyed_)
        order[at(next++)] = site.site;
    }
  }

private:
  /// The bins along the curve: the key of a bin leads those of its points.
  void list_bins(LocalIndex tile, int bits) {
    const mesh::Tile& square = grid_.tile(tile);
    const std::uint32_t column = square.x >> square.bin_shift(), row = square.y >> square.bin_shift();
    const int level = square.level() + bits;
    const std::uint32_t side = std::uint32_t{1} << bits;
    const std::uint64_t mask = (std::uint64_t{1} << (2 * bits)) - 1;
    bins_.resize(std::size_t{1} << (2 * bits));
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x)
        bins_[hilbert_key(column | x, row | y, level) & mask] = static_cast<std::int32_t>((y << bits) | x);
  }

  struct Keyed {
    std::uint64_t key;
    LocalIndex site;
  };
  const mesh::BinnedPoints& points_;
  const mesh::TileGrid& grid_;
  std::vector<std::int32_t> bins_;
  std::vector<Keyed> keyed_;
};

/// Vertices of the ghosts: our own where they are images of owned points.
void number_ghosts(std::span<const GlobalId> ids, Numbering& numbering) {
  const GlobalId end = numbering.first + numbering.owned();
  for (const GlobalId id : ids)
    if (id < numbering.first || id >= end)
      numbering.foreign.push_back(id);
  std::sort(numbering.foreign.begin(), numbering.foreign.end());
  numbering.foreign.erase(std::unique(numbering.foreign.begin(), numbering.foreign.end()), numbering.foreign.end());
  const auto place = [&](GlobalId id) {
    const auto found = std::lower_bound(numbering.foreign.begin(), numbering.foreign.end(), id);
    return static_cast<LocalIndex>(found - numbering.foreign.begin());
  };
  numbering.foreign_below = place(numbering.first);
  for (const GlobalId id : ids)
    numbering.site_vertex.push_back(id >= numbering.first && id < end ? static_cast<LocalIndex>(id - numbering.first)
                                                                      : numbering.owned() + place(id));
}

} // namespace

Numbering canonical_numbering(const comm::Communicator& comm, const mesh::BinnedPoints& points, const Halo& halo) {
  Numbering result;
  const std::size_t owned = at(points.owned());
  result.first = comm.exclusive_scan(points.owned());
  result.total = comm.sum(std::int64_t{points.owned()});
  result.order.resize(owned);
  result.site_vertex.reserve(at(points.size()));
  result.site_vertex.resize(owned);
  UnsetVector<GlobalId> ids(owned);
  PerThread<TileOrder> of_thread(points);
  thread_loop(points.last_tile() - points.first_tile(), 1, [&](std::ptrdiff_t t, int thread) {
    const LocalIndex tile = points.first_tile() + static_cast<LocalIndex>(t);
    of_thread[thread].sort(tile, result.order);
    const auto [begin, end] = points.tile_range(tile);
    for (LocalIndex vertex = begin; vertex < end; ++vertex) {
      result.site_vertex[at(result.order[at(vertex)])] = vertex;
      ids[at(result.order[at(vertex)])] = result.first + vertex;
    }
  });
  number_ghosts(halo.exchange(points, ids), result);
  return result;
}

} // namespace trime::decomposition
