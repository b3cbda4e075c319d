// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module delaunay. None of them can change a star that a mesh uses, only the time that it
// takes.
#pragma once

#include <cstddef>

namespace trime::delaunay {

/// The numbers of StarBuilder.
struct StarRules {
  /// [cap] A star from scratch first takes all sites in a window of this half-width.
  static constexpr double first_window = 0.6;
  /// [cap] Sites nearer than this are inserted before the others of that window: about the first ring.
  static constexpr double nearer_sites = 0.5;
  /// [1] A window grows at most so much at a time, since each can shrink the radius that must be searched.
  static constexpr double window_growth = 1.6;
  /// [cap^2] A squared circumradius below this counts without its canonical value.
  static constexpr double surely_below_cap = 0.99;
  /// [periods] The largest cap, so that edges are shorter than half a period: a quarter, less a little.
  static constexpr double cap_in_period = 0.2499;
};

/// The numbers of TileWrapper: how far it looks for candidates, and where groups of sites pay.
struct WrapRules {
  /// [spacings] How far beyond the box of a group candidates are looked for first: enough in a relaxed mesh. Not
  /// measured.
  static constexpr double reach_relaxed = 1.5;
  /// [spacings] The next longer reach: enough for most sites of a random start. Not measured.
  static constexpr double reach_random = 2.7;
  /// [spacings] The longest reach; what needs more is left to the search of single stars. Not measured.
  static constexpr double reach_longest = 4;
  /// [1] Share of stars that needed a longer reach above which that one is tried first.
  static constexpr double many_larger = 0.2;
  /// [1] Share of such stars below which a shorter reach is tried first again.
  static constexpr double few_larger = 1e-4;
  /// [stars] Number that is counted before the reach is chosen again.
  static constexpr double stars_to_learn = 500;
  /// [1] Cost of a star that is searched alone from scratch; in a relaxed mesh, with its last ring, one costs 1.
  static constexpr double cost_of_search = 5;
  /// [1] Cost of a group, in units of a star alone in a relaxed mesh: so much for any.
  static constexpr double cost_of_group = 3;
  /// [1] And so much more for each lane of the processor.
  static constexpr double cost_of_lane = 0.77;
  /// [sites] Smallest number in a group.
  static constexpr std::size_t fewest_in_group = 3;
  /// [groups] Where ties are everywhere, largest number of groups that are skipped before one is tried again.
  static constexpr int longest_pause = 64;
};

} // namespace trime::delaunay
