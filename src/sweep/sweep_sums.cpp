// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweep_sums.hpp"

#include "core/thread_loop.hpp"
#include "sweep/rule_formulas.hpp"
#include "sweep/rules.hpp"

#include <algorithm>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using sites::StarView;

/// A triangle with several inner sites is measured from the lexicographically smallest of them.
bool is_measured_from(const mesh::BinnedPoints& points, Vec2 p, LocalIndex a, LocalIndex b) {
  const geometry::Periods& periods = points.grid().periods();
  return (points.boundary(a) >= 0 || periods.less(p, points.position(a))) &&
         (points.boundary(b) >= 0 || periods.less(p, points.position(b)));
}

} // namespace

void SweepSums::add(const SweepSums& other) {
  squared_length_ratio.add(other.squared_length_ratio);
  squared_size_ratio.add(other.squared_size_ratio);
  excess_alpha.add(other.excess_alpha);
  alpha_bins.add(other.alpha_bins);
  triangles += other.triangles;
  max_alpha = std::max(max_alpha, other.max_alpha);
  power.add(other.power);
}

bool SweepSums::has_same_measures(const SweepSums& other) const {
  const auto same = [](const FixedSum& a, const FixedSum& b) {
    return a.split().low == b.split().low && a.split().high == b.split().high;
  };
  return same(squared_length_ratio, other.squared_length_ratio) && same(squared_size_ratio, other.squared_size_ratio) &&
         same(excess_alpha, other.excess_alpha) && alpha_bins.counts() == other.alpha_bins.counts() &&
         triangles == other.triangles && max_alpha == other.max_alpha;
}

void measure_star(const StarView& view, LocalIndex i, double reference_size, SweepSums& sums) {
  const std::span<const LocalIndex> ring = view.stars.ring(i);
  const Vec2 p = view.points.position(i);
  const double own_size = view.size(i), inverse = 1 / reference_size;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LocalIndex i_a = ring[k], i_b = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (i_a == delaunay::gap)
      continue;
    const Spoke<double> a = spoke_to(view, p, i_a);
    const double h = view.is_uniform() ? own_size * inverse : 0.5 * (own_size + a.size) * inverse;
    sums.squared_length_ratio.add(std::min(SweepRules::largest_term, a.squared * (inverse * inverse)));
    sums.squared_size_ratio.add(std::min(SweepRules::largest_term, h * h));
    if (i_b == delaunay::gap || !is_measured_from(view.points, p, i_a, i_b))
      continue;
    const Spoke<double> b = spoke_to(view, p, i_b);
    const double excess = excess_of_alpha(a, b, a.x * b.y - a.y * b.x);
    sums.excess_alpha.add(std::min(excess, SweepRules::largest_excess_term));
    sums.alpha_bins.add(excess);
    sums.max_alpha = std::max(sums.max_alpha, 1 + excess);
    ++sums.triangles;
  }
}

TileSums::TileSums(const SweepSums& sums)
    : squared_length_ratio_(sums.squared_length_ratio), squared_size_ratio_(sums.squared_size_ratio),
      excess_alpha_(sums.excess_alpha), max_alpha_(sums.max_alpha),
      triangles_(static_cast<std::uint16_t>(sums.triangles)) {
  std::ranges::transform(sums.alpha_bins.counts(), alpha_counts_.begin(),
                         [](std::int64_t count) { return static_cast<std::uint16_t>(count); });
}

void TileSums::add_to(SweepSums& sums) const {
  sums.squared_length_ratio.add(squared_length_ratio_);
  sums.squared_size_ratio.add(squared_size_ratio_);
  sums.excess_alpha.add(excess_alpha_);
  sums.triangles += triangles_;
  sums.max_alpha = std::max(sums.max_alpha, max_alpha_);
  for (std::size_t k = 0; k < alpha_counts_.size(); ++k)
    sums.alpha_bins.counts()[k] += alpha_counts_[k];
}

SweepSums measure(const StarView& view, double reference_size) {
  PerThread<SweepSums> of_thread;
  const LocalIndex first_tile = view.points.first_tile();
  thread_loop(view.points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int thread) {
    const auto [begin, end] = view.points.tile_range(first_tile + static_cast<LocalIndex>(t));
    SweepSums& sums = of_thread[thread];
    for (LocalIndex i = begin; i < end; ++i)
      if (view.points.boundary(i) < 0)
        measure_star(view, i, reference_size, sums);
  });
  SweepSums all;
  for (const SweepSums& sums : of_thread)
    all.add(sums);
  return all;
}

namespace {

using sites::StarView;

// [bytes a site] The measures of a tile are kept for sweeps in which it sleeps, unless all tiles of a rank together
// take more than this and more than small_measures.
constexpr std::size_t bytes_for_measures = 4;
// [bytes] Measures of this size are always kept: tiles of a small mesh have few sites.
constexpr std::size_t small_measures = std::size_t{1} << 20;

/// The sums of a thread, and its buffer for the excesses of the kernel.
struct ThreadSums {
  SweepSums sums, of_tile;
  std::vector<double> excesses;
};

/// Adds the stars of a tile: those of local and bordered sites by the kernel, the others one by one.
void measure_tile(const SweepTask& all, const StarView& view, LocalIndex tile, double reference_size,
                  std::vector<double>& excesses, SweepSums& sums) {
  const QualityKernel kernel = sweep_kernels().measure;
  const auto [first, last] = view.points.tile_range(tile);
  for (LocalIndex begin = first; begin < last; begin += most_measured) {
    const LocalIndex end = std::min(last, begin + most_measured);
    excesses.resize(std::max(excesses.size(), delaunay::StarTable::slots * static_cast<std::size_t>(end - begin)));
    const QualityTally tally = kernel(all, begin, end, 1 / reference_size, excesses.data());
    sums.squared_length_ratio.add_units(tally.squared_lengths);
    sums.squared_size_ratio.add_units(tally.squared_sizes);
    sums.excess_alpha.add_units(tally.excess);
    sums.triangles += tally.triangles;
    sums.max_alpha = std::max(sums.max_alpha, 1 + tally.largest_excess);
    for (std::int64_t k = 0; k < tally.triangles; ++k)
      sums.alpha_bins.add(excesses[static_cast<std::size_t>(k)]);
    for (LocalIndex i = begin; i < end; ++i)
      if (all.classes[i] == SiteClass::exact || all.classes[i] == SiteClass::fixed)
        measure_star(view, i, reference_size, sums);
  }
}

} // namespace

void StarMeasures::reset() {
  of_tile_.clear();
  is_measured_.clear();
}

SweepSums StarMeasures::measure(const SweepTask& task, const StarView& view, double reference_size) {
  SweepTask all = task;
  all.least_class = SiteClass::bordered;
  const LocalIndex first_tile = view.points.first_tile();
  const std::size_t tiles = static_cast<std::size_t>(view.points.last_tile() - first_tile);
  const bool keeps = tiles * sizeof(TileSums) <=
                     std::max(small_measures, bytes_for_measures * static_cast<std::size_t>(view.points.owned()));
  if (keeps && of_tile_.size() != tiles) {
    of_tile_.resize(tiles);
    is_measured_.assign(tiles, 0);
  }
  PerThread<ThreadSums> of_thread;
  thread_loop(static_cast<std::ptrdiff_t>(tiles), 1, [&](std::ptrdiff_t item, int thread) {
    ThreadSums& mine = of_thread[thread];
    const std::size_t t = static_cast<std::size_t>(item);
    const LocalIndex tile = first_tile + static_cast<LocalIndex>(item);
    if (!keeps) {
      measure_tile(all, view, tile, reference_size, mine.excesses, mine.sums);
      return;
    }
    if (is_measured_[t]) {
      of_tile_[t].add_to(mine.sums);
      return;
    }
    mine.of_tile = {};
    measure_tile(all, view, tile, reference_size, mine.excesses, mine.of_tile);
    mine.sums.add(mine.of_tile);
    is_measured_[t] = TileSums::can_keep(mine.of_tile);
    if (is_measured_[t])
      of_tile_[t] = TileSums(mine.of_tile);
  });
  SweepSums sums;
  for (const ThreadSums& one : of_thread)
    sums.add(one.sums);
  return sums;
}

} // namespace trime::sweep
