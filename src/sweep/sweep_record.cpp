// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweep_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace trime::sweep {
namespace {

using sites::SiteState;

/// Integers that travel together.
class Packer {
public:
  void add(std::int64_t value) { values.push_back(value); }
  void add(const FixedSum& sum) {
    const auto parts = sum.split();
    values.push_back(parts.low);
    values.push_back(parts.high);
  }
  std::int64_t take() { return values[next_++]; }
  FixedSum take_sum() {
    const std::int64_t low = take(), high = take();
    return FixedSum::join({low, high});
  }

  std::vector<std::int64_t> values;

private:
  std::size_t next_ = 0;
};

} // namespace

SweepSummary summarize_sweep(const SiteState& state, Sweeper& sweeper, const Sweeper::Counts& counts,
                             double typical_size, GlobalId held) {
  SweepSummary summary;
  SweepSums& sums = summary.sums;
  SweepRecord& record = summary.record;
  sums = sweeper.measure(typical_size);
  Packer packer;
  for (const FixedSum* sum : {&sums.squared_length_ratio, &sums.squared_size_ratio, &sums.excess_alpha})
    packer.add(*sum);
  packer.add(sums.triangles);
  packer.add(std::int64_t{state.points().owned()});
  for (const std::int64_t count : sums.alpha_bins.counts())
    packer.add(count);
  state.comm().sum_and_max(packer.values, std::span(&sums.max_alpha, 1));

  for (FixedSum* sum : {&sums.squared_length_ratio, &sums.squared_size_ratio, &sums.excess_alpha})
    *sum = packer.take_sum();
  sums.triangles = packer.take();
  record.points = packer.take();
  for (std::int64_t& count : sums.alpha_bins.counts())
    count = packer.take();
  record.mean_alpha = 1 + (sums.triangles > 0 ? sums.excess_alpha.value() / static_cast<double>(sums.triangles) : 0);
  record.median_alpha = 1 + sums.alpha_bins.median();
  record.max_alpha = sums.max_alpha;
  record.max_move = counts.max_move;
  record.rebuilt_stars = counts.rebuilt;
  record.pushed = counts.pushed;
  record.deleted = counts.deleted;
  sums.power = counts.power;
  const GlobalId inner = record.points - held;
  record.moving_share = inner > 0 ? static_cast<double>(counts.moving) / static_cast<double>(inner) : 0;
  return summary;
}

std::string table_header() {
  return "sweep stage       points  alpha: median      mean      max  moving %  max move/h  rebuilt stars  seconds";
}

std::string table_row(const SweepRecord& r) {
  return fmt::format("{:>5} {:>5} {:>12} {:>14.5f} {:>9.5f} {:>8} {:>9.2f} {:>11.3f} {:>14} {:>8.2f}", r.sweep, r.stage,
                     r.points, r.median_alpha, r.mean_alpha,
                     r.max_alpha < 1000 ? fmt::format("{:.3f}", r.max_alpha) : fmt::format("{:.1e}", r.max_alpha),
                     100 * r.moving_share, r.max_move, r.rebuilt_stars, r.seconds);
}

std::string live_text(const SweepRecord& r) {
  return fmt::format("sweep {}, alpha median {:.4f}, max {:.3g}, {:.1f} % move", r.sweep, r.median_alpha, r.max_alpha,
                     100 * r.moving_share);
}

} // namespace trime::sweep
