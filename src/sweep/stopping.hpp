// SPDX-License-Identifier: BSD-3-Clause
// Which rule moves the sites, and when a stage ends: from maxima and integer sums over all ranks only, never from
// times; with the options of the sweeps.
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
  std::optional<double> stop_tolerance; ///< least gain in six sweeps; empty: StopRules decide by rule and stage
  int density_exponent;                 ///< see CvdRule
  StarTests star_tests = {};
};

/// Says when a rule counts as stalled.
struct Patience {
  double tolerance;                   ///< least share of alpha - 1 that a window must gain
  int earliest = StopRules::earliest; ///< the rule cannot count as stalled before this number of sweeps
  bool median = true;                 ///< the median of alpha must have stalled as well
  double seen = StopRules::seen;      ///< also stalled if mean alpha gains less than this in a window
};

/// @brief Says when a stage ends, for one of three reasons. Converged: no site moved by more than SweepRules::still in
/// the last sweep. Quality stalled: the mean of alpha - 1 fell by less than the tolerance, or by less than can be seen,
/// over the last window. Sweep cap: the run has made max_sweeps moves.
class StopRule {
public:
  StopRule(int max_sweeps, const Patience& patience) : max_sweeps_(max_sweeps), patience_(patience) {}
  /// @param records records of the stage, or of its part in which the present rule moved the sites; the same on every
  /// rank
  std::optional<StopReason> decide(std::span<const SweepRecord> records) const;

private:
  int max_sweeps_;
  Patience patience_;
};

/// Returns true if bars gain little: the median of alpha - 1 fell by less than the share StopRules::median_gain over
/// the last window, or is already good.
bool median_stalled(std::span<const SweepRecord> records);

/// The decision after a record: the end of the stage, a change of the rule, or neither.
struct SweepDecision {
  std::optional<StopReason> stop; ///< why the stage ends
  std::optional<Mover> next;      ///< the rule that moves the sites from now on
};

/// @brief Chooses the rule of each sweep. `distmesh` and `cvd` use one rule. `hybrid` starts with bars and changes to
/// Voronoi cells, once, when the median of alpha stalls. This happens in the first stage if the later ones divide a
/// relaxed mesh, and in the last stage if they insert points (as TriMe++ does). When the cells have stalled,
/// TriangleRule ends the stage. It also does all the work in the stages after a division, since these start from a
/// relaxed mesh.
class SweepControl {
public:
  /// @param history history of the run, which keeps growing; outlives this object
  SweepControl(const SweepOptions& options, const std::vector<SweepRecord>& history);

  /// @param inserts later stages insert points @param is_last no later stage follows
  void begin_stage(bool inserts, bool is_last);
  /// Returns the decision after the last record; changes nothing. @pre the stage has a record
  SweepDecision decide() const;
  /// Changes the rule. The new rule counts its gains from the last record.
  void switch_to(Mover mover);
  UpdateRule& rule() { return *rule_; }
  /// Visits the members that a checkpoint keeps. @pre begin_stage()
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
  std::size_t first_record_ = 0; // record from which the present rule counts its gains
  bool may_switch_ = true, inserts_ = false, is_last_ = true;
};

} // namespace trime::sweep
