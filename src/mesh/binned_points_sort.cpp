// SPDX-License-Identifier: BSD-3-Clause
// Owned sites in the order of tiles and bins. Sites that are sorted anew go from array to array, one array after the
// other, so that no second copy of all of them is ever held.
#include "trime/mesh/binned_points.hpp"

#include "mesh/mesh_rules.hpp"
#include "trime/core/error.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>

namespace trime::mesh {
namespace {

using geometry::Vec2;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

std::uint8_t stored_pushes(std::int32_t pushes) {
  return static_cast<std::uint8_t>(std::min(pushes, 255));
}

/// Tile by tile. @param move move(k, from) for the k-th site in the new order
template <class Move>
void for_each_in_order(const std::vector<LocalIndex>& kept, const std::vector<LocalIndex>& tile_start,
                       const UnsetVector<LocalIndex>& order, const Move& move) {
  thread_loop(std::ssize(kept) - 1, 1, [&](std::ptrdiff_t tile, int) {
    const std::size_t t = static_cast<std::size_t>(tile);
    const LocalIndex shift = kept[t] - tile_start[t];
    for (LocalIndex k = kept[t]; k < kept[t + 1]; ++k)
      move(at(k), order[at(k - shift)]);
  });
}

} // namespace

/// Sites of a list.
class BinnedPoints::ListedSites {
public:
  explicit ListedSites(std::span<const Site> sites) : sites_(sites) {}
  LocalIndex size() const { return static_cast<LocalIndex>(sites_.size()); }
  bool stays(LocalIndex) const { return true; }
  Vec2 position(LocalIndex i) const { return sites_[at(i)].position; }
  std::int32_t boundary(LocalIndex i) const { return sites_[at(i)].boundary; }
  std::int32_t pushes(LocalIndex i) const { return sites_[at(i)].pushes; }
  Vec2 lead(LocalIndex i) const { return sites_[at(i)].lead; }

private:
  std::span<const Site> sites_;
};

/// The owned sites at their next places, but for some, and after them new ones.
class BinnedPoints::MovedSites {
public:
  MovedSites(const BinnedPoints& points, std::span<const std::uint8_t> gone, std::span<const Site> more)
      : points_(points), gone_(gone), more_(more), owned_(points.owned()) {}
  LocalIndex size() const { return owned_ + more_.size(); }
  bool stays(LocalIndex i) const { return i >= owned_ || gone_.empty() || !gone_[at(i)]; }
  Vec2 position(LocalIndex i) const { return i < owned_ ? points_.next_positions_[at(i)] : more_.position(i - owned_); }
  std::int32_t boundary(LocalIndex i) const { return i < owned_ ? points_.boundary(i) : more_.boundary(i - owned_); }
  std::int32_t pushes(LocalIndex i) const { return i < owned_ ? points_.pushes(i) : more_.pushes(i - owned_); }
  Vec2 lead(LocalIndex i) const {
    return !points_.has_leads_ ? Vec2{} : i < owned_ ? points_.next_leads_[at(i)] : more_.lead(i - owned_);
  }

private:
  const BinnedPoints& points_;
  std::span<const std::uint8_t> gone_;
  ListedSites more_;
  LocalIndex owned_;
};

std::vector<std::uint8_t> BinnedPoints::suitable_bin_bits(std::span<const Site> sites, LocalIndex first_tile,
                                                          LocalIndex last_tile) {
  first_tile_ = first_tile;
  last_tile_ = last_tile;
  sort_into_tiles(ListedSites(sites));
  std::vector<std::uint8_t> bits(at(last_tile - first_tile));
  thread_loop(std::ssize(bits), 1, [&](std::ptrdiff_t t, int) {
    bits[static_cast<std::size_t>(t)] =
        static_cast<std::uint8_t>(suitable_bin_bits(sites, first_tile + static_cast<LocalIndex>(t)));
  });
  return bits;
}

/// @pre order_ lists the sites of the tile
int BinnedPoints::suitable_bin_bits(std::span<const Site> sites, LocalIndex tile) const {
  const LocalIndex begin = tile_start_[at(tile - first_tile_)], end = tile_start_[at(tile - first_tile_) + 1];
  const std::int64_t n = end - begin;
  int bits = 0;
  while (bits < grid_->most_bin_bits() && std::int64_t{4} << (2 * bits) <= MeshRules::bins_per_site * n)
    ++bits;
  std::vector<std::int64_t> count(std::size_t{1} << (2 * bits), 0);
  for (LocalIndex k = begin; k < end; ++k)
    ++count[static_cast<std::size_t>(grid_->bin_at(sites[at(order_[at(k)])].position, bits))];
  int suitable = bits; // the smallest that will do, coming from the largest
  for (; bits >= 0; --bits) {
    std::int64_t pairs = 0;
    for (const std::int64_t c : count)
      pairs += c * c;
    if (static_cast<double>(pairs) > MeshRules::most_in_bin * static_cast<double>(n))
      break;
    suitable = bits;
    if (bits > 0) { // four bins become one
      std::vector<std::int64_t> coarse(count.size() / 4, 0);
      for (std::size_t b = 0; b < count.size(); ++b)
        coarse[((b >> (bits + 1)) << (bits - 1)) | ((b & ((std::size_t{1} << bits) - 1)) >> 1)] += count[b];
      count = std::move(coarse);
    }
  }
  return suitable;
}

LocalIndex BinnedPoints::assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                                      std::vector<LocalIndex>* new_index) {
  first_tile_ = first_tile;
  last_tile_ = last_tile;
  has_leads_ = true;
  const ListedSites list(sites);
  const LocalIndex dropped = find_order(list);
  take_places(list);
  take_labels(list);
  if (new_index)
    list_new_indices(list.size(), *new_index);
  forget_order();
  return dropped;
}

void BinnedPoints::sort_moved(std::span<const std::uint8_t> gone, std::span<const Site> more,
                              std::vector<LocalIndex>& new_index) {
  const MovedSites moved(*this, gone, more);
  const std::size_t before = at(moved.size());
  find_order(moved);
  take_labels(moved);
  take_places(moved); // over the old ones
  release(next_positions_);
  release(next_leads_);
  list_new_indices(static_cast<LocalIndex>(before), new_index);
  forget_order();
}

/// Sets the bins, and order_ (where suitable_bin_bits has not begun it) to the sites by tile and bin, without
/// duplicates; returns how many were dropped.
template <class Sites>
LocalIndex BinnedPoints::find_order(const Sites& sites) {
  const LocalIndex tiles = last_tile_ - first_tile_;
  make_owned_blocks();
  if (largest_drift_ > 0 || drift_.empty()) {
    drift_.assign(static_cast<std::size_t>(grid_->tile_count()), 0);
    largest_drift_ = 0;
  }
  if (tile_start_.empty())
    sort_into_tiles(sites);
  else
    TRIME_ASSERT(std::ssize(order_) == sites.size() && std::ssize(tile_start_) == tiles + 1,
                 "suitable_bin_bits has listed {} sites in {} tiles, found {} in {}", order_.size(),
                 tile_start_.size() - 1, sites.size(), tiles);
  kept_.assign(at(tiles) + 1, 0);
  PerThread<TileWork> of_thread;
  thread_loop(tiles, 1, [&](std::ptrdiff_t t, int thread) {
    kept_[static_cast<std::size_t>(t) + 1] = sort_tile(sites, static_cast<LocalIndex>(t), of_thread[thread]);
  });
  for (std::size_t t = 1; t < kept_.size(); ++t)
    kept_[t] += kept_[t - 1];
  thread_loop(tiles, 64, [&](std::ptrdiff_t tile, int) {
    const std::size_t t = static_cast<std::size_t>(tile);
    const LocalIndex shift = kept_[t] - tile_start_[t]; // dropped sites close up
    const std::size_t first_bin = blocks_[t].first_bin, bins = std::size_t{1} << (2 * blocks_[t].bits);
    for (std::size_t b = first_bin; shift != 0 && b < first_bin + bins; ++b) {
      bin_begin_[b] += shift;
      bin_end_[b] += shift;
    }
  });
  return static_cast<LocalIndex>(order_.size()) - kept_.back();
}

template <class Sites>
void BinnedPoints::take_places(const Sites& sites) {
  owned_ = kept_.back();
  positions_.resize(at(owned_));
  leads_.resize(has_leads_ ? at(owned_) : 0);
  for_each_in_order(kept_, tile_start_, order_, [&](std::size_t k, LocalIndex from) {
    positions_[k] = sites.position(from);
    if (has_leads_)
      leads_[k] = sites.lead(from);
  });
}

template <class Sites>
void BinnedPoints::take_labels(const Sites& sites) {
  UnsetVector<std::int32_t> boundary;
  UnsetVector<std::uint8_t> pushes;
  boundary.reserve(boundary_.capacity()); // ghosts will follow
  boundary.resize(at(kept_.back()));
  pushes.resize(at(kept_.back()));
  for_each_in_order(kept_, tile_start_, order_, [&](std::size_t k, LocalIndex from) {
    boundary[k] = sites.boundary(from);
    pushes[k] = stored_pushes(sites.pushes(from));
  });
  boundary_ = std::move(boundary);
  pushes_ = std::move(pushes);
}

void BinnedPoints::list_new_indices(LocalIndex before, std::vector<LocalIndex>& new_index) const {
  new_index.assign(at(before), -1);
  for_each_in_order(kept_, tile_start_, order_,
                    [&](std::size_t k, LocalIndex from) { new_index[at(from)] = static_cast<LocalIndex>(k); });
}

void BinnedPoints::forget_order() {
  release(order_);
  release(tile_start_);
}

/// Fills order_ with the site indices grouped by tile (tile_start_).
template <class Sites>
void BinnedPoints::sort_into_tiles(const Sites& sites) {
  const LocalIndex tiles = last_tile_ - first_tile_;
  const std::ptrdiff_t n = sites.size();
  const int parts = std::max(1, thread_count());
  // counts[part][tile]: each part is a contiguous piece of the input, so the order is stable for any thread count.
  std::vector<LocalIndex> counts(static_cast<std::size_t>(parts) * at(tiles), 0);
  const auto for_each_of_part = [&](std::ptrdiff_t part, const auto& visit) {
    LocalIndex* of_tile = counts.data() + part * tiles;
    for (std::ptrdiff_t item = n * part / parts; item < n * (part + 1) / parts; ++item)
      if (const LocalIndex i = static_cast<LocalIndex>(item); sites.stays(i)) {
        const LocalIndex tile = grid_->tile_at(sites.position(i));
        TRIME_ASSERT(tile >= first_tile_ && tile < last_tile_, "site of tile {} given to the owner of {}..{}", tile,
                     first_tile_, last_tile_);
        visit(i, of_tile[tile - first_tile_]);
      }
  };
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    for_each_of_part(part, [](LocalIndex, LocalIndex& count) { ++count; });
  });
  tile_start_.assign(at(tiles) + 1, 0);
  LocalIndex running = 0;
  for (LocalIndex t = 0; t < tiles; ++t) {
    tile_start_[at(t)] = running;
    for (int part = 0; part < parts; ++part) {
      LocalIndex& count = counts[static_cast<std::size_t>(part) * at(tiles) + at(t)];
      const LocalIndex here = count;
      count = running;
      running += here;
    }
  }
  tile_start_[at(tiles)] = running;
  order_.resize(at(running));
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    for_each_of_part(part, [&](LocalIndex i, LocalIndex& next) { order_[at(next++)] = i; });
  });
}

/// Sorts one tile's piece of order_ by bin (counting, then by coordinates inside a bin), drops duplicates, sets the
/// bins; returns the number of sites kept.
template <class Sites>
LocalIndex BinnedPoints::sort_tile(const Sites& sites, LocalIndex tile, TileWork& work) {
  const Block& block = blocks_[at(tile)];
  const std::size_t bins = std::size_t{1} << (2 * block.bits), first_bin = block.first_bin;
  const LocalIndex begin = tile_start_[at(tile)], end = tile_start_[at(tile) + 1];
  LocalIndex* bin_end = bin_end_.data() + first_bin;
  const auto before = [&](LocalIndex i, LocalIndex j) {
    const Vec2 a = sites.position(i), b = sites.position(j);
    if (!(a == b))
      return geometry::lexicographically_less(a, b);
    // Of equal sites the first is kept: the boundary site or the fixed one, else the one pushed most often.
    const std::int32_t boundary_a = sites.boundary(i), boundary_b = sites.boundary(j);
    if ((boundary_a == free_site) != (boundary_b == free_site))
      return boundary_b == free_site;
    if (boundary_a != boundary_b)
      return boundary_a > boundary_b;
    const std::int32_t pushes_a = sites.pushes(i), pushes_b = sites.pushes(j);
    return pushes_a != pushes_b ? pushes_a > pushes_b : geometry::lexicographically_less(sites.lead(i), sites.lead(j));
  };
  std::fill(bin_end, bin_end + bins, 0);
  work.bin.resize(at(end - begin));
  work.sorted.resize(at(end - begin));
  for (LocalIndex k = begin; k < end; ++k) {
    const int bin = grid_->bin_at(sites.position(order_[at(k)]), block.bits);
    work.bin[at(k - begin)] = bin;
    ++bin_end[bin];
  }
  LocalIndex next = begin;
  for (std::size_t b = 0; b < bins; ++b) { // bin_end is the running end of each bin while it fills
    const LocalIndex count = bin_end[b];
    bin_begin_[first_bin + b] = bin_end[b] = next;
    next += count;
  }
  for (LocalIndex k = begin; k < end; ++k)
    work.sorted[at(bin_end[work.bin[at(k - begin)]]++ - begin)] = order_[at(k)];
  next = begin;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto first = work.sorted.begin() + (bin_begin_[first_bin + b] - begin),
               last = work.sorted.begin() + (bin_end[b] - begin);
    std::sort(first, last, before);
    bin_begin_[first_bin + b] = next;
    for (auto it = first; it != last; ++it)
      if (it == first || !(sites.position(*it) == sites.position(*(it - 1))))
        order_[at(next++)] = *it;
    bin_end[b] = next;
  }
  return next - begin;
}

} // namespace trime::mesh
