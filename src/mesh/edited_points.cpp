// SPDX-License-Identifier: BSD-3-Clause
// Makes a few changes of sites that are sorted: the bins show where each new site belongs.
#include "mesh/binned_points.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::mesh {

/// In their order, without those that are dropped. Sites at whose place another one is kept are added to `gone`.
std::vector<BinnedPoints::Newcomer> BinnedPoints::place_newcomers(std::span<const Site> come,
                                                                  std::vector<LocalIndex>& gone) const {
  std::vector<Newcomer> list;
  for (std::size_t k = 0; k < come.size(); ++k) {
    const LocalIndex tile = grid().tile_at(come[k].position);
    TRIME_ASSERT(tile >= first_tile() && tile < last_tile(), "site of tile {} given to the owner of {}..{}", tile,
                 first_tile(), last_tile());
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
  TRIME_ASSERT(state_ == State::sorted || state_ == State::prepared, "no sorted sites that could be edited");
  TRIME_ASSERT(!has_leads_ && drifts_.largest().distance == 0, "sites that move must be sorted, not edited");
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
  new_index.assign(come.size(), -1);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Site& site = come[at(list[k].number)];
    const std::size_t i = at(shift.come()[k]);
    positions_[i] = site.position;
    boundary_[i] = site.boundary;
    pushes_[i] = static_cast<std::uint8_t>(std::min(site.pushes, 255));
    new_index[at(list[k].number)] = shift.come()[k];
  }
  release(next_.positions_);
  state_ = State::sorted;
  return shift;
}

} // namespace trime::mesh
