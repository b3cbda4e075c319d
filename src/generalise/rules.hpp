// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module generalise, which simplifies boundaries to the resolution of the mesh.
#pragma once

#include <cstddef>

namespace trime::generalise {

/// The numbers that decide how a boundary is simplified.
struct GeneraliseRules {
  /// [h] Parts of the shape that are narrower than this are cut. Not measured.
  static constexpr double narrow_inside = 0.5;
  /// [h] Parts of the outside that are narrower than this are filled, or widened to this width. Not measured.
  static constexpr double narrow_outside = 0.33;
  /// [narrow width] A part that is nowhere narrower than this is not changed. Without this limit, parts with a constant
  /// width of about the narrow width would be cut to pieces where nodes happen to face each other. Not measured.
  static constexpr double clearly_narrow = 0.75;
  /// [h] A narrow dead end that is less deep is not cut; the boundary edges of the mesh pass over it. Not measured.
  static constexpr double least_depth = 0.1;
  /// [h] A dead end counts as a corner if its sides are straight until they are this far apart. Not measured.
  static constexpr double corner_width = 0.5;
  /// [width] Largest distance of the sides of a corner from two straight lines. Not measured.
  static constexpr double straight_arms = 0.15;
  /// [narrow width] Largest distance between nodes of the curve near narrow parts. Not measured.
  static constexpr double node_spacing = 0.4;
  /// [narrow width] Nodes are added to a curve where the other side is nearer than this. Not measured.
  static constexpr double node_reach = 1.5;
  /// [rounds] Number of rounds in which nodes are added; each new node at least halves a distance between nodes. Not
  /// measured.
  static constexpr int node_rounds = 24;
  /// [radians] Largest turn of an arc between two nodes: 15 degrees. Not measured.
  static constexpr double arc_step = 0.2617993877991494;
  /// [h] Largest distance between an arc of an interface and its chords, where the arc becomes chords because another
  /// line ends on it or follows it. Not measured.
  static constexpr double arc_depth = 0.02;
  /// [h] Distance of the places along a curve at which its distance from other lines is measured. Not measured.
  static constexpr double place_step = 0.1;
  /// [h] Parts of a curve that are so long are looked at as a whole first; most have no other line near. Not measured.
  static constexpr double whole_part = 2;
  /// [1] They are searched at this multiple of the distance that counts, because h may grow along the part. Not
  /// measured.
  static constexpr double grown_distance = 1.5;
  /// [rounds] Largest number of rounds in which loops that touch in a vertex are separated. Not measured.
  static constexpr int touch_rounds = 50;
  /// [h] A narrow part of the outside is widened only if a vertex there moves by more than this. Otherwise the next
  /// pass would move the vertex again by a smaller distance. Not measured.
  static constexpr double least_shift = 0.01;
  /// [rounds] Largest number of rounds in which filled parts of the outside are opened again, because filling made
  /// narrow parts of the shape. After these rounds, all filled parts are opened. Not measured.
  static constexpr int opening_rounds = 8;
  /// [distance from the end] Largest widening of a slit, as a share of the distance from its end. Not measured.
  static constexpr double slit_taper = 0.4;
  /// [width of a slit] Vertices on the sides of a slit are joined if they are nearer to each other than this. Not
  /// measured.
  static constexpr double thinned = 0.5;
  /// [1] Largest difference between the shifts of two neighbours on a curve, divided by their distance. Not measured.
  static constexpr double steepest_shift = 0.6;
  /// [rounds] Number of rounds in which steep differences between shifts are reduced. Not measured.
  static constexpr int calming_rounds = 40;
  /// [rounds] Number of rounds in which displacements that would invert a triangle are halved; displacements that would
  /// still invert a triangle are dropped. Not measured.
  static constexpr int displacement_rounds = 12;
  /// [h^2] A vertex of a curve inside the shape may be removed if its triangle with its neighbours is smaller. A curve
  /// of radius h then keeps a vertex every 0.8 h. Not measured.
  static constexpr double vertex_area = 0.12;
  /// [h] Such a vertex stays if it is farther from the edge that would replace it. Not measured.
  static constexpr double vertex_move = 0.4;
  /// [h] Such a vertex of a curve stays if another vertex lies beyond that edge, but nearer to it than this. Not
  /// measured.
  static constexpr double clearance = 0.01;
  /// [h] Two nodes of curves and interfaces that are joined by a shorter edge become one node, because shorter edges
  /// need triangles that are as small. Not measured.
  static constexpr double node_distance = 0.1;
  /// [h] A connected part of a region with a shorter perimeter belongs to the region next to it. Not measured.
  static constexpr double smallest_face = 3;
  /// [h] So does a part whose area is smaller than this times half of its perimeter. Not measured.
  static constexpr double narrowest_face = 0.1;
  /// [h] Narrow passages of a region, and narrow ends of it at the boundary, belong to the region next to them if they
  /// are narrower than this. Not measured.
  static constexpr double narrow_region = 0.35;
  /// [1] So does a narrow end whose width is smaller than this times its depth: a tip of less than 20 degrees. Not
  /// measured.
  static constexpr double thin_tip = 0.35;
  /// [h] Such tips are cut where they have this width. Not measured.
  static constexpr double cut_tip = 0.25;
  /// [h] A curve and an interface, or two curves, become one line where they lie nearer to each other, because the user
  /// means one line that was digitised twice. Not measured.
  static constexpr double snap_distance = 0.2;
  /// [1] Two curves that meet follow each other if their distance is below this share of the way along them from one to
  /// the other: they then meet at less than about 20 degrees. Not measured.
  static constexpr double narrow_share = 0.35;
  /// [h] Where a curve comes nearer to the boundary, an interface or another curve than snap_distance, the part of it
  /// that is nearer than this belongs to that line. Then what is left leaves the line with triangles next to it that
  /// are hardly smaller. Interfaces that lead through vertices of curves stay as near to the given ones. Measured for
  /// these on 60 maps: with 0.2, 50 can be meshed; with 0.4, 51; without a limit 54, but interfaces stray in 6.
  static constexpr double rim_distance = 0.4;
  /// [1] Largest sine of the angle between two lines that follow each other: 35 degrees. Not measured.
  static constexpr double parallel = 0.57;
  /// [h] Ragged runs of a curve lose vertices that are nearer to each other. Measured on twelve meshes of coasts: with
  /// 0.05, the simplification takes 1.25 times as long, the mean of the largest alphas is 1.250 instead of 1.238, and
  /// that of the smallest angles 35.3 degrees instead of 37.1.
  static constexpr double thinned_share = 0.1;
  /// [share of ragged runs] Smooth runs lose vertices that are nearer to each other: 0.02 h, at which a chord lies
  /// within 5e-5 h of a curve of radius h. Not measured.
  static constexpr double dense_share = 0.2;
  /// [1] A loop that loses a larger share of its vertices at once is dense, and is thinned until nothing changes before
  /// narrow parts are searched. Measured, with passes that end earlier: the boundary of a coast of 10^6 segments with
  /// 10^5 points takes 9 s instead of 17 s.
  static constexpr double dense_loss = 0.25;
  /// [rounds] Largest number of rounds that thin a dense loop. A round may halve the number of vertices; later rounds
  /// remove single vertices. Not measured.
  static constexpr int dense_rounds = 30;
  /// [1] A curve is ragged where the sum of 1 - cosine of its turns exceeds this number over the distance
  /// thinned_share: one turn of 75 degrees, or several smaller turns. Not measured.
  static constexpr double ragged_turn = 0.75;
  /// [vertices] Smallest number of vertices that a loop keeps. Not measured.
  static constexpr std::size_t least_vertices = 6;
  /// [h] A hole with a smaller perimeter is filled, because no triangle of size h fits around it. Not measured.
  static constexpr double smallest_hole = 3;
  /// [h] Narrow parts of the outside next to a component with a smaller perimeter are filled, so that small components
  /// join before they are dropped. Not measured.
  static constexpr double small_component = 5;
  /// [h squared] A body between narrow parts counts as smaller than the triangles if its area is smaller than this. A
  /// disc of this area has a perimeter of 3.5 h. Measured: with 2, the number of points for 56 islands that nearly
  /// touch jumps so much that their boundary is simplified for triangles twice as large.
  static constexpr double least_body = 1;
  /// [h squared] A body with a smaller area does not stay alone where the parts that join it are cut: that would leave
  /// half a dozen triangles. Not measured.
  static constexpr double least_cut_off = 2.5;
  /// [h] Narrow parts that join or separate are widened to this, if they are narrower: a row of triangles whose size is
  /// lowered to that. Measured: with 0.25, 56 islands that nearly touch have a boundary for triangles 1.8 times as
  /// large.
  static constexpr double joining_width = 0.35;
  /// [rounds] If all of the shape is narrow, half the width counts as narrow; this is the largest number of such
  /// halvings. Not measured.
  static constexpr int narrower_rounds = 20;
  /// [passes] Largest number of passes over a boundary. Later passes treat narrow parts that earlier passes have left.
  /// Not measured.
  static constexpr int most_passes = 8;
  /// [h] Features of ragged curves that are smaller than this are smoothed away. Not measured.
  static constexpr double flow_reach = 0.45;
  /// [steps] Number of steps of the smoothing; each step finds again where the curve is still ragged. Not measured.
  static constexpr int flow_steps = 8;
  /// [h] Distance between nodes on curves that are smoothed. Not measured.
  static constexpr double flow_spacing = 0.12;
  /// [flow_spacing] Nodes that have come nearer to each other than this are joined. Not measured.
  static constexpr double flow_join = 0.4;
  /// [h] Nodes that have moved go if the curve without them lies nearer to them than this. Measured on 21 meshes of
  /// coasts: the mean of the largest alphas is 1.226; with 0.003 it is 1.243, at the same time, and without it 1.236,
  /// in 1.2 times the time.
  static constexpr double flow_flat = 0.001;
  /// [h] Longest edge that such nodes leave. Not measured.
  static constexpr double flow_longest = 0.5;
  /// [h] Shorter distances between nodes count as this long, so that rates stay finite. Not measured.
  static constexpr double flow_least_way = 0.005;
  /// [h] A curve is ragged where it turns back and forth within this distance along the curve, to both sides. Not
  /// measured.
  static constexpr double ragged_way = 1;
  /// [radians] The curve begins to move if the sum of the absolute turns there exceeds the net turn by this angle. Not
  /// measured.
  static constexpr double least_ragged = 0.5;
  /// [radians] The curve moves freely if the sum of the absolute turns exceeds the net turn by this angle in addition
  /// to least_ragged. Not measured.
  static constexpr double ragged_range = 0.5;
  /// [radians] Turns smaller than this do not count as corners: 45 degrees. Not measured.
  static constexpr double close_turn = 0.7853981633974483;
  /// [radians] Between corners that turn by this angle more than that, the curve moves freely: 30 degrees. Not
  /// measured.
  static constexpr double close_range = 0.5235987755982988;
  /// [h] Two corners with a shorter distance between them are smoothed. Not measured.
  static constexpr double corner_arm = 1;
  /// [h] The curve also moves within this distance on both sides of such corners. Not measured.
  static constexpr double beside_corner = 0.25;
  /// [h] Largest distance by which smoothing moves a vertex. Together with earlier cuts and widenings, curves stay
  /// within 0.5 h of the given ones. Not measured.
  static constexpr double flow_most = 0.24;
  /// [h] Largest outward step by which a smoothed loop grows to keep its area. Not measured.
  static constexpr double most_outward = 0.03;
  /// [rounds] If smoothed curves cross, smoothing is repeated with half the reach; after this number of rounds no curve
  /// is smoothed. Not measured.
  static constexpr int flow_rounds = 3;
  /// [passes] Largest number of passes for narrow parts after smoothing. Not measured.
  static constexpr int late_passes = 2;
  /// [h] Neighbouring corners that are nearer to each other than this become one corner. Not measured.
  static constexpr double close_corners = 0.1;
  /// [1] Smallest 1 - cosine of the turn of a corner that is joined with another one: 30 degrees. Not measured.
  static constexpr double corner_turn = 0.13;
};

} // namespace trime::generalise
