// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/relaxation.hpp"

#include "meshing/rules.hpp"
#include "start/rules.hpp"
#include "sweep/rules.hpp"
#include "sweep/sweep_record.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {

using sweep::StopReason;
using sweep::Sweeper;
using sweep::SweepSums;

void Relaxation::relax(sites::Stage& stage, const StageNumber& number) {
  control_.begin_stage(number.inserts, number.is_last, number.is_nearly_relaxed);
  counts_ = {};
  counts_.rebuilt = run_.comm.sum(stars_.compute(stage, sites::Wanted::inner_sites).rebuilt);
  Sweeper sweeper(*stage.state, stars_.builder(), sweep::move_context(stage, run_.lattice),
                  stars_.allowed(sweep::LemmaReach::up_to_chords), sleep());
  record(stage, number.stage, sweeper);
  snapshots_.take(stage);
  begun_.reset();
  if (const std::optional<StopReason> end = go_on(number))
    stop_reason_ = *end;
  else
    sweep_on(stage, number, sweeper, false);
  sort(stage, sweeper);
}

/// Until the stop rule ends the stage. @param moved the last move is made, and nothing of what follows it
void Relaxation::sweep_on(sites::Stage& stage, const StageNumber& number, Sweeper& sweeper, bool moved) {
  for (std::optional<StopReason> end; !end; moved = false) {
    if (!moved) {
      move(sweeper);
      if (sweeper.largest_wish() > 0)
        write_checkpoint(stage, sweeper);
    }
    follow(sweeper);
    snapshots_.take(stage);
    if (!is_record_due())
      continue;
    record(stage, number.stage, sweeper);
    end = go_on(number);
    if (end)
      stop_reason_ = *end;
  }
}

void Relaxation::sort(sites::Stage& stage, Sweeper& sweeper) const {
  const auto time = run_.timers.scope("sort");
  sweeper.sort();
  stage.state->points().release_leads();
}

sweep::Sleep Relaxation::sleep() const {
  return run_.sweeps.star_tests.sleepless ? sweep::Sleep::never : sweep::Sleep::where_nothing_moves;
}

bool Relaxation::is_record_due() const {
  return sweeps_ - history_.back().sweep >= sweep::StopRules::measuring_interval || sweeps_ >= run_.sweeps.max_sweeps;
}

/// Moves the sites by the rule. Their next places were found in the pass that certified their stars, unless the rule
/// has changed since.
void Relaxation::move(Sweeper& sweeper) {
  const auto time = run_.timers.scope("sweeps");
  if (begun_ != control_.mover()) {
    begun_ = control_.mover();
    control_.rule().begin_sweep(sums_);
    sweeper.discard();
  }
  if (!sweeper.is_prepared())
    sweeper.prepare(control_.rule(), checkpoints_.wish());
  const Sweeper::Counts moved = sweeper.commit();
  ++sweeps_;
  sums_.power = moved.power;
  counts_.follow_by(moved);
}

/// Certifies the stars at the new places. That is one pass with the search for the places after these.
void Relaxation::follow(Sweeper& sweeper) {
  const auto time = run_.timers.scope("sweeps");
  control_.rule().begin_sweep(sums_);
  sweeper.prepare(control_.rule(), checkpoints_.wish());
  if (run_.sweeps.star_tests.verify)
    sweeper.verify();
}

/// Measures the mesh; the sums steer the next move.
void Relaxation::record(const sites::Stage& stage, int stage_number, Sweeper& sweeper) {
  const auto time = run_.timers.scope("measure");
  if (run_.sweeps.star_tests.verify)
    sweeper.verify_measures(stage.typical_size);
  sweep::SweepSummary summary =
      sweep::summarize_sweep(*stage.state, sweeper, counts_, stage.typical_size, stage.placed_first());
  summary.record.sweep = sweeps_;
  summary.record.stage = stage_number;
  summary.record.seconds = seconds_before_ + run_.timers.total();
  history_.push_back(summary.record);
  sums_ = summary.sums;
  counts_ = {};
}

// --- checkpoints ---------------------------------------------------------------------------------------------------

void Relaxation::visit(StateFields& fields) {
  fields.field("sweeps", sweeps_);
  fields.field("stop_reason", stop_reason_);
  fields.field("sum_of_lengths", sums_.squared_length_ratio);
  fields.field("sum_of_sizes", sums_.squared_size_ratio);
  fields.field("sum_of_power", sums_.power);
  fields.field("count_rebuilt", counts_.rebuilt);
  fields.field("count_moving", counts_.moving);
  fields.field("count_pushed", counts_.pushed);
  fields.field("count_deleted", counts_.deleted);
  fields.field("count_max_move", counts_.max_move);
  fields.field("count_power", counts_.power);
  control_.visit(fields);
}

void Relaxation::write_checkpoint(const sites::Stage& stage, Sweeper& sweeper) {
  RunState now = state();
  StateFields fields = StateFields::keeping(now.numbers);
  sweeper.visit(fields);
  checkpoints_.write(RunPoint::moved, sweeper.largest_wish(), std::move(now), *stage.state, sweeper.saved_activity());
}

RunState Relaxation::state() {
  RunState now{{}, history_};
  StateFields fields = StateFields::keeping(now.numbers);
  visit(fields);
  return now;
}

void Relaxation::resume(sites::Stage& stage, const StageNumber& number, const SavedRun& saved) {
  history_ = saved.state.history;
  seconds_before_ = history_.empty() ? 0 : history_.back().seconds - run_.timers.total();
  control_.begin_stage(number.inserts, number.is_last, number.is_nearly_relaxed);
  StateFields fields = StateFields::restoring(saved.state.numbers);
  visit(fields);
  begun_ = control_.mover();
  if (point_of(saved) == RunPoint::relaxed) {
    stage.state->points().release_leads();
    return;
  }
  stars_.compute(stage, sites::Wanted::inner_sites); // also those in tiles that sleep: no sweep would find them
  Sweeper sweeper(*stage.state, stars_.builder(), sweep::move_context(stage, run_.lattice),
                  stars_.allowed(sweep::LemmaReach::up_to_chords), sleep());
  sweeper.restore(fields, saved.tiles.activity);
  sweep_on(stage, number, sweeper, true);
  sort(stage, sweeper);
}

/// Carries out the decision of the control after a record: switches the rule if it says so, and writes to the log.
/// Returns why the stage ends, if it does.
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
