// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/stopping.hpp"

namespace trime::meshing {
namespace {

constexpr double still = 0.005; // of h
constexpr std::size_t window = 5, earliest = 10;
constexpr double median_gain = 0.1, good_median = 0.001;
/// What five sweeps must gain. A coarse mesh costs little and decides over the order of the finer ones; before an
/// insertion the order is about to be disturbed anyway.
constexpr double tolerance_last = 0.04, tolerance_coarse = 0.02, tolerance_before_insertion = 0.1;
constexpr double patience_of_bars = 0.4; // bars settle more slowly than accelerated Voronoi cells

} // namespace

std::optional<StopReason> StopRule::decide(std::span<const SweepRecord> records) const {
  const std::size_t n = records.size();
  const SweepRecord& last = records.back();
  if (n > 1 && last.max_move < still)
    return StopReason::converged;
  if (n >= earliest) {
    const SweepRecord& before = records[n - 1 - window];
    const bool mean_stalled = last.mean_alpha - 1 >= (1 - tolerance_) * (before.mean_alpha - 1);
    const bool middle_stalled =
        last.median_alpha - 1 < good_median || last.median_alpha - 1 >= (1 - tolerance_) * (before.median_alpha - 1);
    if (mean_stalled && middle_stalled)
      return StopReason::quality_stalled;
  }
  if (last.sweep >= max_sweeps_)
    return StopReason::sweep_cap;
  return std::nullopt;
}

bool median_stalled(std::span<const SweepRecord> records) {
  const std::size_t n = records.size();
  if (n == 0)
    return false;
  const double now = records.back().median_alpha - 1;
  return now < good_median || (n > window && now >= (1 - median_gain) * (records[n - 1 - window].median_alpha - 1));
}

SweepControl::SweepControl(const MeshOptions& options, const std::vector<SweepRecord>& history)
    : options_(options), history_(history) {
  if (options.method == Method::cvd)
    use_cells();
  else
    use_bars();
}

void SweepControl::use_bars() {
  rule_ = std::make_unique<DistMeshRule>();
  by_bars_ = true;
}

void SweepControl::use_cells() {
  rule_ = std::make_unique<CvdRule>(options_.density_exponent);
  by_bars_ = false;
}

void SweepControl::begin_stage(bool inserts, bool is_last) {
  first_record_ = history_.size();
  may_switch_ = options_.method == Method::hybrid && (is_last || !inserts);
  tolerance_ = options_.stop_tolerance.value_or(is_last   ? tolerance_last
                                                : inserts ? tolerance_before_insertion
                                                          : tolerance_coarse);
  if (!by_bars_)
    use_cells(); // without the momentum of the stage before
}

std::span<const SweepRecord> SweepControl::records() const {
  return std::span(history_).subspan(first_record_);
}

std::optional<StopReason> SweepControl::decide() {
  const bool patient = options_.method == Method::distmesh && !options_.stop_tolerance &&
                       records().back().median_alpha - 1 >= good_median;
  const auto reason = StopRule(options_.max_sweeps, (patient ? patience_of_bars : 1) * tolerance_).decide(records());
  if (!by_bars_ || !may_switch_ || reason == StopReason::sweep_cap)
    return reason;
  if (reason || median_stalled(records())) {
    use_cells();
    first_record_ = history_.size() - 1;
  }
  return std::nullopt;
}

std::string to_string(StopReason reason) {
  switch (reason) {
  case StopReason::converged:
    return "converged";
  case StopReason::quality_stalled:
    return "quality stalled";
  case StopReason::sweep_cap:
    return "sweep cap";
  }
  return "unknown";
}

} // namespace trime::meshing
