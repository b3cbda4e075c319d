// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/stopping.hpp"

namespace trime::meshing {
namespace {

constexpr double still = 0.005;                          // of h
constexpr int window = 2 * measuring_interval;           // sweeps
constexpr double median_gain = 0.3, good_median = 0.001; // accelerated cells do the rest sooner than bars
/// What these sweeps must gain. A coarse mesh costs little and decides over the order of the finer ones; before an
/// insertion the order is about to be disturbed anyway.
constexpr double tolerance_last = 0.04, tolerance_before_insertion = 0.12;
constexpr double tolerance_of_coarse_bars = 0.024, tolerance_of_coarse_cells = 0.015;
constexpr double patience_of_bars = 0.4; // bars settle more slowly than accelerated Voronoi cells
/// Triangles gain nearly all in a few sweeps.
constexpr Patience patience_of_triangles{0.084, window, false}, patience_of_coarse_triangles{0.036, window, false};

/// The record from before the window, or none if there is no such record yet.
const SweepRecord* before_window(std::span<const SweepRecord> records) {
  for (std::size_t k = records.size(); k-- > 0;)
    if (records[k].sweep <= records.back().sweep - window)
      return &records[k];
  return nullptr;
}

} // namespace

std::optional<StopReason> StopRule::decide(std::span<const SweepRecord> records) const {
  const std::size_t n = records.size();
  const SweepRecord& last = records.back();
  if (n > 1 && last.max_move < still)
    return StopReason::converged;
  const SweepRecord* const past = before_window(records);
  if (past && last.sweep - records.front().sweep >= patience_.earliest) {
    const SweepRecord& before = *past;
    const double least = 1 - patience_.tolerance;
    const bool mean_stalled =
        last.mean_alpha - 1 >= least * (before.mean_alpha - 1) || before.mean_alpha - last.mean_alpha < patience_.seen;
    const bool middle_stalled = !patience_.median || last.median_alpha - 1 < good_median ||
                                last.median_alpha - 1 >= least * (before.median_alpha - 1);
    if (mean_stalled && middle_stalled)
      return StopReason::quality_stalled;
  }
  if (last.sweep >= max_sweeps_)
    return StopReason::sweep_cap;
  return std::nullopt;
}

bool median_stalled(std::span<const SweepRecord> records) {
  if (records.empty())
    return false;
  const double now = records.back().median_alpha - 1;
  const SweepRecord* const before = before_window(records);
  return now < good_median || (before && now >= (1 - median_gain) * (before->median_alpha - 1));
}

SweepControl::SweepControl(const MeshOptions& options, const std::vector<SweepRecord>& history)
    : options_(options), history_(history) {
  use(options.method == Method::cvd ? Mover::cells : Mover::bars);
}

void SweepControl::use(Mover mover) {
  mover_ = mover;
  switch (mover) {
  case Mover::bars:
    rule_ = std::make_unique<DistMeshRule>();
    break;
  case Mover::cells:
    rule_ = std::make_unique<CvdRule>(options_.density_exponent);
    break;
  case Mover::triangles:
    rule_ = std::make_unique<TriangleRule>();
    break;
  }
}

void SweepControl::begin_stage(bool inserts, bool is_last) {
  first_record_ = history_.size();
  may_switch_ = options_.method == Method::hybrid && (is_last || !inserts);
  inserts_ = inserts;
  is_last_ = is_last;
  if (mover_ != Mover::bars)
    use(mover_); // without the momentum of the stage before
}

Patience SweepControl::patience() const {
  if (mover_ == Mover::triangles) {
    Patience patience = is_last_ ? patience_of_triangles : patience_of_coarse_triangles;
    if (options_.stop_tolerance) {
      patience.tolerance = *options_.stop_tolerance;
      patience.seen = 0;
    }
    return patience;
  }
  if (options_.stop_tolerance)
    return {.tolerance = *options_.stop_tolerance, .seen = 0};
  const double tolerance = is_last_                ? tolerance_last
                           : inserts_              ? tolerance_before_insertion
                           : mover_ == Mover::bars ? tolerance_of_coarse_bars
                                                   : tolerance_of_coarse_cells;
  const bool patient = options_.method == Method::distmesh && records().back().median_alpha - 1 >= good_median;
  return {(patient ? patience_of_bars : 1) * tolerance};
}

std::span<const SweepRecord> SweepControl::records() const {
  return std::span(history_).subspan(first_record_);
}

std::optional<StopReason> SweepControl::decide() {
  const auto reason = StopRule(options_.max_sweeps, patience()).decide(records());
  if (!may_switch_ || mover_ == Mover::triangles || reason == StopReason::sweep_cap)
    return reason;
  if (reason || (mover_ == Mover::bars && median_stalled(records()))) {
    use(mover_ == Mover::bars ? Mover::cells : Mover::triangles);
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
