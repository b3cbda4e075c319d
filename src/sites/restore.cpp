// SPDX-License-Identifier: BSD-3-Clause
// How a state comes back from a checkpoint.
#include "comm/agree.hpp"
#include "sites/rules.hpp"
#include "sites/site_state.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <numeric>

namespace trime::sites {
namespace {

using mesh::FixedRect;
using mesh::Tile;

/// When the curve comes to a tile.
std::uint64_t curve_key(const Tile& tile) {
  return tile.on_curve().key << (2 * tile.shift);
}

/// Do the tiles cover the container of this run, one after the other along the curve?
bool fit(const std::vector<Tile>& tiles, const mesh::TileGrid& grid) {
  const FixedRect limits = grid.limits();
  std::uint64_t covered = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Tile& tile = tiles[t];
    if (tile.shift > 31 || tile.bits > std::min<int>(mesh::MeshRules::finest_bin_bits, tile.shift) ||
        (std::uint64_t{tile.x} | tile.y) % static_cast<std::uint64_t>(tile.side()) != 0)
      return false;
    const FixedRect inside = common_part(limits, rect_of(tile));
    if (inside.is_empty() || (t > 0 && curve_key(tiles[t - 1]) >= curve_key(tile)))
      return false;
    covered +=
        static_cast<std::uint64_t>(inside.x1 - inside.x0 + 1) * static_cast<std::uint64_t>(inside.y1 - inside.y0 + 1);
  }
  return covered ==
         static_cast<std::uint64_t>(limits.x1 - limits.x0 + 1) * static_cast<std::uint64_t>(limits.y1 - limits.y0 + 1);
}

} // namespace

void SiteState::restore(const SavedTiles& saved, const SiteLoader& load, const sizing::SizeField& size) {
  if (!fit(saved.tiles, grid_)) // the same on all ranks
    throw FileError(
        fmt::format("the {} tiles of the checkpoint do not fit the container of this run", saved.tiles.size()));
  TRIME_ASSERT(state_ == State::empty || has_sites(),
               "a checkpoint cannot be restored while ghosts are being received");
  state_ = State::empty; // those of the first layout go
  share_out(saved.tiles, saved.counts);
  check_counts(saved.counts);
  const LocalIndex first = partition_.first_tile(comm_.rank()), last = partition_.last_tile(comm_.rank());
  const auto counts = std::span(saved.counts).subspan(at(first), at(last - first));
  SavedSites mine;
  std::vector<LocalIndex> new_index;
  comm::run_agreed(comm_, [&] {
    mine = load(std::accumulate(saved.counts.begin(), saved.counts.begin() + first, std::int64_t{0}),
                std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
    points_.restore_owned(mine.sites, counts, first, last, new_index);
  });
  release(mine.sites);
  points_.drifts().set_largest(saved.largest);
  carried_.clear();
  stars_.reset(points_.owned());
  halo_.reset(partition_, halo_margin());
  halo_.refresh(points_);
  state_ = State::complete;
  restore_drifts(saved);
  restore_sizes(mine.sizes, new_index, size);
  comm_.counters().add(Counter::sites_started, points_.owned());
  count_sites();
}

void SiteState::restore_drifts(const SavedTiles& saved) {
  for (LocalIndex tile = 0; tile < grid_.tile_count(); ++tile)
    if (const LocalIndex known = points_.known_tile(tile); known >= 0)
      points_.drifts().set(known, saved.drifts[at(tile)]);
}

/// The values of owned sites come from the file, since they may be older than the places; ranks that have the sites as
/// ghosts get them.
void SiteState::restore_sizes(const std::vector<double>& sizes, std::span<const LocalIndex> new_index,
                              const sizing::SizeField& size) {
  sizes_.forget();
  if (size.is_uniform()) {
    evaluate_agreed(size, points_.size());
    return;
  }
  std::vector<double>& values = sizes_.values();
  values.resize(at(points_.owned()));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    if (new_index[k] >= 0)
      values[at(new_index[k])] = sizes[k];
  const std::vector<double> of_ghosts = halo_.exchange(points_, std::span<const double>(values));
  values.insert(values.end(), of_ghosts.begin(), of_ghosts.end());
}

} // namespace trime::sites
