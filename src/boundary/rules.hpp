// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module boundary: how the boundary is laid out, and how the size is lowered for it.
#pragma once

#include "core/angle.hpp"
#include "trime/core/types.hpp"

#include <cstddef>

namespace trime::boundary {

/// The numbers of layout, features and size limits.
struct BoundaryRules {
  /// [degrees] A junction that turns by more is a corner regardless of the options, because no chord can replace it.
  static constexpr double always_a_corner = 120;
  /// [degrees] A corner that turns by more is sharp: its arms meet at less than 60 degrees and get shells.
  static constexpr double sharp_turn = 120;
  /// [radians] Largest turn of a curve that a chord may replace: 60 degrees, and an allowance for rounding.
  static constexpr double largest_turn = pi / 3 + 1e-6;
  /// [h] A corner with arms of this length on both sides is always kept.
  static constexpr double long_arm = 2;
  /// [radians] A curve that turns by more between two long arms, on a short way, is the end of a slit.
  static constexpr double turned_back = 2 * pi / 3;
  /// [lattice steps] Least h, and least length of a part that is divided. Snapping to the lattice then turns a chord by
  /// less than 0.001.
  static constexpr double shortest_in_steps = 0x1p11;
  /// [radians] An arc that turns by less stays in the disc of its chord, so its points need no test. With exact ends
  /// this would hold up to pi. Not measured.
  static constexpr double gentle_turn = pi / 4;
  /// [lattice steps] Least length of an arc whose points need no test. Fixed points may have moved its ends by
  /// on_boundary, which is a thousandth of this. Not measured.
  static constexpr double gentle_in_steps = 0x1p22;
  /// [sites] Work of a place on a stretch whose sites are chosen, in sites of a plain stretch, because chords to about
  /// ten other places are examined. It is used to share the layout among ranks. Not measured.
  static constexpr std::int64_t work_of_place = 8;
  /// [extent of the shape] A vertex within this distance of a given curve lies on it; the lattice rounds by less. Not
  /// measured.
  static constexpr double on_curve = 1e-10;
  /// [h] Distance between the places at which the deviation of a simplified curve is measured. Not measured.
  static constexpr double deviation_step = 0.25;
  /// [places] Largest number of such places on a piece; the pieces that deviate most are short. Not measured.
  static constexpr int deviation_places = 16;
  /// [1] The report mentions it if the boundary was simplified for an h that is larger than h of the mesh by this
  /// factor. Not measured.
  static constexpr double told_coarseness = 1.1;
  /// [1] The program warns if a larger share of the area of the shape is lost or added. Not measured.
  static constexpr double warned_loss = 0.001;
  /// [1] The program warns if the area within a loop changes by a larger share of itself. Not measured.
  static constexpr double warned_area = 0.02;
  /// [width of the loop: twice its area over its length] It warns if mesh and shape are farther apart. Not measured.
  static constexpr double warned_deviation = 0.1;
  /// [diagonal of the box around the loop] It warns if a vertex of the loop is farther from the mesh: a thin tip was
  /// cut off, which has next to no area. Not measured.
  static constexpr double warned_reach = 0.05;
  /// [h] Distance along the curve between two samples of the size, which is interpolated between them. A size with
  /// gradient 0.1 changes by 5 % in between.
  static constexpr double sample_step = 0.5;
  /// [samples] If a boundary needs more samples, the size is far too small, which is an error.
  static constexpr std::size_t most_samples = std::size_t{1} << 27;
  /// [h] Distance between the places among which a path chooses sites.
  static constexpr double place_spacing = 0.25;
  /// [tolerance] A place nearer to the line through its neighbours is left out before the path is searched, because it
  /// cannot matter.
  static constexpr double place_thinning = 0.1;
  /// [h] Longest chord of a path, unless its ends are neighbours.
  static constexpr double longest_chord = 1.6;
  /// [1] Weight of the square of log(chord / h) in the cost of a path.
  static constexpr double length_weight = 1;
  /// [1] Weight of the square of the logarithm of the ratio of two neighbouring chords.
  static constexpr double ratio_weight = 0.3;
  /// [1] Weight of the square of the deviation from the curve over h.
  static constexpr double deviation_weight = 0.8;
  /// [1] Gradient of the size around a place where it is lowered. Triangles can follow about 0.5.
  static constexpr double gradation = 0.2;
  /// [rounds] How often the boundary is laid out again with the limits that the last layout asks for.
  static constexpr int lowering_rounds = 2;
  /// [h] A shorter chord needs a smaller size, because a corner or a nearby part of the boundary has made it short.
  static constexpr double short_chord = 0.65;
  /// [chord lengths] Size at a short chord, whose neighbours may be longer.
  static constexpr double short_factor = 1.2;
  /// [h] A limit above this share of h is left out, because it would have almost no effect.
  static constexpr double least_lowering = 0.95;
  /// [h] An island or lake with a smaller perimeter is dropped, because no triangle of size h fits around or into it.
  static constexpr double least_perimeter = 3;
  /// [side of the container] A fixed point within this distance of a curve lies on it, because coordinates in files are
  /// rounded.
  static constexpr double on_boundary = 1e-10;
  /// [h] Least distance of a free site from a fixed point at the start.
  static constexpr double fixed_clearance = 0.6;
};

} // namespace trime::boundary
