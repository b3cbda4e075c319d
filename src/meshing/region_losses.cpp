// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/region_losses.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace trime::meshing {
namespace {

using geometry::RegionLoss;

// [area of the region] Smaller sums are rounding errors.
constexpr double least_share = 1e-9;

auto key(const RegionLoss& loss) {
  return std::tuple(loss.loser, loss.winner, loss.reason);
}

} // namespace

std::vector<RegionLoss> summed_losses(std::vector<RegionLoss> losses, const geometry::Regions& regions) {
  std::stable_sort(losses.begin(), losses.end(),
                   [](const RegionLoss& a, const RegionLoss& b) { return key(a) < key(b); });
  std::vector<RegionLoss> sums;
  for (const RegionLoss& loss : losses) {
    if (sums.empty() || key(sums.back()) != key(loss)) {
      sums.push_back(loss);
      continue;
    }
    RegionLoss& sum = sums.back();
    sum.area += loss.area;
    sum.count += loss.count;
    if (loss.largest > sum.largest) {
      sum.largest = loss.largest;
      sum.place = loss.place;
    }
  }
  const auto area = [&](int region) { return regions.areas[static_cast<std::size_t>(region)]; };
  std::erase_if(sums, [&](const RegionLoss& sum) {
    return !(sum.area > least_share * std::fmin(area(sum.loser), area(sum.winner)));
  });
  return sums;
}

} // namespace trime::meshing
