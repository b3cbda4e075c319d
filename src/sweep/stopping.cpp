// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/stopping.hpp"

namespace trime::sweep {
namespace {

constexpr double good_median = 0.001; // A median of alpha - 1 below this leaves bars nothing to gain
// Stop tolerance before points are inserted, which disturbs the order anyway.
constexpr double insertion_tolerance = 0.12;
// Stop tolerance for bars on a coarse mesh, which costs little and decides the order of the finer ones.
constexpr double coarse_bar_tolerance = 0.024;
// Method `distmesh` multiplies the tolerance by this: bars settle more slowly than accelerated cells. With 158
// sweeps in place of 83 a domain of 1e4 points had a median alpha of 1.0163 in place of 1.0197.
constexpr double bar_patience = 0.4;

/// The record from before the window, or none if there is no such record yet.
const SweepRecord* before_window(std::span<const SweepRecord> records) {
  for (std::size_t k = records.size(); k-- > 0;)
    if (records[k].sweep <= records.back().sweep - StopRules::window)
      return &records[k];
  return nullptr;
}

} // namespace

std::optional<StopReason> StopRule::decide(std::span<const SweepRecord> records) const {
  const std::size_t n = records.size();
  const SweepRecord& last = records.back();
  if (n > 1 && last.max_move < SweepRules::still)
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
  return now < good_median || (before && now >= (1 - StopRules::median_gain) * (before->median_alpha - 1));
}

SweepControl::SweepControl(const SweepOptions& options, const std::vector<SweepRecord>& history)
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

void SweepControl::begin_stage(bool inserts, bool is_last, bool is_nearly_relaxed) {
  first_record_ = history_.size();
  may_switch_ = options_.method == Method::hybrid && (is_last || !inserts);
  inserts_ = inserts;
  is_last_ = is_last;
  if (is_nearly_relaxed && options_.method == Method::hybrid)
    use(Mover::triangles);
  else if (mover_ != Mover::bars)
    use(mover_); // without the momentum of the stage before
}

void SweepControl::visit(StateFields& fields) {
  fields.field("mover", mover_);
  fields.field("first_record", first_record_);
  if (fields.restores())
    use(mover_);
  rule_->visit(fields);
}

Patience SweepControl::patience() const {
  Patience patience{.tolerance = tolerance()};
  if (mover_ == Mover::triangles) {
    patience.earliest = StopRules::window;
    patience.median = false;
  }
  if (options_.stop_tolerance) {
    patience.tolerance = *options_.stop_tolerance;
    patience.seen = 0;
  }
  return patience;
}

/// Least gain in a window where the user does not set one.
double SweepControl::tolerance() const {
  if (mover_ == Mover::triangles)
    return is_last_ ? StopRules::triangle_tolerance : StopRules::coarse_triangle_tolerance;
  const double tolerance = is_last_                ? StopRules::last_tolerance
                           : inserts_              ? insertion_tolerance
                           : mover_ == Mover::bars ? coarse_bar_tolerance
                                                   : StopRules::coarse_cell_tolerance;
  const bool patient = options_.method == Method::distmesh && records().back().median_alpha - 1 >= good_median;
  return (patient ? bar_patience : 1) * tolerance;
}

std::span<const SweepRecord> SweepControl::records() const {
  return std::span(history_).subspan(first_record_);
}

SweepDecision SweepControl::decide() const {
  const auto reason = StopRule(options_.max_sweeps, patience()).decide(records());
  if (!may_switch_ || mover_ == Mover::triangles || reason == StopReason::sweep_cap)
    return {reason, std::nullopt};
  if (reason || (mover_ == Mover::bars && median_stalled(records())))
    return {std::nullopt, mover_ == Mover::bars ? Mover::cells : Mover::triangles};
  return {};
}

void SweepControl::switch_to(Mover mover) {
  use(mover);
  first_record_ = history_.size() - 1;
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

} // namespace trime::sweep
