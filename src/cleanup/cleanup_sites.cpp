// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_sites.hpp"

#include "comm/neighbours.hpp"
#include "comm/parcel.hpp"
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

// The number of items that one thread takes at a time.
constexpr int discs_in_a_row = 16, sites_in_a_row = 4096;

/// Says how often a disc had to be narrowed; the sites follow in another list.
struct DiscReply {
  std::int32_t number, narrowings;
  std::int64_t sites;
};

/// Returns the answer to another rank: its discs among `near`, and the sites that this rank has found in them.
comm::Message reply_to(int rank, std::span<const PatchDisc> near, std::span<const Surroundings> found) {
  std::vector<DiscReply> replies;
  std::vector<PatchSite> sites;
  for (std::size_t k = 0; k < near.size(); ++k)
    if (near[k].rank == rank) {
      replies.push_back({near[k].number, found[k].narrowings, std::ssize(found[k].sites)});
      sites.insert(sites.end(), found[k].sites.begin(), found[k].sites.end());
    }
  comm::Parcel parcel;
  parcel.add(replies);
  parcel.add(sites);
  return {rank, parcel.release()};
}

bool lies_in(const Disc& disc, Vec2 p) {
  return geometry::squared_length(p - disc.center) < disc.radius * disc.radius;
}

Disc narrowed(const Disc& widest, int narrowings) {
  return {widest.center, Surroundings::radius(widest.radius, narrowings)};
}

} // namespace

CleanupSites::CleanupSites(const SiteState& state, CleanupBoundary& boundary)
    : state_(state), boundary_(boundary), status_(at(state.points().owned()), SiteStatus::in_place),
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
  if (state_.comm().size() == 1)
    return ranks;
  for_each_tile(disc, [&](LocalIndex tile) { ranks.push_back(state_.partition().owner(tile)); });
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  std::erase(ranks, state_.comm().rank());
  return ranks;
}

/// Lists the sites of this rank in a disc: all of them, or more than `most`.
void CleanupSites::list_sites(const Disc& disc, std::size_t most, std::vector<PatchSite>& sites) const {
  const mesh::BinnedPoints& points = state_.points();
  const geometry::Periods& periods = state_.grid().periods();
  sites.clear();
  const auto add = [&](Vec2 canonical, double size, BoundaryName boundary, bool rests) {
    const Vec2 p = periods.nearest_image(canonical, disc.center);
    if (lies_in(disc, p))
      sites.push_back({p, size, boundary, rests, boundary >= 0 ? boundary_.place(boundary) : BoundaryPlace{}});
  };
  const auto name_of = [&](LocalIndex j) {
    const std::int32_t boundary = points.boundary(j);
    return boundary == mesh::fixed_site ? boundary_.name_inside(points.position(j)) : BoundaryName{boundary};
  };
  const auto add_range = [&](LocalIndex begin, LocalIndex end) {
    for (LocalIndex j = begin; j < std::min(end, points.owned()) && sites.size() <= most; ++j)
      if (status_[at(j)] != SiteStatus::gone)
        add(points.position(j), state_.sizes()[j], name_of(j), status_[at(j)] == SiteStatus::rests);
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

std::vector<Surroundings> CleanupSites::around(std::span<const PatchDisc> own, std::span<const PatchDisc> near,
                                               std::span<const int> partners, std::size_t most) const {
  const auto list = [&](std::span<const PatchDisc> discs) {
    std::vector<Surroundings> found(discs.size());
    thread_loop(std::ssize(found), discs_in_a_row, [&](std::ptrdiff_t item, int) {
      const auto k = static_cast<std::size_t>(item);
      narrow_down(discs[k].disc, most, found[k]);
    });
    return found;
  };
  std::vector<Surroundings> all = list(own);
  const std::vector<Surroundings> theirs = list(near);
  std::vector<comm::Message> outgoing;
  for (const int rank : partners)
    outgoing.push_back(reply_to(rank, near, theirs));
  for (comm::Message& message : comm::exchange_among(state_.comm(), partners, outgoing)) {
    comm::Parcel parcel(std::move(message.data));
    const auto replies = parcel.take<DiscReply>();
    const auto sites = parcel.take<PatchSite>();
    std::size_t next = 0;
    for (const DiscReply& reply : replies) {
      const auto disc = std::lower_bound(own.begin(), own.end(), reply.number,
                                         [](const PatchDisc& a, std::int32_t number) { return a.number < number; });
      const auto count = static_cast<std::size_t>(reply.sites);
      merge(all[static_cast<std::size_t>(disc - own.begin())], disc->disc, most, std::span(sites).subspan(next, count),
            reply.narrowings);
      next += count;
    }
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

void CleanupSites::take_out(Vec2 p) {
  if (const LocalIndex i = find_in_state(p); i >= 0) {
    status_[at(i)] = SiteStatus::gone;
    return;
  }
  Added& added = find_added(p);
  std::vector<Added>& list = added_in(state_.grid().place(p).tile);
  added = list.back();
  list.pop_back();
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

void CleanupSites::apply(std::span<const SiteEdit> edits, std::span<const BoundaryLink> links) {
  for (const SiteEdit& edit : edits) { // first all that go: one may come where another was
    if (edit.kind == EditKind::insert || !owns(edit.from))
      continue;
    take_out(edit.from);
    if (edit.boundary >= 0)
      boundary_.forget(edit.boundary);
  }
  for (const SiteEdit& edit : edits) {
    if (edit.kind == EditKind::remove || !owns(edit.to))
      continue;
    const BoundaryName name = edit.kind == EditKind::insert ? edit.made : edit.boundary;
    added_in(state_.grid().place(edit.to).tile).push_back({edit.to, edit.size, name});
    if (name >= 0)
      boundary_.set_place(name, edit);
  }
  for (const BoundaryLink& link : links)
    if (owns(link.position))
      boundary_.set_next(link.site, link.next);
}

/// A site that has moved begins again, as it does where another rank owns its new place: pushes are not kept.
void CleanupSites::finish(SiteState& state, const delaunay::StarBuilder& builder) const {
  mesh::BinnedPoints& points = state.points();
  if (boundary_.has_new_indices())
    thread_loop(points.owned(), sites_in_a_row, [&](std::ptrdiff_t item, int) {
      const auto i = static_cast<LocalIndex>(item);
      if (const std::int32_t name = points.boundary(i); name >= 0 && status_[at(i)] != SiteStatus::gone)
        points.set_boundary(i, boundary_.index(name));
    });
  std::vector<LocalIndex> gone;
  for (LocalIndex i = 0; i < points.owned(); ++i)
    if (status_[at(i)] == SiteStatus::gone)
      gone.push_back(i);
  mesh::SiteList come;
  std::vector<double> sizes;
  for (const std::vector<Added>& list : added_)
    for (const Added& added : list) {
      come.push_back({added.position, added.boundary >= 0                ? boundary_.index(added.boundary)
                                      : added.boundary <= first_on_curve ? mesh::fixed_site
                                                                         : static_cast<std::int32_t>(added.boundary)});
      sizes.push_back(added.size);
    }
  state.edit_sites(builder, std::move(gone), std::move(come), sizes);
}

} // namespace trime::cleanup
