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
  /// [extent of a loop] No corner is left out farther from its chord: small loops keep their shape.
  static constexpr double most_of_extent = 0.1;
  /// [lattice steps] Neither h nor a part that is divided may be shorter: snapping to the lattice then turns a chord by
  /// less than 0.001.
  static constexpr double shortest_in_steps = 0x1p11;
  /// [radians] An arc that turns by less stays in the disc of its chord: it needs no look at its points. With
  /// exact ends it would up to pi; largest_turn is above it, too. Not measured.
  static constexpr double gentle_turn = pi / 4;
  /// [lattice steps] The same arc is no shorter. Fixed points may have moved its ends by on_boundary, which is a
  /// thousandth of this. Not measured.
  static constexpr double gentle_in_steps = 0x1p22;
  /// [radians] A junction of two arcs that turns by less lies within one circle: half a degree.
  static constexpr double smooth_junction = pi / 360;
  /// [tolerance] A chord that leaves corners farther off is divided. The layout keeps within 1.1; the rest is leeway
  /// for snapping and halving.
  static constexpr double most_deviation = 1.25;
  /// [radians] A junction that turns by more becomes a site when its chord is divided.
  static constexpr double junction_turn = pi / 4;
  /// [sites] What a place costs on a stretch whose sites are chosen, in sites of a plain stretch: chords to some ten
  /// others are weighed. Shares the layout among ranks. Not measured.
  static constexpr std::int64_t work_of_place = 8;
  /// [rounds] Later rounds of halving look only at chords near the new sites.
  static constexpr int full_rounds = 20;
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
  /// [sites] Halving of chords may always make this number; beyond, halving_growth is the bound.
  static constexpr std::size_t always_halved = 4000000;
  /// [1] Halving may make this number times the sites of the layout. More means that the boundary is at fault, and an
  /// error says so.
  static constexpr std::size_t halving_growth = 16;
  /// [h] Way along the curve between two samples of the size, which is interpolated between them. A size that grows by
  /// 0.1 of the way changes by 5 % on it.
  static constexpr double sample_step = 0.5;
  /// [samples] If the size along a boundary takes more, it is far too small, and an error says so.
  static constexpr std::size_t most_samples = std::size_t{1} << 27;
  /// [h] Sites are chosen by a path among places so far apart.
  static constexpr double place_spacing = 0.25;
  /// [tolerance] A place nearer to the line through its neighbours is left out before the path: it cannot matter.
  static constexpr double place_thinning = 0.1;
  /// [levels] Bounds that thinning; deeper, all places stay.
  static constexpr int deepest_division = 64;
  /// [h] A path takes no longer chord, unless its ends are neighbours.
  static constexpr double longest_chord = 1.6;
  /// [h] A path takes no shorter chord, unless its ends are neighbours. The same as place_spacing.
  static constexpr double shortest_chord = 0.25;
  /// [places] Number of places after its start where the end of a chord is searched, which bounds the time.
  static constexpr std::size_t farthest_place = 64;
  /// [h] One chord stands for no longer way along the curve.
  static constexpr double farthest_way = 6;
  /// [h] Behind a place that is farther from the start of a chord no end of it is looked for.
  static constexpr double farthest_reach = 2.5;
  /// [1] Weight of the square of log(chord / h) in the cost of a path.
  static constexpr double length_weight = 1;
  /// [1] Weight of the square of the logarithm of the ratio of two neighbouring chords.
  static constexpr double ratio_weight = 0.3;
  /// [1] Weight of the square of the deviation from the curve over h.
  static constexpr double deviation_weight = 0.8;
  /// [1] Cost of a site in the disc of a neighbouring chord, which would be halved for it.
  static constexpr double encroachment = 1;
  /// [1] Cost of a closed path that goes along one chord and back: more than all other costs.
  static constexpr double back_and_forth = 1e3;
  /// [1] Around a place where it is lowered, the size grows by this share of the way. Triangles can follow about 0.5.
  static constexpr double gradation = 0.2;
  /// [rounds] How often the boundary is laid out again with the limits that the last layout asks for.
  static constexpr int lowering_rounds = 2;
  /// [h] A shorter chord asks for a smaller size: a corner, or something near, has made it so short.
  static constexpr double short_chord = 0.65;
  /// [chord lengths] The size at a short chord, since its neighbours may be longer.
  static constexpr double short_factor = 1.2;
  /// [h] Sites that are nearer to each other across the inside ask for a smaller size.
  static constexpr double narrow_gap = 0.65;
  /// [asked h] No limit of the size is lower, so that lowering ends in wedges.
  static constexpr double least_limit = 0.05;
  /// [h] A limit above this share of h is left out: it would change hardly anything.
  static constexpr double least_lowering = 0.95;
  /// [chord lengths] Of the center of the circle that sees the chord at 75 degrees: 0.5 / tan(75 degrees).
  static constexpr double lens_offset = 0.134;
  /// [chord lengths] Radius of that circle: 0.5 / sin(75 degrees).
  static constexpr double lens_radius = 0.5176;
  /// [1] Size over the width of a channel: the side of an equilateral triangle over its height.
  static constexpr double width_factor = 1.15;
  /// [chords] Sites on the two arms of one sharp corner are near to each other at any size, and ask for no smaller one.
  /// The corner is searched among this number of chords on both sides.
  static constexpr int longest_arms = 24;
  /// [h] A smaller island or lake is dropped: no triangle of size h fits around or into it.
  static constexpr double least_perimeter = 3;
  /// [area of the shape] A loop that encloses more is never dropped.
  static constexpr double largest_dropped_share = 0.01;
  /// [side of the container] A fixed point so near to a curve lies on it: coordinates in files are rounded.
  static constexpr double on_boundary = 1e-10;
  /// [h] No free site starts nearer to a fixed one.
  static constexpr double fixed_clearance = 0.6;
};

} // namespace trime::boundary
