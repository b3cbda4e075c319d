// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/inner_chords.hpp"

#include "trime/core/error.hpp"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace trime::polygon {

void InnerChords::sort_ends() {
  by_end.resize(2 * chords.size());
  std::iota(by_end.begin(), by_end.end(), LocalIndex{0});
  std::stable_sort(by_end.begin(), by_end.end(),
                   [this](LocalIndex a, LocalIndex b) { return geometry::lexicographically_less(end(a), end(b)); });
}

namespace {

/// Notes that the area on the left of an arc has grown.
void add_gain(geometry::RegionLoss& loss, int left, double gain) {
  const double lost = (loss.loser == left ? loss.area : -loss.area) - gain;
  if ((lost > 0) != (loss.loser == left))
    std::swap(loss.loser, loss.winner);
  loss.area = loss.largest = std::fabs(lost);
}

} // namespace

void InnerChords::move_sites(std::span<const InnerMove> moves) {
  std::vector<std::array<LocalIndex, 2>> halves; // the chord that leaves each site, and the one that arrives
  for (const InnerMove& move : moves) {
    const std::span<const LocalIndex> both = at(sites[static_cast<std::size_t>(move.site)]);
    TRIME_ASSERT(both.size() == 2, "a site that moves along a curve has {} edges of the curve instead of 2",
                 both.size());
    const bool first_leaves = both[0] % 2 == 0;
    halves.push_back({both[first_leaves ? 0 : 1], both[first_leaves ? 1 : 0]});
  }
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const auto site = static_cast<std::size_t>(moves[k].site);
    const auto [out, in] = halves[k];
    const geometry::Vec2 by = moves[k].position - sites[site];
    const std::int32_t circle = track[site];
    if (circle >= 0 && circles[static_cast<std::size_t>(circle)].loss >= 0) {
      const SlideCircle& its = circles[static_cast<std::size_t>(circle)];
      add_gain(losses[static_cast<std::size_t>(its.loss)], its.left,
               0.5 * geometry::cross(by, other_end(out) - other_end(in)));
    }
    chords[static_cast<std::size_t>(out / 2)].ends.a = chords[static_cast<std::size_t>(in / 2)].ends.b = sites[site] =
        moves[k].position;
  }
  sort_sites();
  sort_ends();
}

/// Restores the lexicographic order.
void InnerChords::sort_sites() {
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [this](std::size_t a, std::size_t b) { return geometry::lexicographically_less(sites[a], sites[b]); });
  const auto sorted = [&order](const auto& values) {
    auto result = values;
    for (std::size_t k = 0; k < order.size(); ++k)
      result[k] = values[order[k]];
    return result;
  };
  sites = sorted(sites);
  corner = sorted(corner);
  track = sorted(track);
}

} // namespace trime::polygon
