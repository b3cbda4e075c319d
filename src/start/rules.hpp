// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module start: how many stages, and what each of them aims at.
#pragma once

namespace trime::start {

/// The numbers of the stages of a run.
struct StartRules {
  /// [points asked for] Largest share that the start holds back for sites that the clean-up inserts. The clean-up may
  /// change the number by 0.005 of it (CleanupRules::largest_loss).
  static constexpr double reserved_share = 0.004;
  /// [points] Number that the start holds back for each piece of the boundary: the clean-up inserts at ragged
  /// boundaries.
  static constexpr double reserved_per_piece = 0.1;
  /// [points asked for] Largest share that it holds back in addition if there are several components. Not measured.
  static constexpr double reserved_for_components = 0.01;
  /// [points] Number for each further component: a small one may lack its only inner site. Not measured.
  static constexpr double reserved_per_component = 0.5;
  /// [1] One insertion multiplies the number of points by this, as TriMe++ does.
  static constexpr double growth = 1.6;
  /// [stages] A bound on the run where a mesh has too few triangles for the points to be inserted.
  static constexpr int most_insertions = 64;
  /// [points] From here on the start has a quarter of the points and all edges are divided once. A coarser start would
  /// starve narrow parts. One division at 1e4 points: mean alpha 1.017, in place of 1.025 without.
  static constexpr double one_division = 3000;
  /// [points] From here on the start has 1/16 of the points. Measured with 2e4: two divisions 1.0153, one 1.0165.
  static constexpr double two_divisions = 20000;
  /// [points] From here on the start has 1/64 of the points: with less than about 5e4 three divisions starve narrow
  /// parts.
  static constexpr double three_divisions = 400000;
  /// [1] The integral that fits the size of an insertion run uses cells that are wider by this factor, at most.
  static constexpr double coarsest_integral = 8;
  /// [1] The density of a start that is relaxed and divided uses cells that are wider by this factor: the mesh was no
  /// worse than with 1.
  static constexpr double coarse_start = 2;
  /// [points asked for] If at most this share is missing after a division, no sites are inserted: new sites disturb the
  /// order.
  static constexpr double small_shortage = 0.01;
  /// [1] Where fixed points take sites away, more are placed, up to this number times those wanted: a bound for shapes
  /// that are full of fixed points.
  static constexpr double most_replaced = 4;
  /// [h] Sites that are too many are taken out where they lie nearest to the boundary; farther than this a hash
  /// decides, so that none need be searched.
  static constexpr double farthest_from_boundary = 4;
};

} // namespace trime::start
