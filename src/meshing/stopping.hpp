// SPDX-License-Identifier: BSD-3-Clause
// Which rule moves the sites, and when a stage ends: from maxima and integer sums over all ranks only, never from
// times.
#pragma once

#include "trime/meshing/options.hpp"
#include "trime/meshing/update_rule.hpp"

#include <memory>
#include <optional>
#include <span>

namespace trime::meshing {

/// @brief Converged: no site moved by more than 0.005 h in the last sweep. Quality stalled: the mean of
/// alpha - 1 fell by less than `tolerance` of itself over the last five sweeps, checked from the tenth triangulation
/// on. Sweep cap: the moves since the start of the run.
class StopRule {
public:
  StopRule(int max_sweeps, double tolerance) : max_sweeps_(max_sweeps), tolerance_(tolerance) {}
  /// @param records of the stage, or of the part of it that the present rule has moved; the same on every rank
  std::optional<StopReason> decide(std::span<const SweepRecord> records) const;

private:
  int max_sweeps_;
  double tolerance_;
};

/// @brief The median of alpha - 1 fell by less than a tenth of itself over the last five sweeps, or is below 0.001:
/// bars have done what they can.
bool median_stalled(std::span<const SweepRecord> records);

/// @brief The rule of each sweep. `distmesh` and `cvd` stay with theirs. `hybrid` starts with bars and goes over to
/// Voronoi cells, once and for all, when the median of alpha stalls: in the first stage if the later ones divide a
/// relaxed mesh, in the last one if they insert points (as TriMe++ does).
class SweepControl {
public:
  SweepControl(const MeshOptions& options, const std::vector<SweepRecord>& history);

  /// @param inserts the stages to come insert points @param is_last no stage comes
  void begin_stage(bool inserts, bool is_last);
  /// After a triangulation was recorded: the rule of the next move, or why the stage ends.
  std::optional<StopReason> decide();
  UpdateRule& rule() { return *rule_; }
  /// Bars move the sites, not Voronoi cells.
  bool by_bars() const { return by_bars_; }

private:
  void use_bars();
  void use_cells();
  std::span<const SweepRecord> records() const;

  const MeshOptions options_;
  const std::vector<SweepRecord>& history_;
  std::unique_ptr<UpdateRule> rule_;
  std::size_t first_record_ = 0; // that the present rule counts from
  bool by_bars_ = false, may_switch_ = true;
  double tolerance_ = 0;
};

} // namespace trime::meshing
