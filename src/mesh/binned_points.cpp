// SPDX-License-Identifier: BSD-3-Clause
// When sites are sorted again, they are copied from array to array, one array after the other, so that there is never a
// second copy of all arrays.

#include "mesh/binned_points.hpp"

#include "core/thread_loop.hpp"
#include "mesh/site_sources.hpp"
#include "trime/core/error.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <numeric>

namespace trime::mesh {
namespace {

constexpr std::ptrdiff_t stay_chunk = 4096; // sites that one thread copies in a row

std::uint8_t stored_pushes(std::int32_t pushes) {
  return static_cast<std::uint8_t>(std::min(pushes, 255));
}

/// Positions in the new order, and the leads if they are wanted.
template <class Sites>
void take_places(const SiteOrder& order, const Sites& sites, UnsetVector<geometry::Vec2>& positions,
                 UnsetVector<geometry::Vec2>* leads) {
  positions.resize(at(order.size()));
  if (leads)
    leads->resize(positions.size());
  order.for_each([&](std::size_t k, LocalIndex from) {
    positions[k] = sites.position(from);
    if (leads)
      (*leads)[k] = sites.lead(from);
  });
}

/// Boundary indices and push counts in the new order. They may be read from the old vectors.
template <class Sites>
void take_labels(const SiteOrder& order, const Sites& sites, UnsetVector<std::int32_t>& boundary,
                 UnsetVector<std::uint8_t>& pushes) {
  UnsetVector<std::int32_t> new_boundary;
  UnsetVector<std::uint8_t> new_pushes;
  new_boundary.reserve(boundary.capacity()); // ghosts will follow
  new_boundary.resize(at(order.size()));
  new_pushes.resize(at(order.size()));
  order.for_each([&](std::size_t k, LocalIndex from) {
    new_boundary[k] = sites.boundary(from);
    new_pushes[k] = stored_pushes(sites.pushes(from));
  });
  boundary = std::move(new_boundary);
  pushes = std::move(new_pushes);
}

} // namespace

BinnedPoints::BinnedPoints(const TileGrid& grid) : bins_(grid) {}

std::vector<std::uint8_t> BinnedPoints::suitable_bin_bits(std::span<const Site> sites, LocalIndex first_tile,
                                                          LocalIndex last_tile) {
  order_.group(grid(), ListedSites(sites), first_tile, last_tile);
  state_ = State::grouped;
  return order_.suitable_bin_bits(grid(), sites);
}

LocalIndex BinnedPoints::assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                                      std::vector<LocalIndex>* new_index) {
  return assign(ListedSites(sites), first_tile, last_tile, new_index);
}

void BinnedPoints::restore_owned(std::span<const Site> sites, std::span<const std::int64_t> counts,
                                 LocalIndex first_tile, LocalIndex last_tile, std::vector<LocalIndex>& new_index) {
  UnsetVector<geometry::Vec2> homes(sites.size());
  std::size_t next = 0;
  for (LocalIndex tile = first_tile; tile < last_tile; ++tile)
    for (const std::size_t end = next + static_cast<std::size_t>(counts[at(tile - first_tile)]); next < end; ++next)
      homes[next] = grid().nearest_in(tile, sites[next].position);
  assign(HomedSites(sites, homes), first_tile, last_tile, &new_index);
}

template <class Sites>
LocalIndex BinnedPoints::assign(const Sites& list, LocalIndex first_tile, LocalIndex last_tile,
                                std::vector<LocalIndex>* new_index) {
  has_leads_ = true;
  if (!order_.is_grouped())
    order_.group(grid(), list, first_tile, last_tile);
  TRIME_ASSERT(order_.grouped() == list.size() && this->first_tile() == first_tile && this->last_tile() == last_tile,
               "{} sites of the tiles {}..{} were grouped before, but now there are {} of the tiles {}..{}",
               order_.grouped(), this->first_tile(), this->last_tile(), list.size(), first_tile, last_tile);
  const LocalIndex dropped = sort(list);
  take_places(order_, list, positions_, has_leads_ ? &leads_ : nullptr);
  take_labels(order_, list, boundary_, pushes_);
  if (new_index)
    order_.list_new_indices(list.size(), *new_index);
  order_.forget();
  return dropped;
}

void BinnedPoints::sort_moved(std::span<const std::uint8_t> gone, std::span<const Site> more,
                              std::vector<LocalIndex>& new_index) {
  TRIME_ASSERT(state_ == State::prepared, "sites can be sorted at their next places only after prepare_advance()");
  const MovedSites moved(*this, gone, more);
  const LocalIndex before = moved.size();
  order_.group(grid(), moved, first_tile(), last_tile());
  sort(moved);
  take_labels(order_, moved, boundary_, pushes_);
  take_places(order_, moved, positions_, has_leads_ ? &leads_ : nullptr); // over the old ones
  release(next_.positions_);
  release(next_.leads_);
  order_.list_new_indices(before, new_index);
  order_.forget();
}

/// Sets the order and the bins; returns how many sites were dropped.
template <class Sites>
LocalIndex BinnedPoints::sort(const Sites& sites) {
  bins_.own(first_tile(), last_tile());
  drifts_.forget(bins_.owned_tiles());
  marks_.forget(bins_.owned_tiles());
  state_ = State::sorted;
  const LocalIndex dropped = order_.sort(sites, bins_);
  owned_ = order_.size();
  return dropped;
}

void BinnedPoints::assign_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts,
                                 std::span<const Ghost> sites) {
  TRIME_ASSERT(state_ == State::sorted || state_ == State::prepared,
               "ghosts can be assigned only while there are sorted owned sites");
  bins_.forget_foreign();
  drifts_.make_room(bins_.owned_tiles());
  marks_.make_room(bins_.owned_tiles());
  positions_.resize(at(owned_));
  boundary_.resize(positions_.size());
  add_ghosts(bins, counts, sites);
}

void BinnedPoints::add_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts,
                              std::span<const Ghost> sites) {
  const std::int64_t announced = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  TRIME_ASSERT(announced == static_cast<std::int64_t>(sites.size()), "{} ghosts announced, {} received", announced,
               sites.size());
  positions_.reserve(positions_.size() + sites.size());
  boundary_.reserve(positions_.capacity());
  const LocalIndex first = size();
  LocalIndex next = first;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    const geometry::Vec2 shift = grid().shift(bins[k].image);
    for (const Ghost& ghost : sites.subspan(at(next - first), at(counts[k]))) {
      positions_.push_back(ghost.position + shift);
      boundary_.push_back(ghost.boundary);
    }
    bins_.add_foreign(bins[k], {next, next + counts[k]});
    next += counts[k];
  }
  drifts_.make_room(bins_.known_tiles());
  marks_.make_room(bins_.known_tiles());
}

void BinnedPoints::prepare_advance() {
  TRIME_ASSERT(state_ == State::sorted || state_ == State::prepared, "sites can move only after they were sorted");
  next_.positions_.resize(positions_.size());
  next_.leads_.resize(leads_.size());
  state_ = State::prepared;
}

void prepare_to_stay(BinnedPoints& points) {
  points.prepare_advance();
  const std::span<const geometry::Vec2> positions = points.positions().first(at(points.owned())),
                                        leads = points.leads();
  const std::ptrdiff_t chunks = (points.owned() + stay_chunk - 1) / stay_chunk;
  thread_loop(chunks, 1, [&](std::ptrdiff_t chunk, int) {
    const std::ptrdiff_t begin = chunk * stay_chunk, end = std::min<std::ptrdiff_t>(points.owned(), begin + stay_chunk);
    std::copy(positions.begin() + begin, positions.begin() + end, points.next().positions().begin() + begin);
    if (points.has_leads())
      std::copy(leads.begin() + begin, leads.begin() + end, points.next().leads().begin() + begin);
  });
}

bool has_coincident_sites(const BinnedPoints& points) {
  bool any = false;
  for (LocalIndex i = 0; i < points.owned() && !any; ++i)
    points.for_each_near(
        points.position(i), 0,
        [&](LocalIndex begin, LocalIndex end) {
          for (LocalIndex j = begin; j < end; ++j)
            any |= j != i && points.position(j) == points.position(i);
        },
        [](BinRef) {});
  return any;
}

void BinnedPoints::advance() {
  TRIME_ASSERT(state_ == State::prepared && next_.positions_.size() == positions_.size(),
               "there are {} sites, but {} next places", positions_.size(), next_.positions_.size());
  std::copy(positions_.begin() + owned_, positions_.end(), next_.positions_.begin() + owned_);
  positions_.swap(next_.positions_);
  leads_.swap(next_.leads_);
  state_ = State::sorted;
}

void BinnedPoints::release_leads() {
  TRIME_ASSERT(state_ == State::sorted || state_ == State::prepared,
               "leads can be released only while there are sorted sites");
  has_leads_ = false;
  release(leads_);
  release(next_.leads_);
  release(next_.positions_);
  state_ = State::sorted;
}

void BinnedPoints::release_moves() {
  release_leads();
  release(pushes_);
  bins_.release_ranges();
  state_ = State::released;
}

/// In their order, without those that are dropped. Sites at whose place another one is kept are added to `gone`.
std::vector<BinnedPoints::Newcomer> BinnedPoints::place_newcomers(std::span<const Site> come,
                                                                  std::vector<LocalIndex>& gone) const {
  std::vector<Newcomer> list;
  for (std::size_t k = 0; k < come.size(); ++k) {
    const LocalIndex tile = grid().tile_at(come[k].position);
    TRIME_ASSERT(tile >= first_tile() && tile < last_tile(),
                 "a site of tile {} was given to the owner of the tiles {}..{}", tile, first_tile(), last_tile());
    const int bin = grid().bin_at(come[k].position, tile, grid().bin_bits(tile));
    list.push_back({{tile, bin}, static_cast<LocalIndex>(k), 0});
  }
  const auto site_of = [&](const Newcomer& one) -> const Site& { return come[at(one.number)]; };
  std::sort(list.begin(), list.end(), [&](const Newcomer& a, const Newcomer& b) {
    return a.bin != b.bin ? a.bin < b.bin : precedes(site_of(a), site_of(b));
  });
  const auto same_place = [&](const Newcomer& a, const Newcomer& b) {
    return site_of(a).position == site_of(b).position;
  };
  list.erase(std::unique(list.begin(), list.end(), same_place), list.end());
  std::vector<Newcomer> kept;
  std::vector<LocalIndex> dropped;
  for (Newcomer& one : list) {
    const auto [begin, end] = bin_range(one.bin);
    const auto place = std::lower_bound(positions_.begin() + begin, positions_.begin() + end, site_of(one).position,
                                        geometry::lexicographically_less);
    one.place = static_cast<LocalIndex>(place - positions_.begin());
    if (one.place < end && *place == site_of(one).position &&
        !std::binary_search(gone.begin(), gone.end(), one.place)) {
      if (!precedes(site_of(one), site(one.place)))
        continue;
      dropped.push_back(one.place);
    }
    kept.push_back(one);
  }
  gone.insert(gone.end(), dropped.begin(), dropped.end());
  std::sort(gone.begin(), gone.end());
  return kept;
}

IndexShift BinnedPoints::edit(std::vector<LocalIndex> gone, std::span<const Site> come,
                              std::vector<LocalIndex>& new_index) {
  TRIME_ASSERT(state_ == State::sorted || state_ == State::prepared, "sites can be edited only while they are sorted");
  TRIME_ASSERT(drifts_.largest().distance == 0, "sites that have moved since the last sorting cannot be edited");
  assign_ghosts({}, {}, {});
  const std::vector<Newcomer> list = place_newcomers(come, gone);
  std::vector<LocalIndex> places;
  std::vector<BinRef> bins;
  for (const Newcomer& one : list) {
    places.push_back(one.place);
    bins.push_back(one.bin);
  }
  IndexShift shift(owned_, gone, places);
  order_.edit(shift, bins, bins_);
  owned_ = shift.after();
  shift.move(positions_);
  shift.move(boundary_);
  shift.move(pushes_);
  if (has_leads_)
    shift.move(leads_);
  new_index.assign(come.size(), -1);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Site& site = come[at(list[k].number)];
    const std::size_t i = at(shift.come()[k]);
    positions_[i] = site.position;
    boundary_[i] = site.boundary;
    if (has_leads_)
      leads_[i] = site.lead;
    pushes_[i] = static_cast<std::uint8_t>(std::min(site.pushes, 255));
    new_index[at(list[k].number)] = shift.come()[k];
  }
  release(next_.positions_);
  state_ = State::sorted;
  return shift;
}

} // namespace trime::mesh
