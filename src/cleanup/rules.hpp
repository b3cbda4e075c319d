// SPDX-License-Identifier: BSD-3-Clause
// Every tuned number of the clean-up, once. h is the size at the middle of a patch if nothing else is said.
#pragma once

#include "trime/core/types.hpp"

#include <array>
#include <cstddef>

namespace trime::cleanup {

/// The numbers of the clean-up.
struct CleanupRules {
  // --- which triangles are improved
  // -----------------------------------------------------------------------------------
  /// [alpha] Triangles above it are bad. The square with 1e5 points ends at about this alpha, from 1.21 before.
  static constexpr double bad_alpha = 1.07;
  /// [alpha] Above it insertions and deletions are tried, too: what is nearly good is left to moves.
  static constexpr double operate_alpha = 1.09;
  /// [alpha] Above it triangles are worth trials that run to their end.
  static constexpr double very_bad_alpha = 1.25;
  /// [alpha] Above it operations come before moves, which would spread a hole over many triangles.
  static constexpr double first_alpha = 1.35;
  /// [alpha] Places above it are tried once more in each later stage.
  static constexpr double again_alpha = 1.15;
  /// [1] Share of the worst excess of the mesh: in a mesh below again_alpha places above it are tried again. Measured:
  /// the largest alpha on the square fell from 1.0715 to 1.0699 with 1e5 points, from 1.081 to 1.073 with 5e5.
  static constexpr double again_share = 0.85;
  /// [alpha] Chords of the boundary are divided for triangles above it: that changes the shape.
  static constexpr double divide_alpha = 1.1;
  /// [alpha] Chords on curves may be longer (bent_at_last) for triangles from it on.
  static constexpr double bend_alpha = 1.1;
  /// [alpha] Least that makes a triangle with 0, 1, 2, 3 vertices on the boundary worth a contest next to a worse one.
  /// Measured: of such contests 7 % helped below 1.1, and 4 % below 1.15 with three vertices on the boundary.
  static constexpr std::array<double, 4> least_beside_worse = {1.1, 1.1, 1.12, 1.15};
  /// [alpha] Smaller triangles are tried above it in the first stage: they take many sites, which the worst places get
  /// first. Measured: North America, 9000 points, largest alpha 3.140 to 1.618 against spending them from 1.3 on.
  static constexpr double refine_alpha_at_first = 1.45;
  /// [alpha] The same in later stages. Measured together with refine_alpha_at_first.
  static constexpr double refine_alpha = 1.3;
  /// [alpha] Limits of the classes in which the worst places of a round come first. Few classes leave the order to a
  /// hash: choosing strictly by alpha gets stuck behind places that cannot be helped. Not measured.
  static constexpr std::array<double, 3> classes = {1.5, 1.28, 1.14};
  /// [1] Weight of the squared excess over bad_alpha in the sum of a patch. Bad triangles must outweigh the many good
  /// ones around them.
  static constexpr double bad_weight = 10;

  // --- the extent of a patch ----------------------------------------------------------------------------------------
  /// [h] Sites within it of the middle are read: room for the trials (score_reach) and for free_depth. Not measured.
  static constexpr double reach = 8;
  /// [h] Depth below the rim of what is read from which sites may change. It holds what a triangle of a changed site
  /// reaches; so the next patch may begin 2 reach - free_depth away. Not measured.
  static constexpr double free_depth = 2.8;
  /// [h] Depth below the rim from which triangles of sites count.
  static constexpr double scored_depth = 1.5;
  /// [h] Triangles so far within the free sites count as the middle of the patch; others are left to other patches.
  static constexpr double core_depth = 1.8;
  /// [h] How far a free site may move outwards past free_depth. A bound; no case measured reaches it.
  static constexpr double most_outwards = 0.5;
  /// [1] Half the side of the frame over the reach: no corner of it may lie in a disc of triangles that count.
  static constexpr double frame_share = 3;
  /// [sites] With more around a place nothing is tried. A hexagonal lattice has 360; spikes far below h crowd many
  /// more. Measured: a star of 1000 spikes took 176 s without this limit and other savings, 0.7 s with them.
  /// A bound; no case measured reaches it.
  static constexpr std::size_t most_in_patch = 600;
  /// [1] Factor on the radius if a disc holds more than most_in_patch.
  static constexpr double narrowing_factor = 0.75;
  /// [narrowings] At most: to 0.24 of the radius. A bound; no case measured reaches it.
  static constexpr int most_narrowings = 5;
  /// [1] Share of the reach: sites within it rest where a patch finds nothing that may move.
  static constexpr double given_up_share = 0.5;
  /// [levels] Levels of the Hilbert curve along which the sites of a patch are inserted: fine enough to separate all of
  /// them. Not measured.
  static constexpr int curve_level = 8;
  /// [triangles] Searched, at most, to learn on which side of the boundary one without inner vertices lies. Not
  /// measured.
  static constexpr std::size_t most_searched = 64;

  // --- moves --------------------------------------------------------------------------------------------------------
  /// [1] Weight of the fourth power in the energy of a star, so that the worst triangle rules.
  static constexpr double quartic_weight = 10;
  /// [h] Longest Newton step: the energy is far from a parabola beyond it.
  static constexpr double longest_move = 0.25;
  /// [h] Shorter steps are no moves. Measured: 0.006 saved instructions, but left single triangles of the square with
  /// 1e5 points at alpha 1.11; with 0.003 they come to 1.07.
  static constexpr double shortest_move = 3e-3;
  /// [1] Energy of a star below which its site stays: six triangles with eta below 1.006.
  static constexpr double rest_energy = 2e-4;
  /// [halvings] Of a step that does not lower the energy.
  static constexpr int halvings = 3;
  /// [halvings] The same for sites on the boundary in trials that are not thorough.
  static constexpr int slide_halvings = 1;
  /// [h] Longest step along the boundary.
  static constexpr double longest_slide = 0.2;
  /// [sweeps] Over the sites of bad triangles and their neighbours, at most.
  static constexpr int moving_sweeps = 8;
  /// [1] Share by which a sum has to fall to count as better, in a sweep or by an operation: less is not worth the
  /// edits.
  static constexpr double least_gain = 0.02;
  /// [h] A site that has moved farther no longer rests.
  static constexpr double waking_move = 0.05;

  // --- chords that stand for curves ---------------------------------------------------------------------------------
  /// [1] Arc over chord up to which a chord follows a straight side: only rounding is allowed.
  static constexpr double straight_share = 1 + 1e-9;
  /// [1] Largest arc over chord: an arc that turns by 60 degrees is 1.047 of its chord.
  static constexpr double largest_arc_share = 1.05;
  /// [h] A curve that strays less from its chord may have a chord of any length.
  static constexpr double unseen_stray = 0.001;
  /// [h] Longest chord of other curves: the area that is lost grows with the third power.
  static constexpr double bent_at_first = 1.01;
  /// [h] The same for triangles from bend_alpha on: rather longer chords than a bad triangle.
  static constexpr double bent_at_last = 1.25;

  // --- operations ---------------------------------------------------------------------------------------------------
  /// [neighbours] A site with this many or more is crowded: new sites are tried on its edges. Six are regular.
  static constexpr std::size_t many_neighbours = 7;
  /// [sites] That one patch may add in order to have smaller triangles. A bound; no case measured reaches it.
  static constexpr LocalIndex most_refined = 40;
  /// [1] Share of the excess by which the largest alpha has to fall for smaller triangles. Measured: where little was
  /// enough the next try improved the rest; North America with 22000 points, largest alpha 1.511 to 1.376.
  static constexpr double refine_gain = 0.01;
  /// [1] Growth of the sum of (degree - 6)^2 up to which an operation is tried further. Measured: one winner in twenty
  /// adds more, and every third operation.
  static constexpr int most_strain = 2;

  // --- the contest of the operations --------------------------------------------------------------------------------
  /// [h] Sites that move in the first sweeps of a trial.
  static constexpr double nearest_reach = 2;
  /// [h] Sites that move in the last sweeps. Measured with score_reach: 6 % fewer instructions on North America with
  /// 2e4 points than with wider ones, the quality over 22 sizes the same.
  static constexpr double near_reach = 2.8;
  /// [h] Triangles of sites within it make up the sum of a trial: near_reach and one triangle more.
  static constexpr double score_reach = 4;
  /// [sweeps] The last ones of a trial, at most; twice as many in thorough trials.
  static constexpr int trial_sweeps = 3;
  /// [operations] That go beyond the first sweep in thorough trials.
  static constexpr std::size_t runners = 6;
  /// [operations] That go beyond the second sweep in thorough trials.
  static constexpr std::size_t finalists = 4;
  /// [operations] That go beyond the second in other trials. Measured: the square with 3000 points needs the second.
  static constexpr std::size_t few_finalists = 2;
  /// [1] Sum over the bar above which a trial is given up after its first sweep.
  static constexpr double hopeless_at_first = 2.5;
  /// [1] The same after its second sweep. Measured: of 3576 finalists 1600 were above it, and 5 % of the winners.
  static constexpr double hopeless_then = 1.2;
  /// [1] The same in the last sweeps, over the best trial.
  static constexpr double hopeless_at_last = 1.1;
  /// [1] Factor on what is hopeless in thorough trials.
  static constexpr double patience = 2;
  /// [1] The same where a place is tried again: a triangle that is hardly bad sets a low bar, and what helps it may
  /// begin far above. Measured: with 2 single triangles of 1.11 stayed at the boundary of square and disc with 1e6
  /// points, with 8 none above 1.10.
  static constexpr double patience_again = 8;
  /// [1] A last sweep that leaves more of the sum ends a trial that is not thorough.
  static constexpr double least_fall = 0.97;
  /// [1] Sum over the bar below which no further operation is tried. Measured: 0.75 for all trials left a triangle of
  /// alpha 1.107 on the graded square.
  static constexpr double excellent = 0.7;
  /// [1] The same in thorough trials.
  static constexpr double excellent_if_thorough = 0.6;

  // --- rounds, and the number of sites ------------------------------------------------------------------------------
  /// [stages] The first tries every bad place, the others try again what is bad for this mesh.
  static constexpr int stages = 3;
  /// [rounds] Of a stage, at most: a bound; no case measured reaches it.
  static constexpr int most_rounds = 250;
  /// [passes] That choose the patches of a round. Measured: fewer than 5 of 600 places are left out that had room.
  static constexpr int passes = 6;
  /// [patches] One after the other that the slowest rank must be spared for patches to be dealt out: on 256 ranks that
  /// takes about as long as one patch. Not measured.
  static constexpr int least_spared = 2;
  /// [1] Factor on the separation: ranks with tiles within it are neighbours from the first, so that candidates in the
  /// cell of a contender, and in its patch, reach to none but neighbours. Where that is too little, a round is done
  /// again with more neighbours. Not measured.
  static constexpr double foresight = 2;
  /// [log2] Width of the cells in which the worst site contends, divided by once to twice its h: it leaves fewer
  /// contenders to compare.
  static constexpr int contender_cell = 2;
  /// [1] Share of the sites by which their number may fall, or rise if no number was asked for.
  static constexpr double largest_loss = 0.005;
  /// [1] Share of the sites kept until the last stage, for places where only smaller triangles help. Measured: North
  /// America, largest alpha 1.61 to 1.38 with 17000 points against a smaller share.
  static constexpr double reserved = 0.006;
  /// [sites] A patch may add or take this many as long as the limits leave them; smaller triangles may be most_refined
  /// more. It does not depend on how many patches share what is left, so that a round need not count them before.
  /// Measured: with 20000 points all shipped configs give the meshes that equal shares of the rest gave.
  static constexpr GlobalId patch_budget = 10;
  /// [1] Factor on the sum of a trial with fewer sites where sites have become scarce.
  static constexpr double handicap_if_scarce = 1.5;
  /// [1] The same where there is no room for more sites. Measured: North America with 2e4 points, largest alpha 1.633
  /// to 1.377, since room is left for places that need it.
  static constexpr double handicap_if_crowded = 0.85;
};

} // namespace trime::cleanup
