// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers that belong to the whole run.
#pragma once

#include "trime/core/types.hpp"

#include <cstddef>

namespace trime::meshing {

/// The numbers of the run.
struct MeshingRules {
  /// [h] Largest circumradius in the first search for triangles. A relaxed mesh has circumradii up to 0.6 h, a start up
  /// to largest_circumradius.
  static constexpr double cap = 2.5;
  /// [h] Largest circumradius of a start, except in voids. It was observed, not proven.
  static constexpr double largest_circumradius = 1.5;
  /// [points] With fewer points the search covers the whole container: it costs little, and h may be as large as the
  /// container.
  static constexpr GlobalId few_points = 2000;
  /// [1] Largest number of doublings of the cap, up to 2500 h. No start leaves such a void.
  static constexpr int cap_doublings = 10;
  /// [points] If a smaller share of the stars is uncertain, the lemma is not used, because it examines all stars. The
  /// clean-up leaves a few per cent. Not measured.
  static constexpr double few_stars = 0.1;
  /// [FeatureOptions::tolerance] Largest distance of chords of the clean-up from the curve. The clean-up changes only
  /// the worst triangles. Not measured.
  static constexpr double cleanup_tolerance = 3;
  /// [points asked for] If the mesh has fewer, the program warns.
  static constexpr double shortage_warning = 0.9;
  /// [points asked for] If the mesh has fewer, the result gives the reason. Not measured.
  static constexpr double shortage_note = 0.99;
  /// [points] If fewer points are missing, nothing is reported. Three points are one triangle. Not measured.
  static constexpr GlobalId shortage_slack = 3;
  /// [places] About the number of places where the sizes of all ranks are compared before the run. Not measured.
  static constexpr std::size_t compared_sizes = 1000;
};

/// The numbers of the forecast on a terminal; no mesh depends on them.
struct ForecastRules {
  /// [sweeps] Expected length of a stage, until its gains allow a better estimate. Not measured.
  static constexpr int usual_sweeps = 21;
  /// [sweeps of the final mesh] Time for clean-up, proof and output, in times of one sweep. Measured: 20 to 30 on
  /// squares of 1e6 to 1e8 points.
  static constexpr int after_sweeps = 25;
};

} // namespace trime::meshing
