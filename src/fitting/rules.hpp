// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module fitting, for the layout of a stage and for the search of the size that yields the
// points asked for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime::fitting {

/// The numbers for the layout of a stage, for the simplification of its boundary, and for the estimate of --dry-run.
struct LayoutRules {
  /// [1] Trials of the size begin with a boundary from which small features were removed, for a size that is smaller
  /// than the first one by this factor. Not measured.
  static constexpr double thinned_ahead = 3;
  /// [1] Curves that were simplified for a larger factor of the size are used again if that factor is larger by at most
  /// this share. Not measured.
  static constexpr double same_curves = 0.04;
  /// [1] Curves that were simplified for a smaller factor of the size are used again if that factor is smaller by at
  /// most this share: they are simplified a little less than the size allows. Measured on 29 runs with coasts, with
  /// 0.13 and 0.25: 86 and 72 simplifications, the same mean alpha of 1.0299, and a largest alpha of 1.206 and 1.211 on
  /// average.
  static constexpr double finer_curves = 0.25;
  /// [pieces] A boundary with at least this number of pieces is simplified by one rank, which sends the result to the
  /// others. With fewer pieces every rank simplifies it, which takes less than 1 MB of memory and some hundredths of a
  /// second. Not measured.
  static constexpr std::int64_t many_pieces = 2048;
  /// [1] Simplified curves stay closer to the shape than the certificate requires by this share of the distance,
  /// because factors of sizes are rounded. Not measured.
  static constexpr double distance_slack = 1e-9;
  /// [rounds] How often curves that lie too far from the shape are made again with smaller sizes at these places; after
  /// that, nothing is simplified. Sizes like abs(sin(50 x)) + 1e-7 need 1 or 2 rounds. Not measured.
  static constexpr int nearer_rounds = 8;
  /// [h] If the boundary needs triangles with edges shorter than this at a place, a uniform size is lowered there. Not
  /// measured.
  static constexpr double lowering_pays = 0.6;
  /// [1] Factor on the width of the cells of the integral that fits the size after the last division of the mesh into
  /// smaller triangles. The error of this integral is a few thousandths.
  static constexpr double coarse_integral = 4;
  /// [points] The estimate of --dry-run fits the size for at most this number of points, and scales the result. Not
  /// measured.
  static constexpr double outlook_points = 1e5;
  /// [trials] Number of sizes at which the estimate of --dry-run simplifies the boundary. The last size is within a few
  /// per cent of the largest size at which nothing is simplified. Not measured.
  static constexpr int outlook_trials = 12;
  /// [sites] The estimate of --dry-run tries no size with more sites on the boundary, because the nodes of long walls
  /// increase with them; 3e4 sites on 156 rings with thin gaps took 16 s. One size that is smaller by outlook_step is
  /// tried in any case. Not measured.
  static constexpr double outlook_sites = 1e4;
  /// [1] Until nothing is simplified, the estimate of --dry-run tries sizes that are smaller by this factor each time.
  /// Not measured.
  static constexpr double outlook_step = 10;
  /// [points] Largest number of points that --dry-run tries before it advises this number. Not measured.
  static constexpr double advice_points = 1e6;
  /// [trials] Largest number of trials before --dry-run advises a number of points. Not measured.
  static constexpr int advice_trials = 8;
  /// [1] If a mesh with the tried number of points does not keep everything, the next number is larger by this factor.
  /// Not measured.
  static constexpr double advice_step = 1.3;
  /// [samples] Number along a side of the box around the shape. The slope of the size is measured between two samples.
  /// Not measured.
  static constexpr int slope_samples = 64;
  /// [1] If `min_size` is set, the program warns of short boundary edges only if they are more than this share of all
  /// boundary edges. Coasts have a few short ones in almost every run, at narrow parts that the user has allowed with
  /// `min_size`; the report names the worst triangle in any case. Not measured.
  static constexpr double warned_share_of_chords = 0.01;
};

/// The numbers for raising the size around edges that are shorter than the user allows.
struct RaisingRules {
  /// [1] Factor on the size at the place of a short edge. Not measured.
  static constexpr double first_step = 1.3;
  /// [1] This factor in later rounds, for the few places where small steps have not helped. Not measured.
  static constexpr double last_step = 1.6;
  /// [rounds] Number of rounds with small steps. Not measured.
  static constexpr int small_steps = 4;
  /// [1] A smaller factor is not worth another round. Not measured.
  static constexpr double least_raise = 1.02;
  /// [1] Largest factor on the size that the user asks for. Not measured.
  static constexpr double most_raised = 4;
  /// [rounds] How often the size is raised before the mesh is made. Not measured.
  static constexpr int most_raisings = 16;
};

/// The numbers of the search for the size that yields the points asked for.
struct FitRules {
  /// [1] Smallest relative change of a factor or a spacing while the bracket has only one end.
  static constexpr double least_step = 0.002;
  /// [width of the bracket] Smallest distance of a trial from the ends of a bracket. The number of points jumps, so a
  /// secant without this margin would converge slowly.
  static constexpr double bracket_margin = 0.1;
  /// [points asked for] A trial is accepted if at most this share of the points is missing, or if scaling the size
  /// inside can add the missing points.
  static constexpr double close_enough = 0.004;
  /// [close_enough] The search aims at fewer points than asked for by this share, because trials with more points than
  /// asked for are not accepted.
  static constexpr double goal_below = 0.4;
  /// [1] Smallest factor by which the size may be scaled while boundary sites stay. Boundary edges then stay within 2 %
  /// of h.
  static constexpr double least_scale = 0.98;
  /// [1] Largest factor by which the size may be scaled while boundary sites stay.
  static constexpr double most_scale = 1.02;
  /// [uniform h] Distance between the vertices of the polygon that replaces the boundary in an estimate.
  static constexpr double reference_spacing = 0.25;
  /// [1] Smallest factor on the width of the cells of the integral in an estimate. A layout corrects the error later.
  static constexpr double reference_coarsening = 8;
  /// [1] Exponent with which the number of points depends on the factor away from corners: the number is the area over
  /// h squared.
  static constexpr double uncrowded_power = -2;
  /// [1] Largest ratio by which one secant step changes the factor.
  static constexpr double farthest_step = 4;
  /// [sites] Smallest number of sites of a loop in an estimate, because no polygon has fewer vertices.
  static constexpr double least_sites = 3;
  /// [points asked for] In estimates and trials, counting ends if a part of one tile has this number of sites. During a
  /// search, sizes with narrow valleys gave 10^5 times as many, and took a minute. Not measured.
  static constexpr double hopelessly_many = 16;
  /// [1] Largest factor on the size by which a shape with curves or regions inside makes room for the points at narrow
  /// places. With a larger one, regions that are as wide as the triangles asked for would go. Measured: sections that
  /// lost whole layers had factors of 30 to 68; rasters of labels with cells smaller than the triangles need less
  /// than 6.
  static constexpr double coarsest_partition = 6;
  /// [h] Step of the integral along the boundary in an estimate.
  static constexpr double integral_step = 1;
  /// [1] The boundary counts as ragged if strides of length h along it are fewer than this share of its length over h.
  /// A ragged boundary will be simplified, so estimates count the strides. Not measured.
  static constexpr double ragged_strides = 0.7;
  /// [1] An estimate for a ragged boundary is raised by this times the square of the share of sites on the boundary,
  /// for the points that limits of the size will take. Measured on meshes of five coasts with 5e3 to 2e4 points: 3.4
  /// to 6.0 lead to the right size. Curves of a size that is too small by a few per cent serve, so a low value is
  /// better.
  static constexpr double limits_on_ragged = 4.2;
  /// [1] As limits_on_ragged, where corners crowd on a boundary that is not ragged but will be simplified. Measured on
  /// six coasts with 3e3 to 2e4 points: 1.5 to 6 lead to the right size. Without this number, corners that go crowd,
  /// and the search began with a size that was 4 to 13 times too large.
  static constexpr double limits_on_cornered = 2.1;
  /// [points] Number of points that the start leaves to the clean-up for each edge on a curve or an interface inside:
  /// where the sites on both sides do not fit to a round one, the clean-up inserts others. Measured: in a mesh of 1e6
  /// points with 500 discs inside 2100 triangles had an alpha above 1.11 with 0, and 91
  /// with this value.
  static constexpr double reserved_per_inner_edge = 0.1;
  /// [points] As reserved_per_inner_edge, for each end of a curve or an interface: a corner may need one more site. Not
  /// measured.
  static constexpr double reserved_per_inner_end = 1;
  /// [points asked for] Largest share of the points that the start leaves for curves and interfaces. Not measured.
  static constexpr double reserved_for_inner_edges = 0.006;
};

} // namespace trime::fitting
