// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_sites.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <limits>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using polygon::EditKind;
using sites::Disc;
using sites::SiteState;

// What one thread takes at a time.
constexpr int discs_in_a_row = 16, edits_in_a_row = 64, sites_in_a_row = 4096;

/// Asks another rank which sites it has in a disc. The rank that asks may have narrowed the disc already.
struct DiscRequest {
  Disc widest;
  std::int32_t rank, index; // of the disc at the rank that asks
  std::int64_t narrowings;
};
/// Says how often the disc had to be narrowed; the sites follow in another list.
struct DiscReply {
  std::int32_t rank, index;
  std::int32_t narrowings, sites;
};

bool lies_in(const Disc& disc, Vec2 p) {
  return geometry::squared_length(p - disc.center) < disc.radius * disc.radius;
}

Disc narrowed(const Disc& widest, int narrowings) {
  return {widest.center, Surroundings::radius(widest.radius, narrowings)};
}

} // namespace

CleanupSites::CleanupSites(const comm::Communicator& comm, const SiteState& state, const sizing::SizeField& size)
    : comm_(comm), state_(state), size_(size), status_(at(state.points().owned()), SiteStatus::in_place),
      added_(at(state.points().last_tile() - state.points().first_tile())) {}

/// Calls visit(tile) for the tiles that meet the square around a disc.
template <class Visit>
void CleanupSites::for_each_tile(const Disc& disc, const Visit& visit) const {
  const mesh::TileGrid& grid = state_.grid();
  grid.for_each_in(grid.rect_around(disc.center, disc.radius),
                   [&](LocalIndex tile, int, const mesh::FixedRect&) { visit(tile); });
}

std::vector<int> CleanupSites::ranks_near(const Disc& disc) const {
  std::vector<int> ranks;
  if (comm_.size() == 1)
    return ranks;
  for_each_tile(disc, [&](LocalIndex tile) { ranks.push_back(state_.partition().owner(tile)); });
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  std::erase(ranks, comm_.rank());
  return ranks;
}

/// Lists the sites of this rank in a disc: all of them, or more than `most`.
void CleanupSites::list_sites(const Disc& disc, std::size_t most, std::vector<PatchSite>& sites) const {
  const mesh::BinnedPoints& points = state_.points();
  const geometry::Periods& periods = state_.grid().periods();
  sites.clear();
  const auto add = [&](Vec2 canonical, double size, std::int32_t boundary, bool rests) {
    const Vec2 p = periods.nearest_image(canonical, disc.center);
    if (lies_in(disc, p))
      sites.push_back({p, size, boundary, rests});
  };
  const auto add_range = [&](LocalIndex begin, LocalIndex end) {
    for (LocalIndex j = begin; j < std::min(end, points.owned()) && sites.size() <= most; ++j)
      if (status_[at(j)] != SiteStatus::gone)
        add(points.position(j), state_.sizes()[j], points.boundary(j), status_[at(j)] == SiteStatus::rests);
  };
  std::vector<LocalIndex> tiles;
  for_each_tile(disc, [&](LocalIndex tile) {
    if (tile >= points.first_tile() && tile < points.last_tile())
      tiles.push_back(tile);
  });
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end()); // two images of one
  if (!periods.any())
    points.for_each_near(disc.center, disc.radius, add_range, [](mesh::BinRef) {});
  for (const LocalIndex tile : tiles) {
    if (periods.any()) {
      const auto [begin, end] = points.tile_range(tile);
      add_range(begin, end);
    }
    for (const Added& site : added_in(tile))
      add(site.position, site.size, site.boundary, site.rests);
  }
}

/// Lists the sites of this rank, after as few narrowings as do, but no fewer than there are already.
void CleanupSites::narrow_down(const Disc& widest, std::size_t most, Surroundings& own) const {
  for (; !own.is_crowded(); ++own.narrowings) {
    list_sites(narrowed(widest, own.narrowings), most, own.sites);
    if (own.sites.size() <= most)
      return;
  }
  own.sites.clear();
}

/// Adds what another rank knows. Both lists are whole in their discs, so the sum is in the narrower one.
void CleanupSites::merge(Surroundings& all, const Disc& widest, std::size_t most, std::span<const PatchSite> more,
                         int narrowings) {
  all.sites.insert(all.sites.end(), more.begin(), more.end());
  all.narrowings = std::max(all.narrowings, narrowings);
  for (; !all.is_crowded(); ++all.narrowings) {
    const Disc disc = narrowed(widest, all.narrowings);
    std::erase_if(all.sites, [&](const PatchSite& site) { return !lies_in(disc, site.position); });
    if (all.sites.size() <= most)
      return;
  }
  all.sites.clear();
}

std::vector<Surroundings> CleanupSites::around(std::span<const Disc> discs, std::size_t most) const {
  std::vector<Surroundings> all(discs.size());
  thread_loop(static_cast<std::ptrdiff_t>(discs.size()), discs_in_a_row, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    narrow_down(discs[k], most, all[k]);
  });
  if (comm_.size() == 1)
    return all;
  std::map<int, std::vector<DiscRequest>> requests;
  for (std::size_t k = 0; k < discs.size(); ++k)
    for (const int rank : ranks_near(discs[k]))
      requests[rank].push_back({discs[k], comm_.rank(), static_cast<std::int32_t>(k), all[k].narrowings});
  std::map<int, std::vector<DiscReply>> replies;
  std::map<int, std::vector<PatchSite>> sites;
  Surroundings own;
  for (const DiscRequest& request : send(comm_, requests)) {
    own.narrowings = static_cast<int>(request.narrowings);
    narrow_down(request.widest, most, own);
    replies[request.rank].push_back(
        {comm_.rank(), request.index, own.narrowings, static_cast<std::int32_t>(own.sites.size())});
    std::vector<PatchSite>& list = sites[request.rank];
    list.insert(list.end(), own.sites.begin(), own.sites.end());
  }
  const std::vector<DiscReply> heads = send(comm_, replies);
  const std::vector<PatchSite> bodies = send(comm_, sites); // from the same ranks, in the same order
  std::size_t next = 0;
  for (const DiscReply& reply : heads) {
    const auto k = static_cast<std::size_t>(reply.index), count = static_cast<std::size_t>(reply.sites);
    merge(all[k], discs[k], most, std::span(bodies).subspan(next, count), reply.narrowings);
    next += count;
  }
  return all;
}

/// The owned site of the state that is still there, or -1.
LocalIndex CleanupSites::find_in_state(Vec2 p) const {
  const mesh::BinnedPoints& points = state_.points();
  LocalIndex found = -1;
  points.for_each_near(
      p, 0,
      [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex j = begin; j < end && j < points.owned(); ++j)
          if (points.position(j) == p && status_[at(j)] != SiteStatus::gone)
            found = j;
      },
      [](mesh::BinRef) {});
  return found;
}

CleanupSites::Added& CleanupSites::find_added(Vec2 p) {
  std::vector<Added>& added = added_in(state_.grid().place(p).tile);
  const auto found = std::find_if(added.begin(), added.end(), [&](const Added& site) { return site.position == p; });
  TRIME_ASSERT(found != added.end(), "no site at ({}, {})", p.x, p.y);
  return *found;
}

/// @return the index of the owned site that it was at the beginning, or -1
LocalIndex CleanupSites::take_out(Vec2 p) {
  if (const LocalIndex i = find_in_state(p); i >= 0) {
    status_[at(i)] = SiteStatus::gone;
    return i;
  }
  Added& added = find_added(p);
  const LocalIndex origin = added.origin;
  std::vector<Added>& list = added_in(state_.grid().place(p).tile);
  added = list.back();
  list.pop_back();
  return origin;
}

void CleanupSites::set_rest(Vec2 p, bool rests) {
  if (const LocalIndex i = find_in_state(p); i >= 0)
    status_[at(i)] = rests ? SiteStatus::rests : SiteStatus::in_place;
  else
    find_added(p).rests = rests;
}

std::vector<Vec2> CleanupSites::let_rest(const Disc& disc) {
  std::vector<PatchSite> sites;
  list_sites(disc, std::numeric_limits<std::size_t>::max(), sites);
  std::vector<Vec2> places;
  for (const PatchSite& site : sites) {
    places.push_back(state_.grid().periods().wrap(site.position));
    set_rest(places.back(), true);
  }
  return places;
}

void CleanupSites::apply(std::span<const SiteEdit> edits) {
  std::vector<LocalIndex> origins(edits.size(), -1);
  for (std::size_t k = 0; k < edits.size(); ++k) // first all that go: one may come where another was
    if (edits[k].kind != EditKind::insert && owner(edits[k].from) == comm_.rank())
      origins[k] = take_out(edits[k].from);
  std::vector<double> sizes(edits.size(), 0);
  comm::run_agreed(comm_, [&] {
    thread_loop(static_cast<std::ptrdiff_t>(edits.size()), edits_in_a_row, [&](std::ptrdiff_t item, int) {
      const SiteEdit& edit = edits[static_cast<std::size_t>(item)];
      if (edit.kind != EditKind::remove && owner(edit.to) == comm_.rank())
        sizes[static_cast<std::size_t>(item)] = sizing::checked_size(size_, edit.to);
    });
  });
  for (std::size_t k = 0; k < edits.size(); ++k)
    if (sizes[k] > 0)
      added_in(state_.grid().place(edits[k].to).tile).push_back({edits[k].to, sizes[k], edits[k].boundary, origins[k]});
}

void CleanupSites::finish(SiteState& state, std::span<const LocalIndex> new_index) const {
  mesh::BinnedPoints& points = state.points();
  const auto renumbered = [&](std::int32_t boundary) {
    return boundary >= 0 ? new_index[static_cast<std::size_t>(boundary)] : boundary;
  };
  prepare_to_stay(points);
  std::vector<std::uint8_t> deleted(at(points.owned()), 0);
  thread_loop(points.owned(), sites_in_a_row, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<LocalIndex>(item);
    deleted[at(i)] = status_[at(i)] == SiteStatus::gone;
    points.set_boundary(i, !deleted[at(i)] ? renumbered(points.boundary(i)) : mesh::free_site);
  });
  mesh::SiteList more;
  for (const std::vector<Added>& list : added_)
    for (const Added& added : list)
      if (added.origin >= 0) {
        points.next().positions()[at(added.origin)] = added.position;
        points.set_boundary(added.origin, renumbered(added.boundary));
        deleted[at(added.origin)] = 0;
      } else {
        more.push_back({added.position, renumbered(added.boundary)});
      }
  state.move_sites(std::move(deleted), std::move(more));
}

} // namespace trime::cleanup
