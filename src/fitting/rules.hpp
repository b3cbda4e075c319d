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
  /// [1] Curves that were simplified for a larger factor of the size serve while that is larger by no more than this
  /// share. Not measured.
  static constexpr double same_curves = 0.04;
  /// [1] Curves of a smaller factor serve while that is smaller by no more than this share: they are simplified a
  /// little less. Not measured.
  static constexpr double finer_curves = 0.13;
  /// [pieces] Boundaries with so many are simplified by one rank for all. With fewer that takes less than 1 MB of
  /// memory and some hundredths of a second. Not measured.
  static constexpr std::int64_t many_pieces = 2048;
  /// [1] Simplified curves stay by so much nearer to the shape than the certificate wants: factors of sizes are
  /// rounded. Not measured.
  static constexpr double distance_slack = 1e-9;
  /// [rounds] So often curves that came too far from the shape are made again with smaller sizes at these places; then
  /// nothing is simplified. Sizes like abs(sin(50 x)) + 1e-7 take 1 or 2. Not measured.
  static constexpr int nearer_rounds = 8;
  /// [h] If the boundary asks for smaller triangles somewhere than this, a uniform size is lowered there. Not measured.
  static constexpr double lowering_pays = 0.6;
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
  /// [1] With `min_size` no more of the chords may be so short before that is told. Coasts have a few in nearly every
  /// run, at narrow parts where the user has chosen so; the report names the worst triangle anyway. Not measured.
  static constexpr double warned_share_of_chords = 0.01;
};

/// The numbers of the search for the size that yields the points asked for.
struct FitRules {
  /// [1] While the goal is known from one side only, a factor or a spacing changes at least by this share.
  static constexpr double least_step = 0.002;
  /// [width of the bracket] No trial is nearer than this to the ends of a bracket: counts jump, and a secant alone
  /// would creep.
  static constexpr double bracket_margin = 0.1;
  /// [points asked for] If no more than so many are missing, the trial is accepted, or the size inside makes them up.
  static constexpr double close_enough = 0.004;
  /// [close_enough] The search aims so far below the points asked for, since more of them are not accepted.
  static constexpr double goal_below = 0.4;
  /// [1] The size may be scaled down so far with the boundary sites left as they are: their chords stay within 2 % of
  /// h.
  static constexpr double least_scale = 0.98;
  /// [1] The same for scaling up.
  static constexpr double most_scale = 1.02;
  /// [uniform h] Estimates go by a polygon with vertices so far apart.
  static constexpr double reference_spacing = 0.25;
  /// [1] Estimates take the integral over cells at least so many times wider: a layout corrects them anyway.
  static constexpr double reference_coarsening = 8;
  /// [1] The same elsewhere: the points are area over h squared.
  static constexpr double uncrowded_power = -2;
  /// [1] A secant step changes the factor by this ratio at most.
  static constexpr double farthest_step = 4;
  /// [sites] Of a loop in an estimate: no polygon has fewer.
  static constexpr double least_sites = 3;
  /// [points asked for] A part of a tile that has so many sites alone is not looked into any more, in estimates and
  /// trials: sizes with narrow valleys gave 10^5 times as many on the way to a factor, in a minute. Not measured.
  static constexpr double hopelessly_many = 16;
  /// [h] Step of the integral along the boundary in an estimate.
  static constexpr double integral_step = 1;
  /// [1] If strides of length h along the boundary are fewer than this share of its length over h, it is ragged, and
  /// will be simplified: estimates go by the strides. Not measured.
  static constexpr double ragged_strides = 0.7;
  /// [1] The factor estimated by strides is raised by this, for the points that limits of the size will take. Not
  /// measured.
  static constexpr double limits_on_ragged = 1.3;
};

} // namespace trime::fitting
