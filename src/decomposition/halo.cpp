// SPDX-License-Identifier: BSD-3-Clause
#include "decomposition/halo.hpp"

#include "comm/neighbours.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace trime::decomposition {
namespace {

using comm::Message;
using mesh::BinRef;
using mesh::Ghost;

/// Sorted union of two ascending lists, in place.
void merge_into(std::vector<BinRef>& list, std::span<const BinRef> more) {
  const std::ptrdiff_t middle = static_cast<std::ptrdiff_t>(list.size());
  list.insert(list.end(), more.begin(), more.end());
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

/// Appends the bytes of values.
template <class T>
void append(std::vector<std::byte>& bytes, std::span<const T> values) {
  const auto more = std::as_bytes(values);
  bytes.insert(bytes.end(), more.begin(), more.end());
}
template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  append(bytes, std::span<const T>(&value, 1));
}

/// Takes values from the front of a message.
class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}
  template <class T>
  void take(std::span<T> values) {
    if (!values.empty())
      std::memcpy(values.data(), left_.data(), values.size_bytes());
    left_ = left_.subspan(values.size_bytes());
  }
  template <class T>
  T take() {
    T value;
    take(std::span<T>(&value, 1));
    return value;
  }
  template <class T>
  std::vector<T> take(std::size_t n) {
    std::vector<T> values(n);
    take(std::span<T>(values));
    return values;
  }

private:
  std::span<const std::byte> left_;
};

std::size_t sum_of(std::span<const std::int32_t> counts) {
  return static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
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

/// The owned sites of a bin, whatever image of it was asked for.
mesh::SiteRange sites_of(const mesh::BinnedPoints& points, const BinRef& bin) {
  return points.bin_range({bin.tile, bin.bin});
}

void append_ghosts(const mesh::BinnedPoints& points, const BinRef& bin, std::vector<std::byte>& bytes) {
  const auto [begin, end] = sites_of(points, bin);
  for (LocalIndex i = begin; i < end; ++i)
    append(bytes, Ghost{points.position(i), points.boundary(i)});
}

/// The message of Halo::extend about some bins: number of sites in each, drifts of their tiles, the sites, and their h.
std::vector<std::byte> describe(const mesh::BinnedPoints& points, std::span<const BinRef> bins,
                                const std::vector<double>* sizes) {
  std::vector<std::byte> bytes;
  for (const BinRef& bin : bins)
    append(bytes, sites_of(points, bin).end - sites_of(points, bin).begin);
  for (const BinRef& bin : bins)
    append(bytes, points.drifts().of(points.known_tile(bin.tile)));
  for (const BinRef& bin : bins)
    append_ghosts(points, bin, bytes);
  for (const BinRef& bin : bins)
    if (const auto [begin, end] = sites_of(points, bin); sizes)
      append(bytes, std::span<const double>(*sizes).subspan(at(begin), at(end - begin)));
  return bytes;
}

/// Adds some bins from the message that describe() has made.
void add_described(std::span<const std::byte> bytes, std::span<const BinRef> bins, mesh::BinnedPoints& points,
                   std::vector<double>* sizes) {
  Reader reader(bytes);
  const auto counts = reader.take<std::int32_t>(bins.size());
  const auto drifts = reader.take<double>(bins.size());
  const auto ghosts = reader.take<Ghost>(sum_of(counts));
  points.add_ghosts(bins, counts, ghosts);
  for (std::size_t k = 0; k < bins.size(); ++k)
    if (bins[k].image == 0)
      points.drifts().set(points.known_tile(bins[k].tile), drifts[k]);
  if (sizes) {
    sizes->resize(at(points.size()));
    reader.take(std::span(*sizes).last(ghosts.size()));
  }
}

/// Data of a tile that are sent with the places of its sites.
struct TileNews {
  double drift;
  std::uint64_t mark;
};

} // namespace

Halo::Halo(const comm::Communicator& comm, const mesh::TileGrid& grid)
    : comm_(&comm), grid_(&grid), partition_(grid.tile_count(), comm.size()) {}

void Halo::reset(const Partition& partition, int margin) {
  partition_ = partition;
  imports_.clear();
  exports_.clear();
  inward_.clear();
  outward_.clear();
  std::vector<BinRef> wanted;
  for (LocalIndex tile = partition.first_tile(comm_->rank()); tile < partition.last_tile(comm_->rank()); ++tile)
    list_bins_around(tile, margin, wanted);
  subscribe(by_owner(std::move(wanted)));
}

/// Bins of foreign tiles, and of images of any, within `margin` bins of a tile: its own bins, or those of the other
/// tile where they are smaller.
void Halo::list_bins_around(LocalIndex tile, int margin, std::vector<mesh::BinRef>& wanted) const {
  const auto reach_of = [&](const mesh::Tile& of) { return std::int64_t{margin} << of.bin_shift(); };
  const mesh::FixedRect own = mesh::common_part(rect_of(grid_->tile(tile)), grid_->limits());
  mesh::FixedRect around = own.grown(reach_of(grid_->tile(tile)));
  if (grid_->periods().x == 0)
    around = {std::max(around.x0, grid_->limits().x0), around.y0, std::min(around.x1, grid_->limits().x1), around.y1};
  if (grid_->periods().y == 0)
    around = {around.x0, std::max(around.y0, grid_->limits().y0), around.x1, std::min(around.y1, grid_->limits().y1)};
  grid_->for_each_in(around, [&](LocalIndex number, int image, const mesh::FixedRect& part) {
    if (image == 0 && partition_.owner(number) == comm_->rank())
      return;
    const mesh::Tile& other = grid_->tile(number);
    const mesh::FixedRect near = mesh::common_part(
        part, own.moved(-grid_->fixed_shift_x(image), -grid_->fixed_shift_y(image)).grown(reach_of(other)));
    if (near.is_empty())
      return;
    for (int row = other.first_row(near.y0); row <= other.last_row(near.y1); ++row)
      for (int column = other.first_column(near.x0); column <= other.last_column(near.x1); ++column)
        wanted.push_back({number, (row << other.bits) | column, image});
  });
}

/// Whom to ask for which bins; ascending, each once.
std::vector<Halo::Peer> Halo::by_owner(std::vector<BinRef> bins) const {
  std::sort(bins.begin(), bins.end());
  bins.erase(std::unique(bins.begin(), bins.end()), bins.end());
  std::vector<Peer> peers;
  for (const BinRef& bin : bins) {
    const int owner = partition_.owner(bin.tile);
    TRIME_ASSERT(owner != comm_->rank() || bin.image != 0, "rank {} must not ask for bins that it owns itself", owner);
    if (peers.empty() || peers.back().rank != owner)
      peers.push_back({owner, {}});
    peers.back().bins.push_back(bin);
  }
  return peers;
}

/// Asks for bins; returns what others have asked of this rank.
std::vector<Halo::Peer> Halo::subscribe(const std::vector<Peer>& requests) {
  std::vector<Message> outgoing;
  for (const Peer& request : requests) {
    merge_into(entry(imports_, request.rank).bins, request.bins);
    outgoing.push_back({request.rank, comm::to_bytes(std::span<const BinRef>(request.bins))});
  }
  std::vector<Peer> asked;
  for (const Message& message : comm_->exchange_any(outgoing)) {
    asked.push_back({message.peer, comm::from_bytes<BinRef>(message.data)});
    merge_into(entry(exports_, message.peer).bins, asked.back().bins);
  }
  return asked;
}

void Halo::extend(mesh::BinnedPoints& points, std::vector<BinRef> missing, std::vector<double>* sizes) {
  const std::vector<Peer> requests = by_owner(std::move(missing));
  std::vector<Message> replies;
  for (const Peer& peer : subscribe(requests))
    replies.push_back({peer.rank, describe(points, peer.bins, sizes)});
  const std::vector<Message> arrived = comm_->exchange_any(replies); // as many as were asked, in the same order
  for (std::size_t k = 0; k < requests.size(); ++k)
    add_described(arrived[k].data, requests[k].bins, points, sizes);
  find_routes(points);
  comm_->counters().note(Counter::ghosts, points.size() - points.owned());
}

void Halo::refresh(mesh::BinnedPoints& points) {
  std::vector<Message> counts_out, sites_out, counts_in, sites_in;
  for (const Peer& peer : exports_) {
    counts_out.push_back({peer.rank, {}});
    sites_out.push_back({peer.rank, {}});
    for (const BinRef& bin : peer.bins) {
      append(counts_out.back().data, sites_of(points, bin).end - sites_of(points, bin).begin);
      append_ghosts(points, bin, sites_out.back().data);
    }
  }
  std::vector<BinRef> imported; // ascending, because ranks own ascending tiles
  for (const Peer& peer : imports_) {
    counts_in.push_back({peer.rank, std::vector<std::byte>(peer.bins.size() * sizeof(std::int32_t))});
    imported.insert(imported.end(), peer.bins.begin(), peer.bins.end());
  }
  comm_->exchange_known(counts_out, counts_in);
  for (const Message& message : counts_in)
    sites_in.push_back(
        {message.peer, std::vector<std::byte>(sum_of(comm::from_bytes<std::int32_t>(message.data)) * sizeof(Ghost))});
  comm_->exchange_known(sites_out, sites_in);
  points.assign_ghosts(imported, concatenate<std::int32_t>(counts_in), concatenate<Ghost>(sites_in));
  find_routes(points);
  comm_->counters().note(Counter::ghosts, points.size() - points.owned());
}

/// Where that lies which a peer gets or sends; bins whose sites follow each other share a range.
Halo::Route Halo::route_of(const mesh::BinnedPoints& points, const Peer& peer, bool exported) {
  Route route{peer.rank, {}, {}, 0};
  for (std::size_t k = 0; k < peer.bins.size(); ++k) {
    const BinRef& bin = peer.bins[k];
    if (k == 0 || bin.tile != peer.bins[k - 1].tile)
      route.tiles.push_back(points.known_tile(bin.tile));
    const mesh::SiteRange range = exported ? sites_of(points, bin) : points.bin_range(bin);
    if (range.begin == range.end)
      continue;
    route.site_count += at(range.end - range.begin);
    if (!route.ranges.empty() && route.ranges.back().end == range.begin)
      route.ranges.back().end = range.end;
    else
      route.ranges.push_back(range);
  }
  return route;
}

/// @pre the ghosts are those of all subscribed bins
void Halo::find_routes(const mesh::BinnedPoints& points) {
  outward_.clear();
  inward_.clear();
  for (const Peer& peer : exports_)
    outward_.push_back(route_of(points, peer, true));
  for (const Peer& peer : imports_)
    inward_.push_back(route_of(points, peer, false));
}

template <class T>
std::vector<T> Halo::exchange_values(const mesh::BinnedPoints& points, std::span<const T> owned_values) const {
  std::vector<Message> outgoing, incoming;
  for (const Route& route : outward_) {
    outgoing.push_back({route.rank, {}});
    outgoing.back().data.reserve(route.site_count * sizeof(T));
    for (const auto [begin, end] : route.ranges)
      append(outgoing.back().data, owned_values.subspan(at(begin), at(end - begin)));
  }
  for (const Route& route : inward_)
    incoming.push_back({route.rank, std::vector<std::byte>(route.site_count * sizeof(T))});
  comm_->exchange_known(outgoing, incoming);
  std::vector<T> values(at(points.size() - points.owned()));
  for (std::size_t m = 0; m < incoming.size(); ++m) {
    Reader reader(incoming[m].data);
    for (const auto [begin, end] : inward_[m].ranges)
      reader.take(std::span(values).subspan(at(begin - points.owned()), at(end - begin)));
  }
  return values;
}

std::vector<GlobalId> Halo::exchange(const mesh::BinnedPoints& points, std::span<const GlobalId> owned_values) const {
  return exchange_values(points, owned_values);
}

std::vector<double> Halo::exchange(const mesh::BinnedPoints& points, std::span<const double> owned_values) const {
  return exchange_values(points, owned_values);
}

/// The other ranks that own ghosts of this one or have ghosts of it, ascending.
std::vector<int> Halo::peers() const {
  std::vector<int> ranks;
  for (const std::vector<Peer>* list : {&imports_, &exports_})
    for (const Peer& peer : *list)
      if (peer.rank != comm_->rank())
        ranks.push_back(peer.rank);
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

std::vector<GhostNews> Halo::tell_owners(const mesh::BinnedPoints& points, std::span<const LocalIndex> ghosts,
                                         std::span<const GhostNews> news) const {
  struct Source {
    LocalIndex first; // of a range of ghosts
    int rank;
  };
  std::vector<Source> sources; // ascending
  if (!ghosts.empty())
    for (const Route& route : inward_)
      for (const mesh::SiteRange& range : route.ranges)
        sources.push_back({range.begin, route.rank});
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.first < b.first; });
  std::vector<Message> outgoing;
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const auto source = std::upper_bound(sources.begin(), sources.end(), ghosts[k],
                                         [](LocalIndex ghost, const Source& s) { return ghost < s.first; });
    TRIME_ASSERT(source != sources.begin(), "site {} of {} is not a ghost", ghosts[k], points.size());
    const int rank = (source - 1)->rank;
    auto message = std::find_if(outgoing.begin(), outgoing.end(), [&](const Message& m) { return m.peer == rank; });
    if (message == outgoing.end())
      message = outgoing.insert(outgoing.end(), {rank, {}});
    append(message->data, news[k]);
  }
  return concatenate<GhostNews>(comm::exchange_among(*comm_, peers(), outgoing));
}

/// The news of all tiles of a peer, then the positions of its sites.
void Halo::begin_positions(const mesh::BinnedPoints& points) {
  TRIME_ASSERT(!grid_->periods().any() && !exchange_.is_open());
  const auto bytes_of = [](const Route& route) {
    return route.tiles.size() * sizeof(TileNews) + route.site_count * sizeof(geometry::Vec2);
  };
  std::vector<Message> outgoing;
  for (const Route& route : outward_) {
    outgoing.push_back({route.rank, {}});
    std::vector<std::byte>& data = outgoing.back().data;
    data.reserve(bytes_of(route));
    for (const LocalIndex tile : route.tiles)
      append(data, TileNews{points.drifts().of(tile), points.marks().of(tile)});
    for (const auto [begin, end] : route.ranges)
      append(data, points.positions().subspan(at(begin), at(end - begin)));
  }
  positions_.resize(inward_.size()); // with the memory of the last time
  for (std::size_t m = 0; m < inward_.size(); ++m) {
    positions_[m].peer = inward_[m].rank;
    positions_[m].data.resize(bytes_of(inward_[m]));
  }
  exchange_ = comm_->begin_exchange(std::move(outgoing), positions_);
}

void Halo::finish_positions(mesh::BinnedPoints& points) {
  exchange_.wait();
  const std::span<geometry::Vec2> ghosts = points.ghost_positions();
  comm_->counters().note(Counter::ghosts, std::ssize(ghosts));
  for (std::size_t m = 0; m < positions_.size(); ++m) {
    Reader reader(positions_[m].data);
    for (const LocalIndex tile : inward_[m].tiles) {
      const auto news = reader.take<TileNews>();
      points.drifts().set(tile, news.drift);
      points.marks().set(tile, news.mark != 0);
    }
    for (const auto [begin, end] : inward_[m].ranges)
      reader.take(ghosts.subspan(at(begin - points.owned()), at(end - begin)));
  }
}

} // namespace trime::decomposition
