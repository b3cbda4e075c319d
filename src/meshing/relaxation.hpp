// SPDX-License-Identifier: BSD-3-Clause
// The sweeps of a stage, one after the other, with what is measured and said about them.
#pragma once

#include "meshing/checkpoint_writer.hpp"
#include "meshing/snapshots.hpp"
#include "sweep/stopping.hpp"
#include "sweep/sweeper.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <optional>
#include <vector>

namespace trime::meshing {

/// Which stage is relaxed, as far as the stop rule and the records want to know.
struct StageNumber {
  int stage;    ///< from 0
  bool inserts; ///< the stages to come insert points into the mesh of this one
  bool is_last;
  int last = 0; ///< number of the last stage, as far as is known
};

/// Sweeps until the stop rule ends a stage; keeps the history of the run.
class Relaxation {
public:
  /// Keeps the references.
  Relaxation(const RunContext& run, const StageStars& stars, Snapshots& snapshots, const CheckpointWriter& checkpoints)
      : run_(run), stars_(stars), snapshots_(snapshots), checkpoints_(checkpoints), control_(run.sweeps, history_) {}

  /// Sweeps until the stop rule ends the stage, at the sweep cap at the latest; then sorts. Collective.
  void relax(sites::Stage& stage, const StageNumber& number);
  /// @brief Takes up what was kept in a checkpoint. If that was in the middle of a stage, sweeps on to its end, as
  /// relax does. Collective. @pre the sites of the stage are restored
  void resume(sites::Stage& stage, const StageNumber& number, const SavedRun& saved);
  /// Returns what a checkpoint at the end of a stage keeps. @pre the sweeps of the stage are over
  RunState state();

  /// Why the last stage ended.
  sweep::StopReason stop_reason() const { return stop_reason_; }
  /// Returns all records of the run. @pre all sweeps are over
  std::vector<sweep::SweepRecord> take_history() { return std::move(history_); }

private:
  sweep::Sleep sleep() const;
  bool is_record_due() const;
  void sweep_on(sites::Stage& stage, const StageNumber& number, sweep::Sweeper& sweeper, bool moved);
  void sort(sites::Stage& stage, sweep::Sweeper& sweeper) const;
  void move(sweep::Sweeper& sweeper);
  void follow(sweep::Sweeper& sweeper);
  void write_checkpoint(const sites::Stage& stage, sweep::Sweeper& sweeper);
  void visit(StateFields& fields);
  void record(const sites::Stage& stage, int stage_number, sweep::Sweeper& sweeper);
  std::optional<sweep::StopReason> go_on(const StageNumber& number);
  void tell(const StageNumber& number, bool is_shown) const;

  const RunContext& run_;
  const StageStars& stars_;
  Snapshots& snapshots_;
  const CheckpointWriter& checkpoints_;
  std::vector<sweep::SweepRecord> history_;
  sweep::SweepControl control_;
  sweep::SweepSums sums_;             // of the last record, with the power of the last move
  sweep::Sweeper::Counts counts_;     // of the moves since the last record
  int sweeps_ = 0;                    // moves made
  double seconds_before_ = 0;         // of a run that was stopped, less those until this one took it up
  std::optional<sweep::Mover> begun_; // the rule that knows the sums for the next move
  sweep::StopReason stop_reason_ = sweep::StopReason::sweep_cap;
};

} // namespace trime::meshing
