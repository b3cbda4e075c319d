// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which points are placed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime::start {

/// The numbers by which points are placed.
struct StartRules {
  /// [area of the shape] The grid covers so much with cells as small as the triangles; beyond, cells are larger.
  static constexpr double emptiest_grid = 64;
  /// [points asked for] A boundary that takes more sites in a trial is not laid to its end. Not measured.
  static constexpr double affordable_growth = 1.5;
  /// [sites] So many are always laid: they cost nothing.
  static constexpr double always_affordable = 1000;
  /// [points asked for] So many at most are kept for the clean-up. Not measured.
  static constexpr double reserved_share = 0.004;
  /// [points] Kept for the clean-up for each piece of the boundary, where it mends ragged parts. Not measured.
  static constexpr double reserved_per_piece = 0.1;
  /// [1] Of the number of points by one insertion, as TriMe++ has it. Not measured.
  static constexpr double growth = 1.6;
  /// [stages] At most: bounds the run where triangles are too few for the points.
  static constexpr int most_insertions = 64;
  /// [points] With fewer the start is not coarse: it would starve narrow parts. Not measured.
  static constexpr double one_division = 3000;
  /// [points] From here on the start has 1/16 of the points. Not measured.
  static constexpr double two_divisions = 20000;
  /// [points] From here on the start has 1/64 of the points. Not measured.
  static constexpr double three_divisions = 400000;
  /// [1] Coarsening of the integral, at most, that fits the size of an insertion run. Not measured.
  static constexpr double coarsest_integral = 8;
  /// [1] Coarsening of the integral that fits the size of the last division: errs by a few thousandths.
  static constexpr double coarse_integral = 4;
  /// [1] Coarsening of the cells of a start that is relaxed and divided: no worse than 1.
  static constexpr double coarse_start = 2;
  /// [points asked for] So many missing ones are not filled up: new sites disturb the order. Not measured.
  static constexpr double small_shortage = 0.01;
  /// [1] So many times the wanted sites are placed at most, where fixed points take some away.
  static constexpr double most_replaced = 4;
  /// [spacings] Along the boundary, free of lattice sites: 0.4 to 0.55 were found best.
  static constexpr double lattice_strip = 0.45;
  /// [h] Along the boundary, free of quantiles of the density: they are less regular than a lattice. Not measured.
  static constexpr double density_strip = 0.43;
  /// [sites] A cell of the density is divided while it wants more: a site then has its place to half an edge.
  static constexpr double sites_in_cell = 0.25;
  /// [sites] The same near the boundary, where cells lie half in the strip.
  static constexpr double sites_in_cell_near = 0.0625;
  /// [levels] Of the cells of the density in a tile.
  static constexpr int deepest_cell = 24;
  /// [sites] A deepest cell that wants more shows a size that is far too small.
  static constexpr double most_in_deepest = 64;
  /// [cells] Of a part of a tile; more shows a size that is far too small.
  static constexpr std::int64_t most_cells = 1 << 27;
  /// [1] Of a lattice that must fit two periods: counts like tolerated_shortage. Not measured.
  static constexpr double tolerated_stretch = 0.02;
  /// [points] Over those asked for: counts like tolerated_stretch. Not measured.
  static constexpr double tolerated_shortage = 0.002;
  /// [h] Sites that are too many go nearest to the boundary first; farther off a hash decides. Not measured.
  static constexpr double farthest_from_boundary = 4;
};

/// The numbers of the search for the size that yields the points asked for.
struct FitRules {
  /// [trials] Of the factor of a graded size, each a layout: 3 to 6 are usual.
  static constexpr int most_trials = 40;
  /// [trials] In a row that change nothing: a finer size does not help. The first may be too coarse for a site inside.
  static constexpr int saturated_trials = 8;
  /// [points] Two trials whose numbers differ by less, relatively, have changed nothing. Not measured.
  static constexpr double same_points = 1e-3;
  /// [1] A bracket of the factor that is narrower, relatively, is not divided. Not measured.
  static constexpr double closest_factors = 1e-4;
  /// [1] Least growth of the factor after a trial with far too many sites. Not measured.
  static constexpr double overfull_step = 1.5;
  /// [1] Least relative change of a factor or a spacing while no bracket is known. Not measured.
  static constexpr double least_step = 0.002;
  /// [width of a bracket] No trial is nearer to its ends: counts jump, and a secant alone would creep.
  static constexpr double bracket_margin = 0.1;
  /// [width + height of the container] Larger sizes change nothing.
  static constexpr double largest_size = 64;
  /// [points asked for] So many missing ones are made up by the size inside, or accepted. Not measured.
  static constexpr double close_enough = 0.004;
  /// [close_enough] So far below the points asked for the search aims: more are not accepted. Not measured.
  static constexpr double goal_below = 0.4;
  /// [points asked for] With fewer the user is told why. Not measured.
  static constexpr double enough_points = 0.98;
  /// [1] The size inside may be scaled so far down with the boundary left as it is. Not measured.
  static constexpr double least_scale = 0.98;
  /// [1] And so far up. Not measured.
  static constexpr double most_scale = 1.02;
  /// [uniform h] Of the vertices of the polygon by which points are estimated. Not measured.
  static constexpr double reference_spacing = 0.25;
  /// [1] Of the integral in estimates, at least. Not measured.
  static constexpr double reference_coarsening = 8;
  /// [rounds] Of estimates of the factor, without layouts. Not measured.
  static constexpr int estimate_rounds = 6;
  /// [1] A factor that changes by less, relatively, ends the estimates. Not measured.
  static constexpr double estimate_precision = 0.02;
  /// [1] The same where corners crowd: the estimate is rough there anyway. Not measured.
  static constexpr double crowded_precision = 0.2;
  /// [rounds] In which factor and limits of the size are found together. Not measured.
  static constexpr int approach_rounds = 8;
  /// [boundary sites] From so many limits of the size on they hold many points. Not measured.
  static constexpr double crowded_share = 0.05;
  /// [1] Of the factor, that the points follow where limits hold many: less than -2, as limits stay. Not measured.
  static constexpr double crowded_power = -1.6;
  /// [1] Of the factor, that the points follow else: area over h squared.
  static constexpr double uncrowded_power = -2;
  /// [1] Growth of the points by limits that a last trial on the way does without. Not measured.
  static constexpr double limits_to_come = 1.08;
  /// [1] Relative change of the factor within which the limits of the size stand, scaled. Not measured.
  static constexpr double limits_reach = 0.15;
  /// [samples] Of the size over the shape, for the smallest one. Not measured.
  static constexpr int samples_per_side = 33;
  /// [pieces] Of the boundary at which the size is sampled, about. Not measured.
  static constexpr std::size_t most_sampled_pieces = 4096;
  /// [rounds] In which the factor for an edge length is found. Not measured.
  static constexpr int edge_length_rounds = 12;
  /// [1] A secant step changes the factor by this ratio at most. Not measured.
  static constexpr double farthest_step = 4;
  /// [1] Of the inverse root of the points over the factor: a power of -0.15. Not measured.
  static constexpr double flattest_slope = 0.075;
  /// [1] The same for a power of -3. Not measured.
  static constexpr double steepest_slope = 1.5;
  /// [1] Two factors nearer to each other, relatively, tell nothing of the slope. Not measured.
  static constexpr double apart = 0.01;
  /// [rounds] The boundary of a lattice start is laid, each time at the spacing found before. Not measured.
  static constexpr int boundary_rounds = 3;
  /// [rounds] In which the spacing of a lattice is found for one boundary. Not measured.
  static constexpr int spacing_rounds = 12;
  /// [1] A spacing that differs by less from the boundary's, relatively, needs no new boundary. Not measured.
  static constexpr double same_spacing = 0.02;
  /// [points] One missing lattice site in so many ends the search for the spacing. Not measured.
  static constexpr std::int64_t spacing_precision = 5000;
  /// [rounds] In which a uniform size grows until the boundary takes no more sites than asked for. Not measured.
  static constexpr int growth_rounds = 24;
  /// [1] Of that size in one round. Not measured.
  static constexpr double size_growth = 1.3;
  /// [h] A lattice of a larger spacing has so few sites that the spacing means nothing. Not measured.
  static constexpr double comparable_spacing = 2;
  /// [points] With more, a jump of the count is an error and not the best that can be. Not measured.
  static constexpr double many_points = 64;
  /// [points asked for] With fewer after a jump there is no mesh of so many points. Not measured.
  static constexpr double least_of_jump = 0.5;
  /// [sites] Of a loop in an estimate: no polygon has fewer.
  static constexpr double least_sites = 3;
  /// [points asked for] An estimate does not count beyond. Not measured.
  static constexpr double far_too_many = 4;
  /// [h] Of the integral along the boundary in an estimate. Not measured.
  static constexpr double longest_step = 1;
  /// [boundary sites] From this share of corners on the size is lowered around many of them. Not measured.
  static constexpr double sparse_corners = 0.38;
  /// [1] By so much the estimated factor grows at most where corners crowd. Not measured.
  static constexpr double most_crowding = 16;
};

} // namespace trime::start
