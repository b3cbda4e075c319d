// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module sweep: how far sites move, when tiles sleep, and when a stage ends.
#pragma once

#include <cstddef>

namespace trime::sweep {

/// The numbers of the update rules and of the sweeps.
struct SweepRules {
  /// [h] Longest move. All sites move at once, so longer moves would invert triangles. All starts and rules were
  /// compared with this number.
  static constexpr double move_cap = 0.4;
  /// [h] A site that moves by more counts as moving. If no site does, the stage has converged. Smaller moves cannot be
  /// seen in a picture.
  static constexpr double still = 0.005;
  /// [h] Shorter moves are not made, so most of a lattice keeps its bits. With 1e-4 a perturbed torus did not return to
  /// its lattice.
  static constexpr double rest = 1e-5;
  /// [rest] A resting site falls asleep if its move is shorter than this, because momentum multiplies a move by at most
  /// 1.95. Not measured.
  static constexpr double rest_share = 0.5;

  /// [1] Rest length of a bar over h, so that most bars push. With 1.1, 20 sweeps gave mean alpha 1.050 instead of
  /// 1.053, but the largest was 1.98 instead of 1.73; with 1.0 and bars that also pull, the sweeps stalled.
  static constexpr double bar_pressure = 1.2;
  /// [1] Explicit Euler step of the bars, which is stable below 1/3 on a hexagonal lattice. With 0.2, 20 sweeps gave
  /// mean alpha 1.064 instead of 1.053.
  static constexpr double bar_time_step = 0.3;
  /// [1] Exponent of 1/h in the weight of a Voronoi cell: 4 makes the spacing proportional to h (see CvdRule). With 2,
  /// 100 sweeps doubled the deviation from h (0.128 instead of 0.063).
  static constexpr int density_exponent = 4;
  /// [1] Largest factor of the momentum. 0.9, 0.95 and 0.98 gave similar meshes; those of 0.7 and 0.8 were slightly
  /// worse.
  static constexpr double largest_momentum = 0.95;
  /// [sweeps] The momentum of sweep k after a restart is k / (k + this), as is usual for Nesterov's method.
  static constexpr int momentum_delay = 3;
  /// [1] k in the energy of TriangleRule: it makes the resistance to a change of area half that to shear. With it alpha
  /// - 1 fell to less than half of what the cells leave, and the deviation of lengths from h grew by at most a sixth.
  static constexpr double triangle_stiffness = 0.25;
  /// [1] Share of the Newton step of TriangleRule, since neighbours move at the same time. From 0.9 on, the shortest
  /// waves grow.
  static constexpr double triangle_damping = 0.7;

  /// [1] How often a site may be pushed out of discs of the boundary before it is deleted. On a poker of 1e4 points,
  /// pushes ended within five sweeps and no site was deleted. No measured case reaches this bound.
  static constexpr int pushes_allowed = 3;
  /// [1] Share of the sites marked for deletion that one round deletes. The room that one site leaves may be enough for
  /// the others.
  static constexpr double deleted_share = 1.0 / 3;

  /// [sweeps] h is evaluated again after this number of sweeps, because the size field may be expensive and sites move
  /// little in between. 6 and 4 gave the same mean alpha; other numbers were changed at the same time.
  static constexpr int sweeps_of_a_size = 6;
  /// [sweeps] Longest time that sites marked for deletion wait for the next sorting, which deletes them.
  static constexpr int sweeps_of_a_sort = 8;
  /// [h] Sites are sorted again when one of them may have moved by more since the last sorting, because searches become
  /// long.
  static constexpr double drift_in_sizes = 4;
  /// [sides of the narrowest tile nearby] Sites are sorted again when one of them may have moved by more since the last
  /// sorting. Then the neighbours of a tile's sites are still in the tiles next to it.
  static constexpr double drift_in_tiles = 0.25;
  /// [1] The scale of a rule, such as that of bar lengths, changes only by at least this share; then all tiles wake.
  static constexpr double scale_change = 1e-3;
  /// [1] Factor by which bounds on distances are raised, far above the rounding of the sums in them.
  static constexpr double drift_rounding = 1 + 1e-9;

  /// [1] Share of the squared cap. Triangles above it are left to the exact test, because rounding might decide about
  /// them.
  static constexpr double cap_margin = 0.98;

  /// [1] Bound on the term of one site in the power of the moves, which keeps sums within the range of FixedSum. No
  /// measured case reaches it.
  static constexpr double largest_power = 0x1p10;
  /// [1] Bound on a squared length over h_ref^2 in a sum, which keeps sums within the range of FixedSum. No measured
  /// case reaches it.
  static constexpr double largest_term = 0x1p17;
  /// [1] Bound on alpha - 1 in a sum, which keeps sums within the range of FixedSum. No measured case reaches it.
  static constexpr double largest_excess_term = 1000;
};

/// The numbers that say when a stage ends.
struct StopRules {
  /// [sweeps] Interval between measurements of the quality. A measurement takes about as long as a move.
  static constexpr int measuring_interval = 3;
  /// [sweeps] Gains are counted over this window of two intervals, so that one odd sweep decides nothing.
  static constexpr int window = 2 * measuring_interval;
  /// [sweeps] A rule cannot count as stalled before this number of sweeps, because bars and cells are slow at first in
  /// a disordered start.
  static constexpr int earliest = 9;
  /// [1] A rule also counts as stalled if the mean of alpha falls by less than this in a window, which nobody can see.
  /// Together with a higher momentum, a square of 1e6 points took 21 sweeps instead of 48, and its mean alpha was
  /// 1.0002 instead of 1.0001.
  static constexpr double seen = 5e-5;

  /// [1] Cells replace bars when the median of alpha - 1 falls by less than this share in a window, because accelerated
  /// cells are then faster. It was measured only together with the changes of `seen`.
  static constexpr double median_gain = 0.3;

  /// [1] Least gain of bars or cells in a window, in the last stage.
  static constexpr double last_tolerance = 0.04;
  /// [1] Least gain of cells in a window on a coarse mesh. It is half of an earlier value.
  static constexpr double coarse_cell_tolerance = 0.015;
  /// [1] Least gain of triangles in a window, in the last stage. They reach nearly all of their gain in a few sweeps.
  static constexpr double triangle_tolerance = 0.084;
  /// [1] Least gain of triangles in a window on a coarse mesh.
  static constexpr double coarse_triangle_tolerance = 0.036;
};

} // namespace trime::sweep
