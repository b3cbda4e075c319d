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
  /// [h] A corner with arms of this length on both sides is always kept. Not measured.
  static constexpr double long_arm = 2;
  /// [radians] A curve that turns by more on a short way between two long arms is the end of a slit. Not measured.
  static constexpr double turned_back = 2 * pi / 3;
  /// [extent of a loop] No corner is left out farther from its chord: small loops keep their shape. Not measured.
  static constexpr double most_of_extent = 0.1;
  /// [lattice steps] The least h, and the shortest part that is divided: exact tests need some room. Not measured.
  static constexpr double shortest_in_steps = 0x1p11;
  /// [radians] A junction that turns by less is one of two pieces of one circle. Not measured.
  static constexpr double smooth_junction = pi / 360;
  /// [tolerance] A chord that leaves corners farther off is divided. The layout keeps within 1.1. Not measured.
  static constexpr double most_deviation = 1.25;
  /// [radians] A junction that turns by more becomes a site when its segment is divided. Not measured.
  static constexpr double junction_turn = pi / 4;
  /// [rounds] Later rounds of halving look only at segments near the new sites. Not measured.
  static constexpr int full_rounds = 20;
  /// [sites] Halving may always go so far; see halving_growth. Not measured.
  static constexpr std::size_t most_sites = 4000000;
  /// [1] Halving may make so many times the sites of the layout; beyond that the boundary is at fault. Not measured.
  static constexpr std::size_t halving_growth = 16;
  /// [h] Way between two samples of the size: h changes little on it, by linear interpolation between. Not measured.
  static constexpr double sample_step = 0.5;
  /// [samples] Of the size along a boundary: more is a size that is far too small.
  static constexpr std::size_t most_samples = std::size_t{1} << 27;
  /// [h] Way between places of which a path chooses sites. Not measured.
  static constexpr double place_spacing = 0.25;
  /// [tolerance] Places nearer to the line through the others are left out before the path. Not measured.
  static constexpr double place_thinning = 0.1;
  /// [levels] Of that thinning: below, all places stay, so that it ends.
  static constexpr int deepest_division = 64;
  /// [h] A path takes no longer chord, unless its ends are neighbours. Not measured.
  static constexpr double longest_chord = 1.6;
  /// [h] A path takes no shorter chord, unless its ends are neighbours: the spacing of places. Not measured.
  static constexpr double shortest_chord = 0.25;
  /// [places] Behind the start of a chord at which its end is looked for: bounds the time. Not measured.
  static constexpr std::size_t farthest_place = 64;
  /// [h] Way along the curve that one chord may stand for. Not measured.
  static constexpr double farthest_way = 6;
  /// [h] From the start of a chord; behind a place farther out no end is looked for. Not measured.
  static constexpr double farthest_reach = 2.5;
  /// [1] Cost of a chord of another length than h, times the square of the logarithm of the ratio. Not measured.
  static constexpr double length_weight = 1;
  /// [1] The same for neighbouring chords of unlike lengths. Not measured.
  static constexpr double ratio_weight = 0.3;
  /// [1] Cost of a chord off the curve, times the square of the deviation over h. Not measured.
  static constexpr double deviation_weight = 0.8;
  /// [1] Cost of a site in the disc of a neighbouring chord: that chord would be halved. Not measured.
  static constexpr double encroachment = 1;
  /// [1] Cost of a closed path that goes along one chord and back: more than all others.
  static constexpr double back_and_forth = 1e3;
  /// [1] Growth of the size around a place where it is lowered, over the way from it. Not measured.
  static constexpr double gradation = 0.2;
  /// [rounds] So often limits of the size are looked for in one layout after the other. Not measured.
  static constexpr int lowering_rounds = 2;
  /// [h] A shorter chord asks for a smaller size: a corner, or what is near, has made it so. Not measured.
  static constexpr double short_chord = 0.65;
  /// [chord lengths] The size at a short chord: its neighbours may be longer. Not measured.
  static constexpr double short_factor = 1.2;
  /// [h] Sites nearer to each other across the inside ask for a smaller size. Not measured.
  static constexpr double narrow_gap = 0.65;
  /// [asked h] No limit is lower: it ends the lowering in wedges. Not measured.
  static constexpr double least_limit = 0.05;
  /// [h] A limit that is hardly lower than the size changes nothing. Not measured.
  static constexpr double least_lowering = 0.95;
  /// [chord lengths] Of the center of the circle that sees the chord at 75 degrees: 0.5 / tan(75 degrees).
  static constexpr double lens_offset = 0.134;
  /// [chord lengths] Radius of that circle: 0.5 / sin(75 degrees).
  static constexpr double lens_radius = 0.5176;
  /// [1] Size over the width of a channel: the side of an equilateral triangle over its height.
  static constexpr double width_factor = 1.15;
  /// [chords] Of both arms of a sharp corner, on which sites come near to each other at any size. Not measured.
  static constexpr int longest_arms = 24;
  /// [h] A smaller island or lake is dropped: no triangle of size h fits around or into it.
  static constexpr double least_perimeter = 3;
  /// [area of the shape] A loop that encloses more is never dropped. Not measured.
  static constexpr double largest_dropped_share = 0.01;
  /// [side of the container] A fixed point so near to a curve lies on it: coordinates in files are rounded.
  static constexpr double on_boundary = 1e-10;
  /// [h] A free site starts no nearer to a fixed one. Not measured.
  static constexpr double fixed_clearance = 0.6;
};

} // namespace trime::boundary
