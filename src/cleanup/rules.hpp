// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the clean-up. h is the size at the middle of a patch unless stated otherwise.
#pragma once

#include "trime/core/types.hpp"

#include <array>
#include <cstddef>

namespace trime::cleanup {

/// The numbers of the clean-up.
struct CleanupRules {
  // --- which triangles are improved
  // -----------------------------------------------------------------------------------
  /// [alpha] Triangles above this are bad. The clean-up improves the square with 1e5 points from 1.21 to about this
  /// alpha.
  static constexpr double bad_alpha = 1.07;
  /// [alpha] For triangles above this, insertions and deletions are tried; better triangles are improved by moves only.
  static constexpr double operate_alpha = 1.09;
  /// [alpha] For triangles above this, many trials run to their end.
  static constexpr double very_bad_alpha = 1.25;
  /// [alpha] For triangles above this, operations come before moves, because moves would make many other triangles
  /// worse.
  static constexpr double first_alpha = 1.35;
  /// [alpha] Places above this are tried once more in each later stage.
  static constexpr double again_alpha = 1.15;
  /// [1] In a mesh whose worst alpha is below again_alpha, places with more than this share of its excess are tried
  /// again. Measured: the largest alpha on the square fell from 1.0715 to 1.0699 with 1e5 points, from 1.081 to 1.073
  /// with 5e5.
  static constexpr double again_share = 0.85;
  /// [alpha] Chords of the boundary are divided only for triangles above this, because that changes the boundary.
  static constexpr double divide_alpha = 1.1;
  /// [alpha] For triangles from this alpha on, chords on curves may be longer (bent_at_last).
  static constexpr double bend_alpha = 1.1;
  /// [alpha] Least alpha for which a contest is held at a triangle near a worse one, for triangles with 0, 1, 2 and 3
  /// vertices on the boundary. Measured: of such contests 7 % helped below 1.1, and 4 % below 1.15 with three vertices
  /// on the boundary.
  static constexpr std::array<double, 4> least_beside_worse = {1.1, 1.1, 1.12, 1.15};
  /// [alpha] For triangles above this, smaller triangles are tried in the first stage. They need many sites, which the
  /// worst places get first. Measured: on North America with 9000 points the largest alpha fell from 3.140 to 1.618,
  /// compared with 1.3 here.
  static constexpr double refine_alpha_at_first = 1.45;
  /// [alpha] As refine_alpha_at_first, for later stages. Measured together with it.
  static constexpr double refine_alpha = 1.3;
  /// [alpha] Limits of classes of places: the worst class comes first in a round, and a hash orders the places of a
  /// class. A strict order by alpha would get stuck at places that cannot be improved. Not measured.
  static constexpr std::array<double, 3> classes = {1.5, 1.28, 1.14};
  /// [1] The weight of the squared excess over bad_alpha in the sum of a patch. Bad triangles must outweigh the many
  /// good ones around them.
  static constexpr double bad_weight = 10;

  // --- the extent of a patch ----------------------------------------------------------------------------------------
  /// [h] Sites within this distance of the middle are read. It leaves room for the trials (score_reach) and for
  /// free_depth. Not measured.
  static constexpr double reach = 8;
  /// [h] Sites deeper than this below the rim of a patch may change. Triangles of changed sites stay inside the patch,
  /// so the middle of the next patch may be 2 reach - free_depth away. Not measured.
  static constexpr double free_depth = 2.8;
  /// [h] Triangles of sites deeper than this below the rim count.
  static constexpr double scored_depth = 1.5;
  /// [h] Triangles deeper than this among the free sites belong to the middle of the patch; the others are left to
  /// other patches.
  static constexpr double core_depth = 1.8;
  /// [h] How far a free site may move outwards beyond free_depth. No measured case reaches this bound.
  static constexpr double most_outwards = 0.5;
  /// [1] Half of the side of the frame over the reach, so large that no corner of the frame lies in a disc of triangles
  /// that count.
  static constexpr double frame_share = 3;
  /// [sites] Nothing is tried around a place with more sites. A hexagonal lattice has 360; spikes far below h have many
  /// more. Measured: a star of 1000 spikes took 176 s without this limit and other savings, and 0.7 s with them. No
  /// measured config reaches this bound.
  static constexpr std::size_t most_in_patch = 600;
  /// [1] Factor on the radius if a disc holds more than most_in_patch.
  static constexpr double narrowing_factor = 0.75;
  /// [narrowings] Largest number of narrowings, which reduce the radius to 0.24 of it. No measured case reaches this
  /// bound.
  static constexpr int most_narrowings = 5;
  /// [1] Share of the reach within which sites rest if nothing in a patch may move.
  static constexpr double given_up_share = 0.5;
  /// [levels] Levels of the Hilbert curve along which the sites of a patch are inserted: fine enough to separate all of
  /// them. Not measured.
  static constexpr int curve_level = 8;
  /// [triangles] Largest number searched to find on which side of the boundary a triangle without inner vertices lies.
  /// Not measured.
  static constexpr std::size_t most_searched = 64;

  // --- moves --------------------------------------------------------------------------------------------------------
  /// [1] The weight of the fourth power in the energy of a star. It is so large that the worst triangle decides.
  static constexpr double quartic_weight = 10;
  /// [h] Longest Newton step. Beyond it the energy is far from a parabola.
  static constexpr double longest_move = 0.25;
  /// [h] Shorter steps are not made. Measured: 0.006 saved instructions, but left single triangles of the square with
  /// 1e5 points at alpha 1.11; with 0.003 they reach 1.07.
  static constexpr double shortest_move = 3e-3;
  /// [1] A site does not move if the energy of its star is below this: six triangles with eta below 1.006.
  static constexpr double rest_energy = 2e-4;
  /// [halvings] How often a step that does not lower the energy is halved.
  static constexpr int halvings = 3;
  /// [halvings] How often it is halved for sites on the boundary in trials that are not thorough.
  static constexpr int slide_halvings = 1;
  /// [h] Longest step along the boundary.
  static constexpr double longest_slide = 0.2;
  /// [sweeps] Largest number of sweeps over the sites of bad triangles and their neighbours.
  static constexpr int moving_sweeps = 8;
  /// [1] Share by which a sum must fall in a sweep or an operation to count as better. Less is not worth the edits.
  static constexpr double least_gain = 0.02;
  /// [h] A site that has moved farther no longer rests.
  static constexpr double waking_move = 0.05;

  // --- chords that stand for curves ---------------------------------------------------------------------------------
  /// [1] Arc over chord up to which the curve counts as straight; only rounding is allowed.
  static constexpr double straight_share = 1 + 1e-9;
  /// [1] Largest arc over chord: an arc that turns by 60 degrees is 1.047 of its chord.
  static constexpr double largest_arc_share = 1.05;
  /// [h] A curve that deviates less from its chord may have a chord of any length.
  static constexpr double unseen_stray = 0.001;
  /// [h] Longest chord of other curves. The lost area grows with its third power.
  static constexpr double bent_at_first = 1.01;
  /// [h] Longest chord of other curves for triangles from bend_alpha on. Longer chords are better than a bad triangle.
  static constexpr double bent_at_last = 1.25;

  // --- operations ---------------------------------------------------------------------------------------------------
  /// [neighbours] A site with this many or more is crowded: new sites are tried on its edges. Six are regular.
  static constexpr std::size_t many_neighbours = 7;
  /// [sites] Largest number of sites that a patch may add for smaller triangles. No measured case reaches this bound.
  static constexpr LocalIndex most_refined = 40;
  /// [1] Share of its excess by which the largest alpha must fall for smaller triangles. Measured: with a small share,
  /// the next trial improved the rest. On North America with 22000 points the largest alpha fell from 1.511 to 1.376.
  static constexpr double refine_gain = 0.01;
  /// [1] Largest growth of the sum of (degree - 6)^2 with which the trial of an operation continues. Measured: every
  /// third operation and one winner in twenty exceed it.
  static constexpr int most_strain = 2;

  // --- the contest of the operations --------------------------------------------------------------------------------
  /// [h] Sites within this distance move in the first sweeps of a trial.
  static constexpr double nearest_reach = 2;
  /// [h] Sites within this distance move in the last sweeps of a trial. Measured with score_reach: North America with
  /// 2e4 points needed 6 % fewer instructions than with wider distances; the quality over 22 sizes was the same.
  static constexpr double near_reach = 2.8;
  /// [h] Triangles of sites within this distance form the sum of a trial: near_reach and one triangle more.
  static constexpr double score_reach = 4;
  /// [sweeps] Largest number of last sweeps of a trial; thorough trials have twice as many.
  static constexpr int trial_sweeps = 3;
  /// [operations] How many continue after the first sweep in thorough trials.
  static constexpr std::size_t runners = 6;
  /// [operations] How many continue after the second sweep in thorough trials.
  static constexpr std::size_t finalists = 4;
  /// [operations] How many continue after the second sweep in other trials. Measured: the square with 3000 points needs
  /// both.
  static constexpr std::size_t few_finalists = 2;
  /// [1] A trial ends after its first sweep if its sum exceeds the required sum by this factor.
  static constexpr double hopeless_at_first = 2.5;
  /// [1] As hopeless_at_first, after the second sweep. Measured: 1600 of 3576 finalists, and 5 % of the winners, were
  /// above it.
  static constexpr double hopeless_then = 1.2;
  /// [1] As hopeless_at_first, in the last sweeps, compared with the best trial.
  static constexpr double hopeless_at_last = 1.1;
  /// [1] Factor on the three numbers above in thorough trials.
  static constexpr double patience = 2;
  /// [1] As patience, where a place is tried again. A slightly bad triangle requires a small sum, and trials that
  /// succeed may begin far above it. Measured: with 2, single triangles of 1.11 were left at the boundary of square and
  /// disc with 1e6 points; with 8 the worst had 1.10.
  static constexpr double patience_again = 8;
  /// [1] A trial that is not thorough ends if a last sweep leaves more than this share of the sum.
  static constexpr double least_fall = 0.97;
  /// [1] If the sum is below this share of the required sum, no further operation is tried. Measured: 0.75 for all
  /// trials left a triangle of alpha 1.107 on the graded square.
  static constexpr double excellent = 0.7;
  /// [1] As excellent, in thorough trials.
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
  /// [passes] Number of passes that choose the patches of a round. Measured: fewer than 5 of 600 places are left out
  /// although they had room.
  static constexpr int passes = 6;
  /// [patches] Patches are distributed only if the slowest rank then does this many fewer, one after the other. On 256
  /// ranks the distribution takes about as long as one patch. Not measured.
  static constexpr int least_spared = 2;
  /// [1] Factor on the separation. Ranks with tiles within this distance are neighbours from the beginning, so the cell
  /// and the patch of a contender reach only neighbours. If that is too little, a round is repeated with more
  /// neighbours. Not measured.
  static constexpr double foresight = 2;
  /// [log2] Width of the cells in which only the worst site contends, over one to two times its h. Wider cells leave
  /// fewer contenders to compare.
  static constexpr int contender_cell = 2;
  /// [1] Share of the sites by which their number may fall, or may rise if no number was asked for.
  static constexpr double largest_loss = 0.005;
  /// [1] Share of the sites reserved until the last stage, for places where only smaller triangles help. Measured: on
  /// North America with 17000 points the largest alpha fell from 1.61 to 1.38, compared with a smaller share.
  static constexpr double reserved = 0.006;
  /// [1] Share of the sites reserved for the stages against obtuse triangles. A coast that uses all its sites before
  /// has none left to repair these. Measured together with runners_at_last.
  static constexpr double reserved_for_obtuse = 0.0005;
  /// [sites] Number that a patch may add or remove within the limits; for smaller triangles it may add most_refined
  /// more. It does not depend on the number of patches, so a round need not count them first. Measured: with 20000
  /// points all shipped configs give the meshes that equal shares of the rest gave.
  static constexpr GlobalId patch_budget = 10;
  /// [1] Factor on the sum of a trial with fewer sites if sites have become scarce.
  static constexpr double handicap_if_scarce = 1.5;
  /// [1] Factor on the sum of a trial with fewer sites if no more sites may be added. Measured: on North America with
  /// 2e4 points the largest alpha fell from 1.633 to 1.377, because places that need sites get them.
  static constexpr double handicap_if_crowded = 0.85;
};

} // namespace trime::cleanup
