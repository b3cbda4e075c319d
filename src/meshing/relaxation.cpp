// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/relaxation.hpp"

#include "meshing/forecast.hpp"
#include "sweep/sweep_record.hpp"

namespace trime::meshing {

using sweep::StopReason;
using sweep::Sweeper;
using sweep::SweepSums;

void Relaxation::relax(sites::Stage& stage, const StageNumber& number) {
  control_.begin_stage(number.inserts, number.is_last);
  Sweeper::Counts counts; // since the last record
  counts.rebuilt = run_.comm.sum(stars_.compute(stage, sites::Wanted::inner_sites).rebuilt);
  Sweeper sweeper(*stage.state, stars_.builder(), sweep::move_context(stage, run_.lattice),
                  stars_.allowed(sweep::LemmaReach::up_to_chords));
  SweepSums sums = record(stage, number.stage, sweeper, counts);
  snapshots_.take(stage);
  begun_.reset();
  std::optional<StopReason> end = go_on(number);
  while (!end) {
    counts = {};
    do {
      counts.follow_by(sweep_once(sweeper, sums));
      snapshots_.take(stage);
    } while (!is_record_due());
    sums = record(stage, number.stage, sweeper, counts);
    end = go_on(number);
  }
  stop_reason_ = *end;
  const auto time = run_.timers.scope("sort");
  sweeper.sort();
  stage.state->points().release_leads();
}

bool Relaxation::is_record_due() const {
  return sweeps_ - history_.back().sweep >= sweep::StopRules::measuring_interval || sweeps_ >= run_.sweeps.max_sweeps;
}

/// Moves the sites by the rule and certifies the stars at the new places. That is one pass with the search for the
/// places after these, which is made anew if the rule changes.
Sweeper::Counts Relaxation::sweep_once(Sweeper& sweeper, SweepSums& sums) {
  const auto time = run_.timers.scope("sweeps");
  if (begun_ != control_.mover()) {
    begun_ = control_.mover();
    control_.rule().begin_sweep(sums);
    sweeper.discard();
  }
  if (!sweeper.is_prepared())
    sweeper.prepare(control_.rule());
  const Sweeper::Counts moved = sweeper.commit();
  ++sweeps_;
  sums.power = moved.power;
  control_.rule().begin_sweep(sums);
  sweeper.prepare(control_.rule());
  if (run_.sweeps.star_tests.verify)
    sweeper.verify();
  return moved;
}

/// Measures the mesh; the sums steer the next move.
SweepSums Relaxation::record(const sites::Stage& stage, int stage_number, Sweeper& sweeper,
                             const Sweeper::Counts& counts) {
  const auto time = run_.timers.scope("measure");
  sweep::SweepSummary summary =
      sweep::summarize_sweep(*stage.state, sweeper, counts, stage.typical_size, stage.placed_first());
  summary.record.sweep = sweeps_;
  summary.record.stage = stage_number;
  summary.record.seconds = run_.timers.total();
  history_.push_back(summary.record);
  return summary.sums;
}

/// Carries out what the control decides after a record: switches the rule if it says so, and tells the log. Returns why
/// the stage ends, if it does.
std::optional<StopReason> Relaxation::go_on(const StageNumber& number) {
  const sweep::SweepDecision decision = control_.decide();
  if (decision.next)
    control_.switch_to(*decision.next);
  sweep::SweepRecord& last = history_.back();
  last.by_bars = control_.mover() == sweep::Mover::bars;
  const bool is_first = history_.size() == 1 || history_[history_.size() - 2].stage != last.stage;
  tell(number, (decision.stop && number.is_last) || is_first);
  return decision.stop;
}

/// The last record as a line of the log. From what this rank has; nothing is steered by it.
void Relaxation::tell(const StageNumber& number, bool is_shown) const {
  const sweep::SweepRecord& last = history_.back();
  run_.log.progress({last.sweep, live_text(last), sweep::table_header(), table_row(last),
                     seconds_left(history_, number, run_.sweeps), is_shown});
}

} // namespace trime::meshing
