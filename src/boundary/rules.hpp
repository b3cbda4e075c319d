// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module boundary: how sites are placed on the boundary, and where the size is lowered for it.
#pragma once

#include "core/angle.hpp"
#include "trime/core/types.hpp"

#include <cstddef>

namespace trime::boundary {

/// The numbers for placing sites, for features, and for places where the size is lowered.
struct BoundaryRules {
  /// [degrees] A junction that turns by more than this is a corner regardless of the options, because no straight edge
  /// can replace it.
  static constexpr double always_a_corner = 120;
  /// [degrees] A corner that turns by more than this is sharp: its sides meet at less than 60 degrees and get shells.
  static constexpr double sharp_turn = 120;
  /// [radians] Largest turn of a curve that one boundary edge may replace: 60 degrees, and an allowance for rounding.
  static constexpr double largest_turn = pi / 3 + 1e-6;
  /// [shells] Largest number of shells around a node of curves: those of a wedge of one degree. Not measured.
  static constexpr double most_shells = 58;
  /// [h] A corner whose two sides are at least this long is always kept.
  static constexpr double long_arm = 2;
  /// [radians] If a curve between two long sides turns by more than this over a short length, it is the end of a slit.
  static constexpr double turned_back = 2 * pi / 3;
  /// [lattice steps] Smallest allowed h, and smallest length of a part that is divided. Above it, rounding to the
  /// coordinate lattice turns an edge by less than 0.001.
  static constexpr double shortest_in_steps = 0x1p11;
  /// [radians] An arc that turns by less than this stays in the diametral circle of its chord, so its points need no
  /// test. With exact ends, arcs of up to pi would stay. Not measured.
  static constexpr double gentle_turn = pi / 4;
  /// [lattice steps] Shortest arc whose points need no test. Fixed points may have moved its ends by on_boundary, which
  /// is a thousandth of this length. Not measured.
  static constexpr double gentle_in_steps = 0x1p22;
  /// [sites] On a stretch whose sites are chosen by a path, one place takes as much work as this number of plain sites,
  /// because chords to about ten other places are examined. The number is used to share the work among ranks. Not
  /// measured.
  static constexpr std::int64_t work_of_place = 8;
  /// [extent of the shape] A vertex within this distance of a given curve lies on the curve; rounding to the coordinate
  /// lattice moves it less. Not measured.
  static constexpr double on_curve = 1e-10;
  /// [h] The deviation of a simplified curve is measured at places that are this far apart. Not measured.
  static constexpr double deviation_step = 0.25;
  /// [places] Largest number of these places on a piece. The number is small because the pieces that deviate most are
  /// short. Not measured.
  static constexpr int deviation_places = 16;
  /// [1] The report mentions for which h the boundary was simplified if this h exceeds h of the mesh by this factor.
  /// Not measured.
  static constexpr double told_coarseness = 1.1;
  /// [1] The program warns if a larger share of the shape's area is lost or added. Not measured.
  static constexpr double warned_loss = 0.001;
  /// [1] The program warns if the area within a loop changes by a larger share of itself. Not measured.
  static constexpr double warned_area = 0.02;
  /// [width of the loop: twice its area over its length] It warns if mesh and shape are farther apart. Not measured.
  static constexpr double warned_deviation = 0.1;
  /// [diagonal of the box around the loop] It warns if a vertex of the loop is farther from the mesh: a thin tip was
  /// cut off, which has next to no area. Not measured.
  static constexpr double warned_reach = 0.05;
  /// [h] Distance along the curve between two samples of the size, which is interpolated between them. A size with
  /// gradient 0.1 changes by 5 % over this distance.
  static constexpr double sample_step = 0.5;
  /// [samples] If a boundary needs more samples than this, the size is far too small, and an error is thrown.
  static constexpr std::size_t most_samples = std::size_t{1} << 27;
  /// [h] Distance between the places from which a shortest path chooses sites.
  static constexpr double place_spacing = 0.25;
  /// [tolerance] A place that is nearer than this to the line through its neighbours is left out before the shortest
  /// path is searched, because it hardly changes the curve.
  static constexpr double place_thinning = 0.1;
  /// [h] Longest chord of a path, unless its ends are neighbouring places.
  static constexpr double longest_chord = 1.6;
  /// [1] Weight of the square of log(chord / h) in the cost of a path.
  static constexpr double length_weight = 1;
  /// [1] Weight, in the cost of a path, of the squared logarithm of the ratio of two neighbouring chords.
  static constexpr double ratio_weight = 0.3;
  /// [1] Weight, in the cost of a path, of the squared deviation from the curve over h.
  static constexpr double deviation_weight = 0.8;
  /// [1] Gradient of the size around a place where the size is lowered. Triangles can follow a gradient of about 0.5.
  static constexpr double gradation = 0.2;
  /// [rounds] How often the sites of the boundary are placed again with the lower sizes that the last placement asks
  /// for.
  static constexpr int lowering_rounds = 2;
  /// [h] A chord shorter than this lowers the size there, because a corner or a nearby part of the boundary has made it
  /// short.
  static constexpr double short_chord = 0.65;
  /// [chord lengths] The lowered size at a short chord; it exceeds the chord because neighbouring chords may be longer.
  static constexpr double short_factor = 1.2;
  /// [h] A lower size above this share of h is ignored, because it would have almost no effect.
  static constexpr double least_lowering = 0.95;
  /// [h] An island or lake with a smaller perimeter is dropped, because no triangle of size h fits around or into it.
  static constexpr double least_perimeter = 3;
  /// [side of the container] A fixed point within this distance of a curve lies on the curve, because coordinates in
  /// files are rounded.
  static constexpr double on_boundary = 1e-10;
  /// [extent of the shape] Distance between the points of a curve inside that hold the boundary while it is simplified,
  /// in addition to the vertices of the curve. Not measured.
  static constexpr double held_spacing = 1.0 / 512;
  /// [h] Free sites nearer than this to a fixed point are removed at the start.
  static constexpr double fixed_clearance = 0.6;
  /// [h] Sites of a simplified interface move by at most this to keep the areas of the regions. Not measured.
  static constexpr double most_area_shift = 0.1;
};

} // namespace trime::boundary
