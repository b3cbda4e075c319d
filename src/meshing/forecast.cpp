// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/forecast.hpp"

#include "meshing/rules.hpp"
#include "start/rules.hpp"
#include "sweep/rules.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using Records = std::span<const sweep::SweepRecord>;

/// Returns the records of the last stage.
Records records_of_stage(Records history) {
  std::size_t first = history.size();
  while (first > 0 && history[first - 1].stage == history.back().stage)
    --first;
  return history.subspan(first);
}

/// If the excess of alpha falls as a power of the sweeps, its gain in a window falls as their inverse.
double sweeps_left(Records records, double tolerance, int max_sweeps) {
  const sweep::SweepRecord& last = records.back();
  const int done = last.sweep - records.front().sweep;
  double left = std::max(ForecastRules::usual_sweeps - done, sweep::StopRules::measuring_interval);
  const auto before = std::find_if(records.rbegin(), records.rend(), [&](const sweep::SweepRecord& record) {
    return record.sweep <= last.sweep - sweep::StopRules::window;
  });
  if (before != records.rend() && before->mean_alpha > 1 && done >= sweep::StopRules::earliest) {
    const double gain = 1 - (last.mean_alpha - 1) / (before->mean_alpha - 1);
    left = std::fmax(done * (gain / tolerance - 1), sweep::StopRules::measuring_interval);
  }
  return std::fmin(left, std::max(max_sweeps - last.sweep, 0));
}

} // namespace

double seconds_left(Records history, const StageNumber& stage, const sweep::SweepOptions& options) {
  const Records records = records_of_stage(history);
  if (records.size() < 2)
    return -1;
  const sweep::SweepRecord& last = records.back();
  double moved = 0; // points times sweeps
  for (std::size_t k = 1; k < records.size(); ++k)
    moved += static_cast<double>(records[k].points) * (records[k].sweep - records[k - 1].sweep);
  const double seconds = (last.seconds - records.front().seconds) / std::fmax(moved, 1);
  auto points = static_cast<double>(last.points);
  double left = points * sweeps_left(records, options.stop_tolerance.value_or(sweep::StopRules::last_tolerance),
                                     options.max_sweeps);
  for (int k = stage.stage; k < stage.last; ++k) {
    points *= stage.inserts ? start::StartRules::growth : 4;
    left += points * ForecastRules::usual_sweeps;
  }
  return seconds * (left + points * ForecastRules::after_sweeps);
}

} // namespace trime::meshing
