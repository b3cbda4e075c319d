// SPDX-License-Identifier: BSD-3-Clause
#include "decomposition/halo.hpp"

#include "core/hilbert.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::decomposition {
namespace {

using comm::Message;
using mesh::BinRef;
using mesh::Ghost;

/// Sorted union of two ascending lists, in place.
void merge_into(std::vector<BinRef>& list, std::span<const BinRef> more) {
  const std::ptrdiff_t middle = static_cast<std::ptrdiff_t>(list.size());
  list.insert(list.end(), more.begin(), more.end());
  std::sort(list.begin() + middle, list.end());
  std::inplace_merge(list.begin(), list.begin() + middle, list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// The entry of `rank`, made where it is missing; the list stays ascending.
template <class Peers>
auto& entry(Peers& peers, int rank) {
  auto at = std::lower_bound(peers.begin(), peers.end(), rank, [](const auto& p, int r) { return p.rank < r; });
  if (at == peers.end() || at->rank != rank)
    at = peers.insert(at, {rank, {}});
  return *at;
}

/// Appends the bytes of a value.
template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

/// Values of all messages, one after the other.
template <class T>
std::vector<T> concatenate(std::span<const Message> messages) {
  std::vector<T> all;
  for (const Message& message : messages) {
    const std::size_t at = all.size();
    all.resize(at + message.data.size() / sizeof(T));
    if (!message.data.empty())
      std::memcpy(all.data() + at, message.data.data(), message.data.size());
  }
  return all;
}

} // namespace

Halo::Halo(const comm::Communicator& comm, const mesh::TileGrid& grid)
    : comm_(&comm), grid_(&grid), partition_(grid.tile_count(), comm.size()) {}

void Halo::reset(const Partition& partition, int margin) {
  partition_ = partition;
  imports_.clear();
  exports_.clear();
  imported_.clear();
  refreshed_.clear();
  counts_.clear();
  std::vector<BinRef> wanted;
  for (LocalIndex tile = partition.first_tile(comm_->rank()); tile < partition.last_tile(comm_->rank()); ++tile)
    list_bins_around(tile, margin, wanted);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  subscribe(wanted);
}

/// Bins of foreign tiles, and of images of any, within `margin` bins of a tile: its own bins, or those of the other
/// tile where they are smaller.
void Halo::list_bins_around(LocalIndex tile, int margin, std::vector<BinRef>& wanted) const {
  const int shift = grid_->tile_shift();
  const std::int64_t side = std::int64_t{1} << shift;
  const auto bin_side = [&](LocalIndex of) { return side >> grid_->bin_bits(of); };
  const GridPosition at = grid_->tile_position(tile);
  const std::int64_t x0 = std::int64_t{at.x} << shift, y0 = std::int64_t{at.y} << shift;
  const int tiles = static_cast<int>((margin * bin_side(tile) + side - 1) >> shift); // that the margin reaches
  const int column = static_cast<int>(at.x), row = static_cast<int>(at.y);
  // Along periodic axes the images beside the container belong to it.
  const int x_images = grid_->periods().x > 0 ? grid_->tiles_x() : 0,
            y_images = grid_->periods().y > 0 ? grid_->tiles_y() : 0;
  const int last_x = std::min(grid_->tiles_x() + x_images - 1, column + tiles);
  const int last_y = std::min(grid_->tiles_y() + y_images - 1, row + tiles);
  for (int ty = std::max(-y_images, row - tiles); ty <= last_y; ++ty)
    for (int tx = std::max(-x_images, column - tiles); tx <= last_x; ++tx) {
      const auto [other, image] = grid_->tile_image_at(tx, ty);
      if (image == 0 && partition_.owner(other) == comm_->rank())
        continue;
      const std::int64_t width = bin_side(other), reach = margin * std::min(bin_side(tile), width);
      const std::int64_t left = tx * side, low = ty * side;
      const std::int64_t bx0 = std::max<std::int64_t>(0, x0 - reach - left) / width;
      const std::int64_t by0 = std::max<std::int64_t>(0, y0 - reach - low) / width;
      const std::int64_t bx1 = std::min(side, x0 + side + reach - left), by1 = std::min(side, y0 + side + reach - low);
      for (std::int64_t by = by0; by * width < by1; ++by)
        for (std::int64_t bx = bx0; bx * width < bx1; ++bx)
          wanted.push_back({other, static_cast<std::int32_t>((by << grid_->bin_bits(other)) | bx), image});
    }
}

void Halo::subscribe(std::span<const BinRef> bins) {
  std::vector<Peer> requests;
  for (const BinRef& bin : bins)
    entry(requests, partition_.owner(bin.tile)).bins.push_back(bin);
  std::vector<Message> outgoing;
  for (const Peer& request : requests) {
    for (const BinRef& bin : request.bins)
      TRIME_ASSERT(request.rank != comm_->rank() || bin.image != 0, "rank {} asks for its own bins", request.rank);
    merge_into(entry(imports_, request.rank).bins, request.bins);
    outgoing.push_back({request.rank, comm::to_bytes(std::span<const BinRef>(request.bins))});
  }
  for (const Message& message : comm_->exchange_any(outgoing))
    merge_into(entry(exports_, message.peer).bins, comm::from_bytes<BinRef>(message.data));
  imported_.clear();
  for (const Peer& peer : imports_)
    imported_.insert(imported_.end(), peer.bins.begin(), peer.bins.end());
}

void Halo::refresh(mesh::BinnedPoints& points) {
  std::vector<Message> counts_out, sites_out, counts_in, sites_in;
  for (const Peer& peer : exports_) {
    counts_out.push_back({peer.rank, {}});
    sites_out.push_back({peer.rank, {}});
    for (const BinRef& bin : peer.bins) {
      const auto [begin, end] = points.bin_range({bin.tile, bin.bin}); // whatever image of it was asked for
      append(counts_out.back().data, static_cast<std::int32_t>(end - begin));
      for (LocalIndex i = begin; i < end; ++i)
        append(sites_out.back().data, Ghost{points.position(i), points.boundary(i)});
    }
  }
  for (const Peer& peer : imports_)
    counts_in.push_back({peer.rank, std::vector<std::byte>(peer.bins.size() * sizeof(std::int32_t))});
  comm_->exchange_known(counts_out, counts_in);
  for (const Message& message : counts_in) {
    std::size_t sites = 0;
    for (const std::int32_t count : comm::from_bytes<std::int32_t>(message.data))
      sites += static_cast<std::size_t>(count);
    sites_in.push_back({message.peer, std::vector<std::byte>(sites * sizeof(Ghost))});
  }
  comm_->exchange_known(sites_out, sites_in);
  const std::vector<std::int32_t> counts = concatenate<std::int32_t>(counts_in);
  note_renumbering(points.owned(), counts);
  points.assign_ghosts(imported_, counts, concatenate<Ghost>(sites_in));
  comm_->counters().note(Counter::ghosts, points.size() - points.owned());
  counts_ = counts;
  refreshed_ = imported_;
}

/// Bins that were imported before keep their sites, only at other indices.
void Halo::note_renumbering(LocalIndex owned, std::span<const std::int32_t> new_counts) {
  ghost_renumbering_.clear();
  LocalIndex next = owned;
  std::size_t old = 0;
  for (std::size_t k = 0; k < imported_.size(); ++k) {
    if (old < refreshed_.size() && refreshed_[old] == imported_[k]) {
      for (std::int32_t s = 0; s < std::min(counts_[old], new_counts[k]); ++s)
        ghost_renumbering_.push_back(next + s);
      ++old;
    }
    next += new_counts[k];
  }
}

/// Ghosts that come from a peer.
std::size_t Halo::ghosts_of(const mesh::BinnedPoints& points, const Peer& peer) const {
  std::size_t sites = 0;
  for (const BinRef& bin : peer.bins) {
    const auto [begin, end] = points.bin_range(bin);
    sites += static_cast<std::size_t>(end - begin);
  }
  return sites;
}

template <class T>
std::vector<T> Halo::exchange_values(const mesh::BinnedPoints& points, std::span<const T> owned_values) const {
  std::vector<Message> outgoing, incoming;
  for (const Peer& peer : exports_) {
    outgoing.push_back({peer.rank, {}});
    for (const BinRef& bin : peer.bins) {
      const auto [begin, end] = points.bin_range({bin.tile, bin.bin});
      for (LocalIndex i = begin; i < end; ++i)
        append(outgoing.back().data, owned_values[static_cast<std::size_t>(i)]);
    }
  }
  for (const Peer& peer : imports_)
    incoming.push_back({peer.rank, std::vector<std::byte>(ghosts_of(points, peer) * sizeof(T))});
  comm_->exchange_known(outgoing, incoming);
  return concatenate<T>(incoming);
}

std::vector<GlobalId> Halo::exchange(const mesh::BinnedPoints& points, std::span<const GlobalId> owned_values) const {
  return exchange_values(points, owned_values);
}

std::vector<double> Halo::exchange(const mesh::BinnedPoints& points, std::span<const double> owned_values) const {
  return exchange_values(points, owned_values);
}

bool Halo::begins_tile(const Peer& peer, std::size_t k) {
  return k == 0 || peer.bins[k].tile != peer.bins[k - 1].tile;
}

void Halo::refresh_drifts(mesh::BinnedPoints& points) const {
  TRIME_ASSERT(!grid_->periods().any());
  std::vector<Message> outgoing, incoming;
  for (const Peer& peer : exports_) {
    outgoing.push_back({peer.rank, {}});
    for (std::size_t k = 0; k < peer.bins.size(); ++k)
      if (begins_tile(peer, k))
        append(outgoing.back().data, points.drifts().of(peer.bins[k].tile));
  }
  std::vector<LocalIndex> tiles;
  for (const Peer& peer : imports_) {
    const std::size_t before = tiles.size();
    for (std::size_t k = 0; k < peer.bins.size(); ++k)
      if (begins_tile(peer, k))
        tiles.push_back(peer.bins[k].tile);
    incoming.push_back({peer.rank, std::vector<std::byte>((tiles.size() - before) * sizeof(double))});
  }
  comm_->exchange_known(outgoing, incoming);
  const std::vector<double> drifts = concatenate<double>(incoming);
  for (std::size_t k = 0; k < tiles.size(); ++k)
    points.drifts().set(tiles[k], drifts[k]);
}

/// For each tile of a peer its drift, then the positions of its sites.
void Halo::begin_positions(const mesh::BinnedPoints& points) {
  TRIME_ASSERT(!grid_->periods().any() && !exchange_.is_open());
  std::vector<Message> outgoing;
  for (const Peer& peer : exports_) {
    outgoing.push_back({peer.rank, {}});
    std::vector<std::byte>& data = outgoing.back().data;
    for (std::size_t k = 0; k < peer.bins.size(); ++k) {
      if (begins_tile(peer, k))
        append(data, points.drifts().of(peer.bins[k].tile));
      const auto [begin, end] = points.bin_range({peer.bins[k].tile, peer.bins[k].bin});
      const auto bytes = std::as_bytes(
          points.positions().subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
      data.insert(data.end(), bytes.begin(), bytes.end());
    }
  }
  positions_.clear();
  for (const Peer& peer : imports_) {
    std::size_t tiles = 0;
    for (std::size_t k = 0; k < peer.bins.size(); ++k)
      tiles += begins_tile(peer, k);
    positions_.push_back(
        {peer.rank, std::vector<std::byte>(tiles * sizeof(double) + ghosts_of(points, peer) * sizeof(geometry::Vec2))});
  }
  exchange_ = comm_->begin_exchange(std::move(outgoing), positions_);
}

void Halo::finish_positions(mesh::BinnedPoints& points) {
  exchange_.wait();
  const std::span<geometry::Vec2> ghosts = points.ghost_positions();
  comm_->counters().note(Counter::ghosts, std::ssize(ghosts));
  for (std::size_t next = 0, m = 0; m < positions_.size(); ++m) {
    const std::byte* from = positions_[m].data.data();
    const auto take = [&from](void* to, std::size_t size) {
      if (size > 0)
        std::memcpy(to, from, size);
      from += size;
    };
    for (std::size_t k = 0; k < imports_[m].bins.size(); ++k) {
      const BinRef& bin = imports_[m].bins[k];
      if (begins_tile(imports_[m], k)) {
        double drift = 0;
        take(&drift, sizeof drift);
        points.drifts().set(bin.tile, drift);
      }
      const auto [begin, end] = points.bin_range(bin);
      const std::size_t sites = static_cast<std::size_t>(end - begin);
      take(ghosts.data() + next, sites * sizeof(geometry::Vec2));
      next += sites;
    }
  }
  positions_.clear();
}

} // namespace trime::decomposition
