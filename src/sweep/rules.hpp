// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the sweeps, each once: how far sites move, when tiles sleep, and when a stage ends.
#pragma once

#include <cstddef>

namespace trime::sweep {

/// The numbers of the update rules and of the sweeps.
struct SweepRules {
  /// [h] All sites move at once, so that long moves would turn triangles over: moves are cut to this. All starts and
  /// rules were compared with this cap.
  static constexpr double move_cap = 0.4;
  /// [h] A site that moves by more counts as moving; if none does, the stage has converged: a picture does not show
  /// less.
  static constexpr double still = 0.005;
  /// [h] A shorter move is not made, so that most of a lattice stays as it is, bit for bit. With 1e-4 a perturbed
  /// torus did not return to its lattice.
  static constexpr double rest = 1e-5;
  /// [rest] A site that rests with a move below this falls asleep: momentum makes 1.95 moves of one at most. Not
  /// measured.
  static constexpr double rest_share = 0.5;

  /// [1] Rest length of a bar over h: most bars push. With 1.1, 20 sweeps gave mean alpha 1.050 in place of 1.053, but
  /// the largest was 1.98 in place of 1.73; with 1.0 and bars that also pull, the sweeps stalled.
  static constexpr double bar_pressure = 1.2;
  /// [1] Explicit Euler step of the bars: stable below 1/3 on a hexagonal lattice. With 0.2, 20 sweeps gave mean alpha
  /// 1.064 in place of 1.053.
  static constexpr double bar_time_step = 0.3;
  /// [1] Exponent of 1/h in the weight of a Voronoi cell: 4 makes the spacing proportional to h (see CvdRule). With 2,
  /// 100 sweeps doubled the deviation from h (0.128 in place of 0.063).
  static constexpr int density_exponent = 4;
  /// [1] Largest factor of the momentum. 0.9, 0.95 and 0.98 were alike, 0.7 and 0.8 slightly worse.
  static constexpr double largest_momentum = 0.95;
  /// [sweeps] The momentum of sweep k after a restart is k / (k + this), as is usual for Nesterov's method.
  static constexpr int momentum_delay = 3;
  /// [1] k in the energy of TriangleRule: it makes the resistance to a change of area half that to shear. With it alpha
  /// - 1 fell to less than half of what the cells leave, and the deviation of lengths from h grew by at most a sixth.
  static constexpr double triangle_stiffness = 0.25;
  /// [1] Share of the Newton step of TriangleRule, since neighbours move at the same time. From 0.9 on the shortest
  /// waves come to life.
  static constexpr double triangle_damping = 0.7;

  /// [1] A site may be pushed out of discs of the boundary so often; then it is deleted. With it and starts outside of
  /// the strip, pushes on a poker of 1e4 points ended within five sweeps, and nothing was deleted.
  /// A bound; no case measured reaches it.
  static constexpr int pushes_allowed = 3;
  /// [1] Share of those to be deleted that go in one round: the room that one leaves may be enough for the others.
  static constexpr double deleted_share = 1.0 / 3;

  /// [sweeps] h is evaluated again after this number: the size field may be expensive, and sites have moved little by
  /// then. With other changes of the same time, 6 in place of 4 left mean alpha as it was.
  static constexpr int sweeps_of_a_size = 6;
  /// [sweeps] Sites that are to be deleted wait so long for the next sorting, which is what deletes them.
  static constexpr int sweeps_of_a_sort = 8;
  /// [h] Sites are sorted again when one may have come so far since: searches become long.
  static constexpr double drift_in_sizes = 4;
  /// [sides of the narrowest tile around] Sites are sorted again when one may have come so far since: what lies around
  /// a tile is found in the tiles next to it.
  static constexpr double drift_in_tiles = 0.25;
  /// [1] A scale of the rule (of the lengths of bars) stays as it is until it would change by this share; then all
  /// tiles wake.
  static constexpr double scale_change = 1e-3;
  /// [1] Factor by which bounds on distances are raised, far above the rounding of the sums in them.
  static constexpr double drift_rounding = 1 + 1e-9;

  /// [1] Share of the squared cap. Triangles above it may exceed the cap by rounding or are near to it, and are left to
  /// the exact test.
  static constexpr double cap_margin = 0.98;

  /// [1] Bound on what one site adds to the power of the moves, which keeps sums within the reach of FixedSum.
  /// A bound; no case measured reaches it.
  static constexpr double largest_power = 0x1p10;
  /// [1] Bound on a squared length over h_ref^2 in a sum, which keeps sums within the reach of FixedSum.
  /// A bound; no case measured reaches it.
  static constexpr double largest_term = 0x1p17;
  /// [1] Bound on alpha - 1 in a sum, which keeps sums within the reach of FixedSum.
  /// A bound; no case measured reaches it.
  static constexpr double largest_excess_term = 1000;
};

/// The numbers that say when a stage ends.
struct StopRules {
  /// [sweeps] From one measurement of the quality to the next: measuring takes about as long as a move.
  static constexpr int measuring_interval = 3;
  /// [sweeps] Gains are counted over this number: two measurements, so that one odd sweep decides nothing.
  static constexpr int window = 2 * measuring_interval;
  /// [sweeps] A rule may stall only after this number: bars and cells first pay for the disorder of the start.
  static constexpr int earliest = 9;
  /// [1] As good as stalled if the mean of alpha falls by less in a window: nobody sees it. Together with a higher
  /// momentum, a square of 1e6 points took 21 sweeps in place of 48, for a mean alpha of 1.0002 in place of 1.0001.
  static constexpr double seen = 5e-5;

  /// [1] Bars give way to cells when a window brings less than this share of the median of alpha - 1: accelerated cells
  /// do the rest sooner than bars. Measured with other changes only, see `seen`.
  static constexpr double median_gain = 0.3;

  /// [1] Least gain of bars or cells in a window, in the last stage.
  static constexpr double last_tolerance = 0.04;
  /// [1] The same for cells on a coarse mesh, with twice the patience of an earlier value, for the same reason.
  static constexpr double coarse_cell_tolerance = 0.015;
  /// [1] Least gain of triangles in a window, in the last stage: they gain nearly all in a few sweeps.
  static constexpr double triangle_tolerance = 0.084;
  /// [1] The same on a coarse mesh.
  static constexpr double coarse_triangle_tolerance = 0.036;
};

} // namespace trime::sweep
