// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the clean-up. h is the target edge length at the middle of a patch, unless stated otherwise.
#pragma once

#include "trime/core/types.hpp"

#include <array>
#include <cstddef>

namespace trime::cleanup {

/// The numbers of the clean-up.
struct CleanupRules {
  // --- which triangles are improved
  // -----------------------------------------------------------------------------------
  /// [alpha] Triangles with a larger alpha are bad. The clean-up lowers the largest alpha of the square with 1e5 points
  /// from 1.21 to about this value.
  static constexpr double bad_alpha = 1.07;
  /// [alpha] The same limit as bad_alpha in a mesh that starts from an old one and differs little from it. The sweeps
  /// of the next mesh of such a series undo moves that only polish.
  /// Measured: a step of a disc in a channel with 20500 points had 170 patches with 1.07.
  static constexpr double bad_alpha_of_old = 1.09;
  /// [alpha] For triangles with a larger alpha, insertions and deletions are tried; better triangles are improved by
  /// moves only.
  static constexpr double operate_alpha = 1.09;
  /// [alpha] For triangles with a larger alpha, more trials run to their end than for others.
  static constexpr double very_bad_alpha = 1.25;
  /// [alpha] For triangles with a larger alpha, insertions and deletions come before moves, because moves would make
  /// many other triangles worse.
  static constexpr double first_alpha = 1.35;
  /// [alpha] Places with a larger alpha are tried once more in each stage after the first.
  static constexpr double again_alpha = 1.15;
  /// [alpha] What a triangle with two boundary edges adds to its alpha if it is to be divided. The two halves of a
  /// corner of 60 degrees have an alpha of 1.30, so an equilateral triangle must count as much worse than that.
  /// Not measured.
  static constexpr double ear_alpha = 1;
  /// [1] Cosine of the smallest corner whose triangle is divided: its halves have angles of 30 degrees, the least angle
  /// that FVCOM accepts. It is above 0.5 because the cosine of a corner of exactly 60 degrees is rounded. Not measured.
  static constexpr double ear_cosine = 0.5 + 1e-9;
  /// [1] If the worst alpha of a mesh is below again_alpha, places are tried again if their excess over 1 is above this
  /// share of the worst excess. Measured: the largest alpha on the square fell from 1.0715 to 1.0699 with 1e5 points,
  /// from 1.081 to 1.073 with 5e5 points.
  static constexpr double again_share = 0.85;
  /// [alpha] Boundary edges are divided only for triangles with a larger alpha, because that changes the boundary.
  static constexpr double divide_alpha = 1.1;
  /// [alpha] For triangles with at least this alpha, boundary edges along bent curves may be longer: up to
  /// bent_at_last.
  static constexpr double bend_alpha = 1.1;
  /// [alpha] A bad triangle near a worse one is tried only if its alpha is at least this, for triangles with 0, 1, 2
  /// and 3 vertices on the boundary. Measured: 7 % of these trials improved the mesh below 1.1, and 4 % below 1.15 for
  /// triangles with three vertices on the boundary.
  static constexpr std::array<double, 4> least_beside_worse = {1.1, 1.1, 1.12, 1.15};
  /// [alpha] For triangles with a larger alpha, division into smaller triangles is tried in the first stage. It needs
  /// many sites, and the worst places get them first. Measured: on North America with 9000 points the largest alpha was
  /// 1.618 with this value, and 3.140 with 1.3.
  static constexpr double refine_alpha_at_first = 1.45;
  /// [alpha] The same limit as refine_alpha_at_first, in later stages. Measured together with refine_alpha_at_first.
  static constexpr double refine_alpha = 1.3;
  /// [alpha] Limits between classes of places: the worst class comes first in a round, and a hash orders the places of
  /// a class. If places were ordered by alpha, the same places would come first again and again, even if they cannot be
  /// improved. Not measured.
  static constexpr std::array<double, 3> classes = {1.5, 1.28, 1.14};
  /// [1] The weight of the squared excess of alpha over bad_alpha in the sum of a patch. A few bad triangles must count
  /// more than the many good ones around them.
  static constexpr double bad_weight = 10;

  // --- the extent of a patch ----------------------------------------------------------------------------------------
  /// [h] The sites of a patch are those within this distance of its middle. The distance includes score_reach, for the
  /// trials, and free_depth. Not measured.
  static constexpr double reach = 8;
  /// [h] Sites that are farther than this from the rim of a patch may change. The triangles of changed sites stay
  /// inside the patch, so the middle of the next patch may be 2 reach - free_depth away. Not measured.
  static constexpr double free_depth = 2.8;
  /// [h] Triangles of sites that are farther than this from the rim of a patch count in its sum.
  static constexpr double scored_depth = 1.5;
  /// [h] A patch improves only triangles that are farther than this from the edge of the area in which its sites may
  /// move; other patches improve the rest.
  static constexpr double core_depth = 1.8;
  /// [h] How far outside that area a site may move. No measured case reaches this bound.
  static constexpr double most_outwards = 0.5;
  /// [1] Half of the side of the frame around a patch, divided by the reach. The frame is so large that no corner of it
  /// lies in the circumcircle of a triangle that counts.
  static constexpr double frame_share = 3;
  /// [sites] A disc around a place that holds more sites is reduced, and finally not tried. A hexagonal lattice has 360
  /// sites in it; places with spikes much smaller than h have many more. Measured: a star of 1000 spikes took 176 s
  /// without this limit and other savings, and 0.7 s with them. No measured config reaches this bound.
  static constexpr std::size_t most_in_patch = 600;
  /// [1] Factor on the radius of a disc that holds more than most_in_patch sites.
  static constexpr double narrowing_factor = 0.75;
  /// [reductions] Largest number of reductions of the radius, to 0.24 of the reach. No measured case reaches this
  /// bound.
  static constexpr int most_narrowings = 5;
  /// [1] If no site of a patch may move, its sites rest within this share of the reach.
  static constexpr double given_up_share = 0.5;
  /// [levels] Levels of the Hilbert curve along which the sites of a patch are inserted. The cells of this level are so
  /// small that each holds one site. Not measured.
  static constexpr int curve_level = 8;
  /// [triangles] Largest number of triangles that are searched to find on which side of the boundary a triangle without
  /// inner vertices lies. Not measured.
  static constexpr std::size_t most_searched = 64;

  // --- moves --------------------------------------------------------------------------------------------------------
  /// [1] The weight of the fourth power in the energy of a star. The weight is so large that the worst triangle
  /// decides.
  static constexpr double quartic_weight = 10;
  /// [h] Longest Newton step. A parabola does not describe the energy beyond this distance.
  static constexpr double longest_move = 0.25;
  /// [h] Steps that are shorter are not made. Measured: 0.006 needed fewer instructions, but left single triangles of
  /// the square with 1e5 points at alpha 1.11; with 0.003 their alpha falls to 1.07.
  static constexpr double shortest_move = 3e-3;
  /// [1] A site does not move if the energy of its star is below this. That is the energy of six triangles with an eta
  /// of 1.006.
  static constexpr double rest_energy = 2e-4;
  /// [halvings] How often a step is halved if it does not lower the energy.
  static constexpr int halvings = 3;
  /// [halvings] How often such a step is halved for sites on the boundary, in trials that are not thorough.
  static constexpr int slide_halvings = 1;
  /// [h] Largest distance of a site on a simplified interface from its place before the clean-up. Such a site moves
  /// parallel to the line between its neighbours, so it leaves the curve. Not measured.
  static constexpr double longest_bent_slide = 0.3;
  /// [h] Largest length of a chord of a bent curve inside after one of its ends has moved. The areas on both sides
  /// depend on the lengths of the chords. Not measured.
  static constexpr double longest_bent_chord = 1.07;
  /// [h] Smallest length of such a chord. Not measured.
  static constexpr double shortest_bent_chord = 0.93;
  /// [h] Longest step along the boundary.
  static constexpr double longest_slide = 0.2;
  /// [sweeps] Largest number of sweeps over the sites of bad triangles and their neighbours.
  static constexpr int moving_sweeps = 8;
  /// [1] A sweep or an operation counts as better if the sum falls by at least this share. A smaller gain is not worth
  /// a change.
  static constexpr double least_gain = 0.02;
  /// [h] A site that has moved farther than this no longer rests.
  static constexpr double waking_move = 0.05;

  // --- boundary edges that replace curves ---------------------------------------------------------------------------
  /// [1] A curve counts as straight if its length is at most this multiple of the length of its boundary edge. The
  /// multiple allows only for rounding.
  static constexpr double straight_share = 1 + 1e-9;
  /// [1] Largest ratio of the length of a curve to the length of its boundary edge: for an arc that turns by 60 degrees
  /// the ratio is 1.047.
  static constexpr double largest_arc_share = 1.05;
  /// [h] If a curve deviates from its boundary edge by less than this, the edge may have any length.
  static constexpr double unseen_stray = 0.001;
  /// [h] Largest length of a boundary edge for other curves. The area between edge and curve grows with the third power
  /// of this length.
  static constexpr double bent_at_first = 1.01;
  /// [h] Largest length of such an edge at triangles with an alpha of at least bend_alpha. Longer edges are better than
  /// a bad triangle.
  static constexpr double bent_at_last = 1.25;

  // --- operations ---------------------------------------------------------------------------------------------------
  /// [neighbours] If a site has at least this many neighbours, new sites are tried on its edges. A regular site has
  /// six.
  static constexpr std::size_t many_neighbours = 7;
  /// [sites] Largest number of sites that a patch may add to divide triangles. No measured case reaches this bound.
  static constexpr LocalIndex most_refined = 40;
  /// [1] The excess of the largest alpha over 1 must fall by this share for a division into smaller triangles to be
  /// kept. A small share suffices, because the next trial improves the rest. Measured: on North America with 22000
  /// points the largest alpha fell from 1.511 to 1.376.
  static constexpr double refine_gain = 0.01;
  /// [1] The trial of an operation continues only if the sum of (degree - 6)^2 rises by at most this. Measured: every
  /// third operation and one winner in twenty exceed this limit.
  static constexpr int most_strain = 2;

  // --- the comparison of the operations -----------------------------------------------------------------------------
  /// [h] Sites within this distance of the bad triangle move in the first sweeps of a trial.
  static constexpr double nearest_reach = 2;
  /// [h] Sites within this distance of the bad triangle move in the last sweeps of a trial. Measured together with
  /// score_reach: North America with 2e4 points needed 6 % fewer instructions than with larger distances; the quality
  /// over 22 sizes was the same.
  static constexpr double near_reach = 2.8;
  /// [h] Triangles of sites within this distance of the bad triangle count in the sum of a trial: near_reach and one
  /// triangle more.
  static constexpr double score_reach = 4;
  /// [sweeps] Largest number of last sweeps of a trial; thorough trials have twice as many.
  static constexpr int trial_sweeps = 3;
  /// [operations] Number of operations that continue after the first sweep in thorough trials.
  static constexpr std::size_t runners = 6;
  /// [operations] Number of operations that continue after the second sweep in thorough trials.
  static constexpr std::size_t finalists = 4;
  /// [operations] Number of operations that continue after the second sweep in other trials. Measured: with only one,
  /// the square with 3000 points is worse.
  static constexpr std::size_t few_finalists = 2;
  /// [1] A trial ends after its first sweep if its sum exceeds the required sum by this factor.
  static constexpr double hopeless_at_first = 2.5;
  /// [1] A trial ends after its second sweep if its sum exceeds the required sum by this factor. Measured: 1600 of 3576
  /// trials that reached the second sweep, and 5 % of the winners, were above it.
  static constexpr double hopeless_then = 1.2;
  /// [1] A trial ends in its last sweeps if its sum exceeds the sum of the best trial so far by this factor.
  static constexpr double hopeless_at_last = 1.1;
  /// [1] hopeless_at_first and hopeless_then are multiplied by this in thorough trials.
  static constexpr double patience = 2;
  /// [1] This replaces `patience` where a place is tried again. For a slightly bad triangle the required sum is small,
  /// and trials that succeed may begin far above it. Measured: with 2, single triangles with an alpha of 1.11 were left
  /// at the boundary of square and disc with 1e6 points; with 8 the worst had 1.10.
  static constexpr double patience_again = 8;
  /// [1] A trial that is not thorough ends if its sum after one of the last sweeps is above this share of the sum
  /// before that sweep.
  static constexpr double least_fall = 0.97;
  /// [1] If the sum of a trial is below this share of the required sum, no further operation is tried. Measured: with
  /// 0.75 for all trials, a triangle with an alpha of 1.107 was left on the graded square.
  static constexpr double excellent = 0.7;
  /// [1] The same share as `excellent`, in thorough trials.
  static constexpr double excellent_if_thorough = 0.6;

  // --- obtuse triangles ---------------------------------------------------------------------------------------------
  /// [cotangent] In the stages against obtuse triangles, angles with a smaller cotangent cost energy: from 86.6
  /// degrees on, so that the sites come to rest below 90 degrees. Not measured.
  static constexpr double steep_cotangent = 0.06;
  /// [1] The weight of the squared lack of cotangent in the energy of a star: an angle of 94 degrees costs about as
  /// much as its triangle. Not measured.
  static constexpr double steep_weight = 6;
  /// [cotangent] Angles with a smaller cotangent count as obtuse in the sum of a patch: from 89.97 degrees on, because
  /// the sum is rounded. Not measured.
  static constexpr double obtuse_cotangent = 5e-4;
  /// [1] What an obtuse triangle adds to the sum of a patch, by stage: as much as several bad triangles. Measured: in
  /// seven meshes of four coasts the two stages left 35 of 178 obtuse triangles.
  static constexpr std::array<double, 2> obtuse_weight = {0.5, 4};
  /// [1] What it adds for each unit of cotangent below 0, in units of obtuse_weight. Not measured.
  static constexpr double obtuse_slope = 5;
  /// [h] As near_reach, in these stages: a row of triangles that is shifted along the boundary needs wide surroundings
  /// to adapt. Measured with score_reach_if_obtuse, obtuse_sweeps and alpha_for_obtuse: of 76 obtuse triangles of
  /// coasts 55 were left.
  static constexpr double near_reach_if_obtuse = 4;
  /// [h] As score_reach, in these stages: near_reach_if_obtuse and one triangle more. Measured together with it.
  static constexpr double score_reach_if_obtuse = 5.3;
  /// [sweeps] Largest number of last sweeps of a trial in these stages. Measured together with near_reach_if_obtuse.
  static constexpr int obtuse_sweeps = 14;
  /// [alpha] An operation that removes an obtuse triangle may leave other triangles up to this alpha. Measured together
  /// with near_reach_if_obtuse.
  static constexpr double alpha_for_obtuse = 1.28;
  /// [alpha] By how much the largest alpha near a curve inside may rise in the first stage if the sum falls: where two
  /// places are side by side, two operations are needed. Measured: in a mesh of 1e6 points with 500 discs inside,
  /// with FitRules::reserved_per_inner_edge = 0.06, 204 triangles had an alpha above 1.11 with this value, and 251 with
  /// 0.
  static constexpr double rise_at_curves = 0.03;
  /// [operations] As runners, in the last of these stages. Measured with finalists_at_last, first_of_two and
  /// reserved_for_obtuse: of 43 obtuse triangles of coasts 23 were left.
  static constexpr std::size_t runners_at_last = 16;
  /// [operations] As finalists, in the last of these stages. Measured together with runners_at_last.
  static constexpr std::size_t finalists_at_last = 10;
  /// [operations] How many are followed by a second operation in the last of these stages, if none helps alone.
  /// Measured together with runners_at_last.
  static constexpr std::size_t first_of_two = 3;

  // --- rounds, and the number of sites ------------------------------------------------------------------------------
  /// [stages] The first stage tries every bad place; the others try the worst places of the mesh again.
  static constexpr int stages = 3;
  /// [stages] Stages that follow for obtuse triangles only. A mesh without such triangles stays as it is. Measured: see
  /// obtuse_weight.
  static constexpr int obtuse_stages = 2;
  /// [rounds] Largest number of rounds of a stage. No measured case reaches this bound.
  static constexpr int most_rounds = 250;
  /// [passes] Number of passes in which the patches of a round are chosen. Measured: fewer than 5 of 600 places are not
  /// chosen although they are far enough from all that are.
  static constexpr int passes = 6;
  /// [patches] Patches are distributed over the ranks only if the slowest rank then tries at least this many fewer, one
  /// after the other. On 256 ranks the distribution takes about as long as one patch. Not measured.
  static constexpr int least_spared = 2;
  /// [1] Ranks are neighbours from the beginning if their tiles are closer together than this multiple of the
  /// separation, so the cell and the patch of a contender reach only tiles of neighbours. If the multiple is too small,
  /// a round is repeated with more neighbours. Not measured.
  static constexpr double foresight = 2;
  /// [log2] Of all sites in a cell, only the worst contends. The width of the cell is 2 to this power, times one to two
  /// h. With wider cells there are fewer contenders to compare.
  static constexpr int contender_cell = 2;
  /// [1] Share of the sites by which their number may fall, and by which it may rise if the user has not asked for a
  /// number of points.
  static constexpr double largest_loss = 0.005;
  /// [sites] By how much more the number may rise for each edge on a curve or an interface inside, if the user has not
  /// asked for a number of points. If the user has, FitRules::reserved_per_inner_edge leaves room. Measured with
  /// that number.
  static constexpr double inserted_per_inner_edge = 0.1;
  /// [1] Share of the sites that are kept back until the last stage, for places where only smaller triangles help.
  /// Measured: on North America with 17000 points the largest alpha was 1.38 with this share, and 1.61 with a smaller
  /// one.
  static constexpr double reserved = 0.006;
  /// [1] Share of the sites reserved for the stages against obtuse triangles. A coast that uses all its sites before
  /// has none left to repair these. Measured together with runners_at_last.
  static constexpr double reserved_for_obtuse = 0.0005;
  /// [sites] Number that a patch may add or remove within the limits; for smaller triangles it may add most_refined
  /// more. It does not depend on the number of patches, so a round need not count them first. Measured: with 20000
  /// points all shipped configs give the meshes that equal shares of the rest gave.
  static constexpr GlobalId patch_budget = 10;
  /// [1] Factor on the sum of a trial with fewer sites if many sites have already been removed.
  static constexpr double handicap_if_scarce = 1.5;
  /// [1] Factor on the sum of a trial with fewer sites if no more sites may be added. Measured: on North America with
  /// 2e4 points the largest alpha fell from 1.633 to 1.377, because the removed sites are used where more are needed.
  static constexpr double handicap_if_crowded = 0.85;
};

} // namespace trime::cleanup
