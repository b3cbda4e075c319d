// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the run that no stage of it owns.
#pragma once

#include "trime/core/types.hpp"

#include <cstddef>

namespace trime::meshing {

/// The numbers of the run.
struct MeshingRules {
  /// [h] Larger circumradii are not searched first: a relaxed mesh has 0.6, a start up to largest_circumradius.
  static constexpr double cap = 2.5;
  /// [h] No circumradius of a start is larger, except in voids. Observed, not proven.
  static constexpr double largest_circumradius = 1.5;
  /// [points] With fewer the whole container is searched: it costs little, and h may be as large.
  static constexpr GlobalId few_points = 2000;
  /// [1] To 2500 h: a void that no start can leave.
  static constexpr int cap_doublings = 10;
  /// [points] Share of uncertain stars up to which the lemma is not used, since it examines all stars: the clean-up
  /// leaves a few per cent. Not measured.
  static constexpr double few_stars = 0.1;
  /// [FeatureOptions::tolerance] So far chords of the clean-up may pass from the curve: it looks at the worst triangles
  /// only. Not measured.
  static constexpr double cleanup_tolerance = 3;
  /// [points asked for] With fewer in the mesh a warning is given.
  static constexpr double shortage_warning = 0.9;
  /// [points asked for] With fewer the result says why. Not measured.
  static constexpr double shortage_note = 0.99;
  /// [points] Fewer missing ones are never mentioned: a triangle. Not measured.
  static constexpr GlobalId shortage_slack = 3;
  /// [places] Number of places, about, where the sizes of all ranks are compared before the run. Not measured.
  static constexpr std::size_t compared_sizes = 1000;
};

/// The numbers of the forecast on a terminal; no mesh depends on them.
struct ForecastRules {
  /// [sweeps] Expected length of a stage, until its gains allow a better estimate. Not measured.
  static constexpr int usual_sweeps = 21;
  /// [sweeps of the final mesh] What follows the sweeps takes as long: clean-up, proof, output. Measured: 20 to 30 on
  /// squares of 1e6 to 1e8 points.
  static constexpr int after_sweeps = 25;
};

} // namespace trime::meshing
