// SPDX-License-Identifier: BSD-3-Clause
// Decides which update rule moves the sites, and when a stage ends. The decisions use only maxima and integer sums over
// all ranks, never measured times. Also holds the options of the sweeps.
#pragma once

#include "sweep/rules.hpp"
#include "sweep/update_rule.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace trime::sweep {

struct SweepOptions {
  Method method;
  int max_sweeps;                       ///< largest number of moves of the whole run, over all stages
  std::optional<double> stop_tolerance; ///< least relative gain of quality in six sweeps; if empty, StopRules gives a
                                        ///< value for each rule and stage
  int density_exponent;                 ///< see CvdRule
  StarTests star_tests = {};
};

/// Decides when an update rule counts as stalled.
struct Patience {
  double tolerance;                   ///< least share by which alpha - 1 must fall in a window of sweeps
  int earliest = StopRules::earliest; ///< the rule cannot count as stalled before this sweep
  bool median = true;                 ///< whether the median of alpha must have stalled as well as the mean
  double seen = StopRules::seen;      ///< the rule has also stalled if mean alpha falls by less than this in a window
};

/// @brief Decides when a stage ends, for one of three reasons. Converged: no site moved by more than SweepRules::still
/// in the last sweep. Stalled: over the last window of sweeps the mean of alpha - 1 fell by less than the tolerance, or
/// by less than can be seen. Too many sweeps: the run has made max_sweeps moves.
class StopRule {
public:
  StopRule(int max_sweeps, const Patience& patience) : max_sweeps_(max_sweeps), patience_(patience) {}
  /// @param records records of all sweeps of the stage, or only of the sweeps since the present rule took over; the
  /// same on every rank
  std::optional<StopReason> decide(std::span<const SweepRecord> records) const;

private:
  int max_sweeps_;
  Patience patience_;
};

/// Returns true if the bar rule gains little: over the last window of sweeps the median of alpha - 1 fell by less than
/// the share StopRules::median_gain, or alpha is already good.
bool median_stalled(std::span<const SweepRecord> records);

/// The decision after the record of a sweep: to end the stage, to change the update rule, or to go on.
struct SweepDecision {
  std::optional<StopReason> stop; ///< the reason for which the stage ends; empty if it goes on
  std::optional<Mover> next;      ///< the update rule that moves the sites from now on; empty if it does not change
};

/// @brief Chooses the update rule of each sweep. The methods `distmesh` and `cvd` use one rule. The method `hybrid`
/// starts with the bar rule and changes once to the Voronoi rule, when the median of alpha stalls. This change happens
/// in the first stage if later stages divide a relaxed mesh, and in the last stage if later stages insert points (as in
/// TriMe++). When the Voronoi rule has stalled, TriangleRule ends the stage. In stages that begin with a division,
/// TriangleRule does all the work, because these stages start from a relaxed mesh.
class SweepControl {
public:
  /// @param history history of the run, to which the caller keeps appending; must outlive this object
  SweepControl(const SweepOptions& options, const std::vector<SweepRecord>& history);

  /// Begins a stage.
  /// @param inserts true if later stages insert points (false if they divide triangles)
  /// @param is_last true if no stage follows
  /// @param is_nearly_relaxed true if the sites are those of a relaxed mesh, except for a small share; then
  /// TriangleRule begins
  void begin_stage(bool inserts, bool is_last, bool is_nearly_relaxed = false);
  /// Decides after the last record whether the stage goes on; changes nothing.
  /// @pre the stage has a record
  SweepDecision decide() const;
  /// Changes the update rule. The gain of the new rule is counted from the last record on.
  void switch_to(Mover mover);
  UpdateRule& rule() { return *rule_; }
  /// Visits the members that are stored in a checkpoint.
  /// @pre begin_stage() was called
  void visit(StateFields& fields);
  Mover mover() const { return mover_; }

private:
  void use(Mover mover);
  Patience patience() const;
  double tolerance() const;
  std::span<const SweepRecord> records() const;

  const SweepOptions options_;
  const std::vector<SweepRecord>& history_;
  std::unique_ptr<UpdateRule> rule_;
  Mover mover_ = Mover::bars;
  std::size_t first_record_ = 0; // the first record that counts for the present rule
  bool may_switch_ = true, inserts_ = false, is_last_ = true;
};

} // namespace trime::sweep
