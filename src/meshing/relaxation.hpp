// SPDX-License-Identifier: BSD-3-Clause
// Makes the sweeps of a stage, one after the other, and records and prints their results. Also estimates how long the
// run will still take; nothing depends on the estimate.
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

/// Facts about a stage that the stop rule and the records need.
struct StageNumber {
  int stage;    ///< number of the stage, from 0
  bool inserts; ///< whether later stages insert points into the mesh of this stage
  bool is_last;
  int last = 0;                   ///< number of the last stage, as far as known
  bool is_nearly_relaxed = false; ///< whether the sites are those of a relaxed mesh, except for a small share
};

/// Makes sweeps until the stop rule ends a stage, and records the history of the run.
class Relaxation {
public:
  /// Keeps references to all arguments.
  Relaxation(const RunContext& run, const StageStars& stars, Snapshots& snapshots, const CheckpointWriter& checkpoints)
      : run_(run), stars_(stars), snapshots_(snapshots), checkpoints_(checkpoints), control_(run.sweeps, history_) {}

  /// Makes sweeps until the stop rule or the largest number of sweeps ends the stage, then sorts the sites. Collective.
  void relax(sites::Stage& stage, const StageNumber& number);
  /// @brief Continues from a checkpoint. If the checkpoint was taken in the middle of a stage, makes sweeps until the
  /// end of the stage, as relax does. Collective.
  /// @pre the sites of the stage are restored
  void resume(sites::Stage& stage, const StageNumber& number, const SavedRun& saved);
  /// Returns the state for a checkpoint at the end of a stage.
  /// @pre the sweeps of the stage are over
  RunState state();

  /// Returns the reason for which the last stage ended.
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
  sweep::SweepSums sums_;         // sums of the last record, including the power of the last move
  sweep::Sweeper::Counts counts_; // counts of moves, pushes and deletions since the last record
  int sweeps_ = 0;                // number of sweeps so far
  double seconds_before_ =
      0; // after a restart: time that the stopped run had taken, minus the time that the restart took
  std::optional<sweep::Mover> begun_; // the update rule that already has the sums for the next move
  sweep::StopReason stop_reason_ = sweep::StopReason::sweep_cap;
};

/// @brief Returns the estimated number of seconds until the end of the run, correct to within a factor of two or three.
/// The estimate assumes that the gains of this stage decrease as a power of the number of sweeps until they are below
/// the tolerance, and uses typical times for all later steps.
/// @return a negative number before the second record of a stage, because nothing is known yet
double seconds_left(std::span<const sweep::SweepRecord> history, const StageNumber& stage,
                    const sweep::SweepOptions& options);

} // namespace trime::meshing
