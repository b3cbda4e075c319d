// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module start, which determine how many stages there are and how many points each has.
#pragma once

namespace trime::start {

/// The numbers of the stages of a run.
struct StartRules {
  /// [points asked for] Largest share of the points that the start holds back for sites that the clean-up inserts. The
  /// clean-up may change the number of points by a share of 0.005 (CleanupRules::largest_loss).
  static constexpr double reserved_share = 0.004;
  /// [points] Number of points that the start holds back for each piece of the boundary, because the clean-up inserts
  /// sites at ragged boundaries.
  static constexpr double reserved_per_piece = 0.1;
  /// [points asked for] Largest additional share of the points that the start holds back if there are several
  /// components. Not measured.
  static constexpr double reserved_for_components = 0.01;
  /// [points] Number of points that are held back for each further component, because a small component may lack its
  /// only inner site. Not measured.
  static constexpr double reserved_per_component = 0.5;
  /// [1] One insertion multiplies the number of points by this factor, as in TriMe++.
  static constexpr double growth = 1.6;
  /// [1] A mesh from an old mesh begins with the last update rule if at most this share of its sites was taken out or
  /// put in; otherwise with the first one, as a new mesh does. Not measured.
  static constexpr double small_change = 0.25;
  /// [1] If at most this share of the sites of an old mesh is taken out or put in, the tiles stay as they are, and only
  /// the stars near changes are computed again. Not measured.
  static constexpr double edited_share = 0.1;
  /// [1] The scheme coarse to fine samples the density in cells that are wider by this factor. The mesh was as good as
  /// with 1.
  static constexpr double coarse_start = 2;
};

} // namespace trime::start
