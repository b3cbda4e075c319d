// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which a boundary is generalised.
#pragma once

#include <cstddef>

namespace trime::generalise {

/// The numbers of the generalise module.
struct GeneraliseRules {
  /// [h] Parts of the shape narrower than this are cut. Not measured.
  static constexpr double narrow_inside = 0.5;
  /// [h] Parts of the outside narrower than this are closed, or widened to it. Not measured.
  static constexpr double narrow_outside = 0.33;
  /// [narrow width] A part is left alone if it is nowhere less wide: else parts of one width, about the narrow one,
  /// would be cut to pieces where nodes happen to face each other. Not measured.
  static constexpr double clearly_narrow = 0.75;
  /// [h] A narrow dead end that is less deep is left to the layout: chords pass over it. Not measured.
  static constexpr double least_depth = 0.1;
  /// [h] A corner is one that keeps its arms straight until they are so far apart. Not measured.
  static constexpr double corner_width = 0.5;
  /// [width] How far the sides of a corner may lie from two straight arms. Not measured.
  static constexpr double straight_arms = 0.15;
  /// [narrow width] Near narrow parts the curve has nodes at most so far apart. Not measured.
  static constexpr double node_spacing = 0.4;
  /// [narrow width] Nodes are added where the other side is nearer than this. Not measured.
  static constexpr double node_reach = 1.5;
  /// [rounds] Rounds of adding nodes; each node at least halves a spacing. Not measured.
  static constexpr int node_rounds = 24;
  /// [radians] Arcs have nodes at most so far apart: 15 degrees. Not measured.
  static constexpr double arc_step = 0.2617993877991494;
  /// [rounds] Of separating loops that touch in a vertex. Not measured.
  static constexpr int touch_rounds = 50;
  /// [h] A narrow part of the outside is widened if a vertex there is to move by more: else the next pass would move it
  /// again, by less. Not measured.
  static constexpr double least_shift = 0.01;
  /// [rounds] Of opening again what, once closed, is a narrow part of the shape; then all of it. Not measured.
  static constexpr int opening_rounds = 8;
  /// [distance from the end] A slit is widened by at most this share of the way from its end. Not measured.
  static constexpr double slit_taper = 0.4;
  /// [width of a slit] Vertices on its sides are joined if they are nearer to each other. Not measured.
  static constexpr double thinned = 0.5;
  /// [1] Neighbours on the curve are shifted by at most so much of their distance more or less. Not measured.
  static constexpr double steepest_shift = 0.6;
  /// [rounds] Of making shifts less steep. Not measured.
  static constexpr int calming_rounds = 40;
  /// [rounds] Of halving displacements that would turn a triangle over; then they are dropped. Not measured.
  static constexpr int displacement_rounds = 12;
  /// [h] Ragged runs of a curve lose vertices that are nearer to each other. Not measured.
  static constexpr double thinned_share = 0.05;
  /// [share of ragged runs] Smooth runs lose vertices that are nearer to each other: 0.02 h, where a chord is within
  /// 5e-5 h of a curve of radius h. Not measured.
  static constexpr double dense_share = 0.4;
  /// [1] A loop that loses more of its vertices at once is dense: it is thinned to the end before it is looked at for
  /// narrow parts. Measured, with passes that end earlier: the boundary of a coast of 10^6 segments with 10^5 points
  /// takes 9 s in place of 17.
  static constexpr double dense_loss = 0.25;
  /// [rounds] Of thinning a dense loop, at most: each may halve it, the later ones take single vertices. Not measured.
  static constexpr int dense_rounds = 30;
  /// [1] A curve is ragged where 1 - cosine of its turns adds up to more on that way: one turn of 75 degrees, or
  /// several smaller ones. Not measured.
  static constexpr double ragged_turn = 0.75;
  /// [vertices] Smallest number that a loop keeps. Not measured.
  static constexpr std::size_t least_vertices = 6;
  /// [1] If curves cross after thinning, it is tried again with this part of the share. Not measured.
  static constexpr double finer_thinning = 0.2;
  /// [h] Holes with a smaller perimeter are filled: no triangle of size h fits around them. Not measured.
  static constexpr double smallest_hole = 3;
  /// [h] Narrow parts of the outside next to a component with a smaller perimeter are closed, so that small components
  /// join before they are dropped. Not measured.
  static constexpr double small_component = 5;
  /// [h squared] What lies between narrow parts is below the resolution if its area is smaller. A disc of this area has
  /// a perimeter of 3.5 h. Measured: with 2, the points of 56 islands that nearly touch jump so much that their
  /// boundary is that for triangles twice as large.
  static constexpr double least_body = 1;
  /// [h] Narrow parts that join or separate are widened to this, if they are narrower: a row of triangles whose size is
  /// lowered to that. Measured: with 0.25, 56 islands that nearly touch have a boundary for triangles 1.8 times as
  /// large.
  static constexpr double joining_width = 0.35;
  /// [rounds] If all of the shape is narrow, half the width counts as narrow; so often at most. Not measured.
  static constexpr int narrower_rounds = 20;
  /// [passes] Over a boundary, at most: the later ones see what the earlier ones have left. Not measured.
  static constexpr int most_passes = 8;
  /// [h] Features of ragged curves that are smaller are smoothed away. Not measured.
  static constexpr double flow_reach = 0.45;
  /// [steps] Number of steps of the smoothing; each step finds again where the curve is still ragged. Not measured.
  static constexpr int flow_steps = 8;
  /// [h] Distance of nodes on curves that are smoothed. Not measured.
  static constexpr double flow_spacing = 0.12;
  /// [flow_spacing] Nodes that have come nearer to each other are joined. Not measured.
  static constexpr double flow_join = 0.4;
  /// [h] Shorter ways count as so long, lest rates become infinite. Not measured.
  static constexpr double flow_least_way = 0.005;
  /// [h] Within this distance along the curve, to both sides, turns back and forth make it ragged. Not measured.
  static constexpr double ragged_way = 1;
  /// [radians] If the turns there add up to so much more than the turn in all, the curve begins to move. Not measured.
  static constexpr double least_ragged = 0.5;
  /// [radians] With so much more than that it moves freely. Not measured.
  static constexpr double ragged_range = 0.5;
  /// [radians] Turns that are less sharp are no corners: 45 degrees. Not measured.
  static constexpr double close_turn = 0.7853981633974483;
  /// [radians] Between corners so much sharper the curve moves freely: 30 degrees. Not measured.
  static constexpr double close_range = 0.5235987755982988;
  /// [h] Corners with a shorter way between them are smoothed. Not measured.
  static constexpr double corner_arm = 1;
  /// [h] So far to both sides of them the curve moves, too. Not measured.
  static constexpr double beside_corner = 0.25;
  /// [h] Smoothing moves no vertex farther: with what was cut or widened before, curves stay within 0.5 h. Not
  /// measured.
  static constexpr double flow_most = 0.24;
  /// [h] In one step a smoothed loop grows by so much at most, to keep its area. Not measured.
  static constexpr double most_outward = 0.03;
  /// [rounds] If smoothed curves cross, it is tried again with half the reach; then nothing is smoothed. Not measured.
  static constexpr int flow_rounds = 3;
  /// [passes] For narrow parts after smoothing, at most. Not measured.
  static constexpr int late_passes = 2;
  /// [h] Neighbouring corners nearer to each other than this become one. Not measured.
  static constexpr double close_corners = 0.1;
  /// [1] 1 - cosine of the turn of such a corner: 30 degrees. Not measured.
  static constexpr double corner_turn = 0.13;
};

} // namespace trime::generalise
