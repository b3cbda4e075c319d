// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module fitting: layouts of a stage, and the size that yields the points asked for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime::fitting {

/// The numbers of the layout of a stage, of its simplified boundary, and of the outlook.
struct LayoutRules {
  /// [1] Trials of the size begin with the boundary thinned for sizes so many times smaller than the first. Not
  /// measured.
  static constexpr double thinned_ahead = 3;
  /// [1] While the factor of the size changes by a smaller share, the curves are not generalised anew. Not measured.
  static constexpr double same_curves = 0.04;
  /// [pieces] Boundaries with so many are simplified by one rank for all. With fewer that takes less than 7 MB of
  /// memory and about as long as the messages. Not measured.
  static constexpr std::int64_t many_pieces = 16384;
  /// [1] Simplified curves stay by so much nearer to the shape than the certificate wants: factors of sizes are
  /// rounded. Not measured.
  static constexpr double distance_slack = 1e-9;
  /// [rounds] So often curves that came too far from the shape are made again with smaller sizes at these places; then
  /// nothing is simplified. Sizes like abs(sin(50 x)) + 1e-7 take 1 or 2. Not measured.
  static constexpr int nearer_rounds = 8;
  /// [h] If the boundary asks for smaller triangles somewhere than this, a uniform size is lowered there. Not measured.
  static constexpr double lowering_pays = 0.6;
  /// [area of the shape] The grid covers so much of the container with cells as small as the triangles. In an emptier
  /// container cells are larger, since each costs memory.
  static constexpr double emptiest_grid = 64;
  /// [points asked for] A trial whose boundary takes more sites than this is given up before it is laid to its end.
  static constexpr double affordable_growth = 1.5;
  /// [sites] A boundary with so few sites is always laid to its end: that takes no time.
  static constexpr double always_affordable = 1000;
  /// [1] The integral that fits the size of the last division is taken over cells so many times wider: it errs by a few
  /// thousandths.
  static constexpr double coarse_integral = 4;
  /// [points] The outlook of --dry-run fits the size for so many at most, and scales it from there. Not
  /// measured.
  static constexpr double outlook_points = 1e5;
  /// [trials] Sizes at which the outlook simplifies the boundary: the last is within some per cent of the largest that
  /// keeps everything. Not measured.
  static constexpr int outlook_trials = 12;
  /// [sites] On the boundary: the outlook tries no smaller size, since long walls have as many nodes as that; 3e4 on
  /// 156 rings with thin gaps took 16 s. It tries one outlook_step in any case. Not measured.
  static constexpr double outlook_sites = 1e4;
  /// [1] While everything is not kept, the outlook tries so many times smaller sizes. Not measured.
  static constexpr double outlook_step = 10;
  /// [samples] Along a side of the box around the shape: between two the slope of the size is looked at. Not measured.
  static constexpr int slope_samples = 64;
  /// [1] A steeper size brings a warning. Triangles can follow about 0.5, see the warning.
  static constexpr double warned_slope = 1;
  /// [h] A shorter chord brings a warning: triangles beside it have small angles.
  static constexpr double warned_chord = 0.1;
  /// [1] With `min_size` no more of the chords may be so short before that is told. Coasts have a few in nearly every
  /// run, at narrow parts where the user has chosen so; the report names the worst triangle anyway. Not measured.
  static constexpr double warned_share_of_chords = 0.01;
};

/// The numbers of the search for the size that yields the points asked for.
struct FitRules {
  /// [trials] Of the factor of a graded size, each with a layout of the boundary: a bound; 3 to 6 are usual.
  static constexpr int most_trials = 40;
  /// [trials] After so many in a row that change nothing a finer size does not help. It takes several, since the first
  /// may be too coarse for any site inside.
  static constexpr int saturated_trials = 8;
  /// [1] Two trials whose numbers of points differ by a smaller share have changed nothing.
  static constexpr double same_points = 1e-3;
  /// [1] If the factors on both sides of the goal differ by a smaller share, no trial is made between them: the count
  /// jumps there.
  static constexpr double closest_factors = 1e-4;
  /// [1] After a trial that was given up, with far too many sites, the factor grows at least by this.
  static constexpr double overfull_step = 1.5;
  /// [1] While the goal is known from one side only, a factor or a spacing changes at least by this share.
  static constexpr double least_step = 0.002;
  /// [width of the bracket] No trial is nearer than this to the ends of a bracket: counts jump, and a secant alone
  /// would creep.
  static constexpr double bracket_margin = 0.1;
  /// [width + height of the container] Larger sizes change nothing: a bound for the search.
  static constexpr double largest_size = 64;
  /// [points asked for] If no more than so many are missing, the trial is accepted, or the size inside makes them up.
  static constexpr double close_enough = 0.004;
  /// [close_enough] The search aims so far below the points asked for, since more of them are not accepted.
  static constexpr double goal_below = 0.4;
  /// [points asked for] With fewer the result says why.
  static constexpr double enough_points = 0.98;
  /// [1] The size may be scaled down so far with the boundary sites left as they are: their chords stay within 2 % of
  /// h.
  static constexpr double least_scale = 0.98;
  /// [1] The same for scaling up.
  static constexpr double most_scale = 1.02;
  /// [uniform h] Estimates go by a polygon with vertices so far apart.
  static constexpr double reference_spacing = 0.25;
  /// [1] Estimates take the integral over cells at least so many times wider: a layout corrects them anyway.
  static constexpr double reference_coarsening = 8;
  /// [rounds] Of estimates of the factor without layouts: a bound.
  static constexpr int estimate_rounds = 6;
  /// [1] A factor that changes by a smaller share ends the estimates.
  static constexpr double estimate_precision = 0.02;
  /// [1] The same where corners crowd: the estimate is rough there anyway.
  static constexpr double crowded_precision = 0.2;
  /// [rounds] In so many, at most, the factor and the limits of the size are found together, with a layout each.
  static constexpr int approach_rounds = 8;
  /// [boundary sites] If there are more limits of the size than this share, they hold so many points that crowded_power
  /// applies.
  static constexpr double crowded_share = 0.05;
  /// [1] The points grow by this power of the factor where limits hold many of them: less than by -2, since limits
  /// stay. First guess of the secant only.
  static constexpr double crowded_power = -1.6;
  /// [1] The same elsewhere: the points are area over h squared.
  static constexpr double uncrowded_power = -2;
  /// [1] The last trial on the way leaves out one round of limits; its count is raised by this for them.
  static constexpr double limits_to_come = 1.08;
  /// [1] While the factor changes by a smaller share, limits of the size are scaled with it and not looked for again.
  static constexpr double limits_reach = 0.15;
  /// [samples] The smallest size over the shape is looked for on a grid of so many a side.
  static constexpr int samples_per_side = 33;
  /// [pieces] The size is sampled at about so many pieces of the boundary in that search.
  static constexpr std::size_t most_sampled_pieces = 4096;
  /// [rounds] In so many, at most, the factor for an edge length is found.
  static constexpr int edge_length_rounds = 12;
  /// [1] A secant step changes the factor by this ratio at most.
  static constexpr double farthest_step = 4;
  /// [1] Least slope that a secant is trusted with, of the inverse root of the points over the factor: 0.075 is that of
  /// a power of -0.15.
  static constexpr double flattest_slope = 0.075;
  /// [1] The largest one: that of a power of -3.
  static constexpr double steepest_slope = 1.5;
  /// [1] Two factors that differ by a smaller share tell nothing of the slope.
  static constexpr double apart = 0.01;
  /// [rounds] The boundary of a lattice start is laid so often, each time with the spacing found for the one before.
  static constexpr int boundary_rounds = 3;
  /// [rounds] In so many, at most, the spacing of a lattice is found for one boundary.
  static constexpr int spacing_rounds = 12;
  /// [1] If the spacing differs from that of the boundary by a smaller share, the boundary is not laid again.
  static constexpr double same_spacing = 0.02;
  /// [points] The search for the spacing ends when fewer than one site in so many is missing.
  static constexpr std::int64_t spacing_precision = 5000;
  /// [rounds] In so many, at most, a uniform size grows until the boundary takes no more sites than asked for.
  static constexpr int growth_rounds = 24;
  /// [1] By this factor that size grows in a round.
  static constexpr double size_growth = 1.3;
  /// [h] A lattice with a larger spacing has so few sites that its spacing says nothing about h.
  static constexpr double comparable_spacing = 2;
  /// [points] If more are asked for and the count jumps past them, that is an error; with fewer the nearest count is
  /// taken.
  static constexpr double many_points = 64;
  /// [points asked for] If the count jumps and fewer than this share come out, there is no mesh of so many points, and
  /// an error says so.
  static constexpr double least_of_jump = 0.5;
  /// [sites] Of a loop in an estimate: no polygon has fewer.
  static constexpr double least_sites = 3;
  /// [points asked for] An estimate stops counting there.
  static constexpr double far_too_many = 4;
  /// [points asked for] A part of a tile that has so many sites alone is not looked into any more, in estimates and
  /// trials: sizes with narrow valleys gave 10^5 times as many on the way to a factor, in a minute. Not measured.
  static constexpr double hopelessly_many = 16;
  /// [h] Step of the integral along the boundary in an estimate.
  static constexpr double integral_step = 1;
  /// [boundary sites] If corners are more than this share of the boundary sites, they crowd: the size is lowered around
  /// many of them.
  static constexpr double sparse_corners = 0.38;
  /// [1] Where corners crowd the estimated factor grows by this at most.
  static constexpr double most_crowding = 16;
};

} // namespace trime::fitting
