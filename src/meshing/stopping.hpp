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

/// Sweeps from one measurement of the quality to the next.
constexpr int measuring_interval = 3;

/// When a rule has done what it can.
struct Patience {
  double tolerance;   ///< least share of alpha - 1 that six sweeps must gain
  int earliest = 9;   ///< sweeps before it may stall
  bool median = true; ///< the median of alpha must have stalled as well
  double seen = 5e-5; ///< of mean alpha: as good as stalled if six sweeps gain less
};

/// @brief Converged: no site moved by more than 0.005 h in the last sweep. Quality stalled: the mean of
/// alpha - 1 fell by less than the tolerance, or by less than anybody sees, over the last six sweeps. Sweep cap: the
/// moves since the start of the run.
class StopRule {
public:
  StopRule(int max_sweeps, const Patience& patience) : max_sweeps_(max_sweeps), patience_(patience) {}
  /// @param records of the stage, or of the part of it that the present rule has moved; the same on every rank
  std::optional<StopReason> decide(std::span<const SweepRecord> records) const;

private:
  int max_sweeps_;
  Patience patience_;
};

/// @brief The median of alpha - 1 fell by less than 0.3 of itself over the last six sweeps, or is below 0.001: bars
/// have done what they can do quickly.
bool median_stalled(std::span<const SweepRecord> records);

/// What moves the sites.
enum class Mover { bars, cells, triangles };

/// @brief The rule of each sweep. `distmesh` and `cvd` stay with theirs. `hybrid` starts with bars and goes over to
/// Voronoi cells, once and for all, when the median of alpha stalls: in the first stage if the later ones divide a
/// relaxed mesh, in the last one if they insert points (as TriMe++ does). When the cells have stalled, TriangleRule
/// ends the stage, and does all the work in the stages after a division: they start in order.
class SweepControl {
public:
  SweepControl(const MeshOptions& options, const std::vector<SweepRecord>& history);

  /// @param inserts the stages to come insert points @param is_last no stage comes
  void begin_stage(bool inserts, bool is_last);
  /// After a triangulation was recorded: the rule of the next move, or why the stage ends.
  std::optional<StopReason> decide();
  UpdateRule& rule() { return *rule_; }
  Mover mover() const { return mover_; }

private:
  void use(Mover mover);
  Patience patience() const;
  std::span<const SweepRecord> records() const;

  const MeshOptions options_;
  const std::vector<SweepRecord>& history_;
  std::unique_ptr<UpdateRule> rule_;
  Mover mover_ = Mover::bars;
  std::size_t first_record_ = 0; // that the present rule counts from
  bool may_switch_ = true, inserts_ = false, is_last_ = true;
};

} // namespace trime::meshing
