// SPDX-License-Identifier: BSD-3-Clause
// What a sweep measures, and the check of all stars.
#include "meshing/sweeper.hpp"

#include "trime/core/error.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>

namespace trime::meshing {
namespace {

constexpr LocalIndex most_measured = 1024;    // sites in one call of the kernel
constexpr std::size_t bytes_for_measures = 4; // a site: for what is kept of tiles that sleep

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace

void Sweeper::measure_tile(const SweepTask& all, LocalIndex tile, double reference_size, std::vector<double>& excesses,
                           SweepSums& sums) const {
  const QualityKernel kernel = sweep_kernels().measure;
  const StarView view = view_of(state_, context_.size);
  const auto [first, last] = state_.points().tile_range(tile);
  for (LocalIndex begin = first; begin < last; begin += most_measured) {
    const LocalIndex end = std::min(last, begin + most_measured);
    excesses.resize(std::max(excesses.size(), 8 * at(end - begin)));
    const QualityTally tally = kernel(all, begin, end, 1 / reference_size, excesses.data());
    sums.squared_length_ratio.add_units(tally.squared_lengths);
    sums.squared_size_ratio.add_units(tally.squared_sizes);
    sums.excess_alpha.add_units(tally.excess);
    sums.triangles += tally.triangles;
    sums.max_alpha = std::max(sums.max_alpha, 1 + tally.largest_excess);
    for (std::int64_t k = 0; k < tally.triangles; ++k)
      sums.alpha_bins.add(excesses[static_cast<std::size_t>(k)]);
    for (LocalIndex i = begin; i < end; ++i)
      if (classes_[at(i)] == SiteClass::exact || classes_[at(i)] == SiteClass::fixed)
        measure_star(view, i, reference_size, sums);
  }
}

SweepSums Sweeper::measure(double reference_size) {
  SweepTask all = task();
  all.least_class = SiteClass::bordered;
  const LocalIndex first_tile = state_.points().first_tile();
  const std::size_t tiles = wide_.size();
  const bool keeps = tiles * sizeof(SweepSums) < bytes_for_measures * at(state_.points().owned());
  if (keeps && measured_.size() != tiles) {
    measured_.resize(tiles);
    is_measured_.assign(tiles, 0);
  }
  struct Measured {
    SweepSums sums;
    std::vector<double> excesses;
  };
  PerThread<Measured> of_thread;
  thread_loop(static_cast<std::ptrdiff_t>(tiles), 1, [&](std::ptrdiff_t t, int thread) {
    Measured& work = of_thread[thread];
    const LocalIndex tile = first_tile + static_cast<LocalIndex>(t);
    if (!keeps) {
      measure_tile(all, tile, reference_size, work.excesses, work.sums);
      return;
    }
    SweepSums& sums = measured_[static_cast<std::size_t>(t)];
    if (!is_measured_[static_cast<std::size_t>(t)]) {
      sums = {};
      measure_tile(all, tile, reference_size, work.excesses, sums);
      is_measured_[static_cast<std::size_t>(t)] = 1;
    }
    work.sums.add(sums);
  });
  SweepSums sums;
  for (const Measured& work : of_thread)
    sums.add(work.sums);
  return sums;
}

void Sweeper::verify() const {
  const mesh::BinnedPoints& points = state_.points();
  delaunay::StarTable all;
  all.reset(points.owned());
  std::vector<LocalIndex> sites, affected;
  for (LocalIndex i = 0; i < points.owned(); ++i)
    if (classes_[at(i)] != SiteClass::held)
      sites.push_back(i);
  std::vector<mesh::BinRef> missing;
  builder_.certify(points, all, state_.sizes(), sites, affected, missing);
  std::int64_t different = 0;
  for (const LocalIndex i : sites)
    different += all.certain(i) && !std::ranges::equal(all.ring(i), state_.stars().ring(i));
  if (const std::int64_t sum = state_.comm().sum(different); sum > 0)
    throw InternalError(fmt::format("{} stars differ from those computed anew", sum));
}

} // namespace trime::meshing
