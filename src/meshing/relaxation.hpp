// SPDX-License-Identifier: BSD-3-Clause
// The sweeps of a stage, one after the other, with what is measured and said about them, and an estimate of how long
// the run still takes. The estimate steers nothing.
#pragma once

#include "meshing/checkpoint_writer.hpp"
#include "meshing/stage_stars.hpp"
#include "sweep/stopping.hpp"
#include "sweep/sweeper.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <optional>
#include <span>
#include <vector>

namespace trime::meshing {

/// The facts about a stage that the stop rule and the records use.
struct StageNumber {
  int stage;    ///< counts from 0
  bool inserts; ///< later stages insert points into the mesh of this one
  bool is_last;
  int last = 0; ///< number of the last stage, as far as is known
};

/// Sweeps until the stop rule ends a stage, and records the history of the run.
class Relaxation {
public:
  /// Keeps references to all arguments.
  Relaxation(const RunContext& run, const StageStars& stars, Snapshots& snapshots, const CheckpointWriter& checkpoints)
      : run_(run), stars_(stars), snapshots_(snapshots), checkpoints_(checkpoints), control_(run.sweeps, history_) {}

  /// Sweeps until the stop rule or the largest number of sweeps ends the stage, then sorts the sites. Collective.
  void relax(sites::Stage& stage, const StageNumber& number);
  /// @brief Continues from a checkpoint. If it was taken in the middle of a stage, sweeps on to the end of the stage,
  /// as relax does. Collective. @pre the sites of the stage are restored
  void resume(sites::Stage& stage, const StageNumber& number, const SavedRun& saved);
  /// Returns the state that a checkpoint at the end of a stage stores. @pre the sweeps of the stage are over
  RunState state();

  /// The reason why the last stage ended.
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
  sweep::SweepSums sums_;         // sums of the last record, with the power of the last move
  sweep::Sweeper::Counts counts_; // counts of the moves since the last record
  int sweeps_ = 0;                // moves so far
  double seconds_before_ = 0; // seconds of the run that was stopped, minus the seconds that this run took to restore it
  std::optional<sweep::Mover> begun_; // the rule that knows the sums for the next move
  sweep::StopReason stop_reason_ = sweep::StopReason::sweep_cap;
};

/// @brief Returns about how many seconds the run will still take, to within a factor of two or three. It assumes that
/// the gains of this stage fall as a power of the number of sweeps until they are below the tolerance, and uses typical
/// numbers for all that follows.
/// @return a negative number before the second record of a stage, when nothing is known
double seconds_left(std::span<const sweep::SweepRecord> history, const StageNumber& stage,
                    const sweep::SweepOptions& options);

} // namespace trime::meshing
