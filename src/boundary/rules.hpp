// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which the boundary is laid out, and the size lowered for it.
#pragma once

#include "core/angle.hpp"
#include "trime/core/types.hpp"

#include <cstddef>

namespace trime::boundary {

/// The numbers of the boundary module.
struct BoundaryRules {
  /// [degrees] A junction that turns by more is a corner whatever the options say: no chord can stand for it.
  static constexpr double always_a_corner = 120;
  /// [degrees] A corner that turns by more is sharp: its arms meet at less than 60 degrees and get shells.
  static constexpr double sharp_turn = 120;
  /// [radians] A chord stands for a curve that turns by 60 degrees at most; the rest is for rounding.
  static constexpr double largest_turn = pi / 3 + 1e-6;
  /// [h] A corner with arms of this length on both sides is always kept.
  static constexpr double long_arm = 2;
  /// [radians] A curve that turns by more on a short way between two long arms is the end of a slit.
  static constexpr double turned_back = 2 * pi / 3;
  /// [lattice steps] Neither h nor a part that is divided may be shorter: snapping to the lattice then turns a chord by
  /// less than 0.001.
  static constexpr double shortest_in_steps = 0x1p11;
  /// [radians] An arc that turns by less stays in the disc of its chord: it needs no look at its points. With
  /// exact ends it would up to pi; largest_turn is above it, too. Not measured.
  static constexpr double gentle_turn = pi / 4;
  /// [lattice steps] The same arc is no shorter. Fixed points may have moved its ends by on_boundary, which is a
  /// thousandth of this. Not measured.
  static constexpr double gentle_in_steps = 0x1p22;
  /// [sites] What a place costs on a stretch whose sites are chosen, in sites of a plain stretch: chords to some ten
  /// others are weighed. Shares the layout among ranks. Not measured.
  static constexpr std::int64_t work_of_place = 8;
  /// [extent of the shape] A vertex so near to a given curve lies on it: the lattice rounds by less. Not
  /// measured.
  static constexpr double on_curve = 1e-10;
  /// [h] Distance of the places at which the deviation of a simplified curve is measured. Not measured.
  static constexpr double deviation_step = 0.25;
  /// [places] Of such a piece, at most; the worst ones are short. Not measured.
  static constexpr int deviation_places = 16;
  /// [1] The report says so if the boundary was simplified for an h that is larger than that of the mesh by this
  /// factor. Not measured.
  static constexpr double told_coarseness = 1.1;
  /// [1] A larger share of the shape's area that is lost or added is a warning. Not measured.
  static constexpr double warned_loss = 0.001;
  /// [h] Way along the curve between two samples of the size, which is interpolated between them. A size that grows by
  /// 0.1 of the way changes by 5 % on it.
  static constexpr double sample_step = 0.5;
  /// [samples] If the size along a boundary takes more, it is far too small, and an error says so.
  static constexpr std::size_t most_samples = std::size_t{1} << 27;
  /// [h] Sites are chosen by a path among places so far apart.
  static constexpr double place_spacing = 0.25;
  /// [tolerance] A place nearer to the line through its neighbours is left out before the path: it cannot matter.
  static constexpr double place_thinning = 0.1;
  /// [h] A path takes no longer chord, unless its ends are neighbours.
  static constexpr double longest_chord = 1.6;
  /// [1] Weight of the square of log(chord / h) in the cost of a path.
  static constexpr double length_weight = 1;
  /// [1] Weight of the square of the logarithm of the ratio of two neighbouring chords.
  static constexpr double ratio_weight = 0.3;
  /// [1] Weight of the square of the deviation from the curve over h.
  static constexpr double deviation_weight = 0.8;
  /// [1] Around a place where it is lowered, the size grows by this share of the way. Triangles can follow about 0.5.
  static constexpr double gradation = 0.2;
  /// [rounds] How often the boundary is laid out again with the limits that the last layout asks for.
  static constexpr int lowering_rounds = 2;
  /// [h] A shorter chord asks for a smaller size: a corner, or something near, has made it so short.
  static constexpr double short_chord = 0.65;
  /// [chord lengths] The size at a short chord, since its neighbours may be longer.
  static constexpr double short_factor = 1.2;
  /// [h] A limit above this share of h is left out: it would change hardly anything.
  static constexpr double least_lowering = 0.95;
  /// [h] A smaller island or lake is dropped: no triangle of size h fits around or into it.
  static constexpr double least_perimeter = 3;
  /// [side of the container] A fixed point so near to a curve lies on it: coordinates in files are rounded.
  static constexpr double on_boundary = 1e-10;
  /// [h] No free site starts nearer to a fixed one.
  static constexpr double fixed_clearance = 0.6;
};

} // namespace trime::boundary
