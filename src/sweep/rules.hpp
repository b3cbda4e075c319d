// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module sweep: how far sites move, when tiles sleep, and when a stage ends.
#pragma once

#include <cstddef>

namespace trime::sweep {

/// The numbers of the update rules and of the sweeps.
struct SweepRules {
  /// [h] Longest move of a site in one sweep. All sites move at once, so longer moves would invert triangles. All ways
  /// to start and all update rules were compared with this value.
  static constexpr double move_cap = 0.4;
  /// [h] A site that moves farther than this counts as moving. If no site moves farther, the stage has converged.
  /// Shorter moves cannot be seen in a picture.
  static constexpr double still = 0.005;
  /// [h] Moves shorter than this are not made, so that most sites of a regular lattice stay exactly where they are.
  /// With 1e-4, a perturbed lattice on a torus did not return to the regular lattice.
  static constexpr double rest = 1e-5;
  /// [share of `rest`] A site at rest is skipped in later sweeps if its move is shorter than this share of `rest`. The
  /// share is 0.5 because momentum multiplies a move by at most 1.95. Not measured.
  static constexpr double rest_share = 0.5;

  /// [1] Rest length of a bar over h. The ratio is above 1 so that most bars push. With 1.1, 20 sweeps gave mean alpha
  /// 1.050 instead of 1.053, but the largest alpha was 1.98 instead of 1.73; with 1.0 and bars that also pull, the
  /// sweeps stalled.
  static constexpr double bar_pressure = 1.2;
  /// [1] Explicit Euler step of the bars; steps below 1/3 are stable on a hexagonal lattice. With 0.2, 20 sweeps gave
  /// mean alpha 1.064 instead of 1.053.
  static constexpr double bar_time_step = 0.3;
  /// [1] Exponent of 1/h in the weight of a Voronoi cell. With 4 the distance between sites is proportional to h (see
  /// CvdRule). With 2, the deviation of edge lengths from h after 100 sweeps was twice as large (0.128 instead of
  /// 0.063).
  static constexpr int density_exponent = 4;
  /// [1] Largest factor of the momentum. The values 0.9, 0.95 and 0.98 gave similar meshes; the values 0.7 and 0.8 gave
  /// slightly worse ones.
  static constexpr double largest_momentum = 0.95;
  /// [sweeps] The momentum in sweep k after a restart is k / (k + momentum_delay), as is usual for Nesterov's method.
  static constexpr int momentum_delay = 3;
  /// [1] The constant k in the energy of TriangleRule. With 0.25, triangles resist a change of area half as strongly as
  /// a shear. Then alpha - 1 falls to less than half of its value after the Voronoi rule, and the deviation of edge
  /// lengths from h grows by at most a sixth.
  static constexpr double triangle_stiffness = 0.25;
  /// [1] Share of the Newton step that TriangleRule makes. The share is below 1 because neighbours move at the same
  /// time: with 0.9 or more, oscillations of neighbouring sites against each other grow.
  static constexpr double triangle_damping = 0.7;

  /// [1] How often a site may be pushed out of diametral circles of boundary edges before it is deleted. On a poker
  /// card with 1e4 points, pushes ended within five sweeps and no site was deleted. No measured case reaches this
  /// bound.
  static constexpr int pushes_allowed = 3;
  /// [1] Share of the sites marked for deletion that one round deletes. The other marked sites wait, because the room
  /// that a deleted site leaves may be enough for them.
  static constexpr double deleted_share = 1.0 / 3;

  /// [sweeps] The size field h is evaluated again at the sites after this number of sweeps; evaluation may be
  /// expensive, and sites move little in between. The values 6 and 4 gave the same mean alpha, but other numbers were
  /// changed at the same time.
  static constexpr int sweeps_of_a_size = 6;
  /// [sweeps] A site that is marked for deletion waits at most this long for a sorting of the sites, which deletes it.
  static constexpr int sweeps_of_a_sort = 8;
  /// [h] Sites are sorted into bins again when a site may have moved farther than this since the last sorting, because
  /// searches for neighbours become long.
  static constexpr double drift_in_sizes = 4;
  /// [sides of the narrowest tile nearby] Sites are sorted into tiles again when a site may have moved farther than
  /// this since the last sorting. Below this limit, all neighbours of a site are still in its tile or in the tiles next
  /// to it.
  static constexpr double drift_in_tiles = 0.25;
  /// [1] The scale of an update rule, such as its rest length of bars, is changed only if the change is at least this
  /// share. A change ends the rest of all tiles.
  static constexpr double scale_change = 1e-3;
  /// [1] Factor by which upper bounds on distances are raised. The factor is far above the rounding errors of the sums
  /// in these bounds.
  static constexpr double drift_rounding = 1 + 1e-9;

  /// [1] Share of the squared largest circumradius up to which the fast floating-point test accepts a triangle. The
  /// exact test decides about larger triangles, because rounding could change the answer.
  static constexpr double cap_margin = 0.98;

  /// [1] Upper bound on the term of one site in the power of the moves. The bound keeps the sum of all sites within the
  /// range of FixedSum. No measured case reaches this bound.
  static constexpr double largest_power = 0x1p10;
  /// [1] Upper bound on one squared length over h_ref^2 in a sum. The bound keeps the sum over all edges within the
  /// range of FixedSum. No measured case reaches this bound.
  static constexpr double largest_term = 0x1p17;
  /// [1] Upper bound on alpha - 1 of one triangle in a sum. The bound keeps the sum over all triangles within the range
  /// of FixedSum. No measured case reaches this bound.
  static constexpr double largest_excess_term = 1000;
};

/// The tuned numbers that decide when a stage ends.
struct StopRules {
  /// [sweeps] Interval between measurements of the quality. A measurement takes about as long as a move.
  static constexpr int measuring_interval = 3;
  /// [sweeps] Gains of quality are measured over this window of two intervals, so that a single unusual sweep does not
  /// end a stage.
  static constexpr int window = 2 * measuring_interval;
  /// [sweeps] An update rule cannot count as stalled before this number of sweeps, because the bar and Voronoi rules
  /// improve a disordered start slowly at first.
  static constexpr int earliest = 9;
  /// [1] An update rule also counts as stalled if the mean of alpha falls by less than this in a window; such a gain
  /// cannot be seen. With this limit and a higher momentum, a square of 1e6 points took 21 sweeps instead of 48, and
  /// its mean alpha was 1.0002 instead of 1.0001.
  static constexpr double seen = 5e-5;

  /// [1] The Voronoi rule replaces the bar rule when the median of alpha - 1 falls by less than this share in a window,
  /// because accelerated Voronoi steps are then faster. The value was measured only together with the change of `seen`.
  static constexpr double median_gain = 0.3;

  /// [1] In the last stage, the bar and Voronoi rules have stalled if a window gains less than this share of alpha - 1.
  static constexpr double last_tolerance = 0.04;
  /// [1] On a coarse mesh, the Voronoi rule has stalled if a window gains less than this share of alpha - 1. This limit
  /// is half of an earlier value.
  static constexpr double coarse_cell_tolerance = 0.015;
  /// [1] In the last stage, TriangleRule has stalled if a window gains less than this share of alpha - 1. The limit is
  /// high because the rule reaches nearly all of its gain in a few sweeps.
  static constexpr double triangle_tolerance = 0.084;
  /// [1] On a coarse mesh, TriangleRule has stalled if a window gains less than this share of alpha - 1.
  static constexpr double coarse_triangle_tolerance = 0.036;
};

} // namespace trime::sweep
