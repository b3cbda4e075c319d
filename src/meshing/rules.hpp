// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers that concern the whole run.
#pragma once

#include "trime/core/types.hpp"

#include <cstddef>

namespace trime::meshing {

/// The numbers of a run.
struct MeshingRules {
  /// [h] Largest circumradius in the first search for triangles. Circumradii in a relaxed mesh reach 0.6 h, and at the
  /// start of a stage largest_circumradius.
  static constexpr double cap = 2.5;
  /// [h] Largest circumradius at the start of a stage, except in voids. The number was observed, not proven.
  static constexpr double largest_circumradius = 1.5;
  /// [points] With fewer points than this, the first search covers the whole container: it costs little, and h may be
  /// as large as the container.
  static constexpr GlobalId few_points = 2000;
  /// [1] How often the largest circumradius of a search may be doubled: up to 2500 h. No start leaves a larger void.
  static constexpr int cap_doublings = 10;
  /// [points] If a smaller share of the stars than this is uncertain, the Delaunay lemma is not used, because it would
  /// examine all stars. After the clean-up a few per cent are uncertain. Not measured.
  static constexpr double few_stars = 0.1;
  /// [FeatureOptions::tolerance] Largest distance between the curve and a boundary edge that the clean-up makes. The
  /// distance may be larger than elsewhere, because the clean-up changes only the worst triangles. Not measured.
  static constexpr double cleanup_tolerance = 3;
  /// [meshes] How often a mesh is made, each time with larger sizes around edges that are too short. Not
  /// measured.
  static constexpr int most_trials = 8;
  /// [points asked for] If the mesh has a smaller share of the points that were asked for, the program warns.
  static constexpr double shortage_warning = 0.9;
  /// [points asked for] If the mesh has a smaller share of the points that were asked for, the result gives the reason.
  /// Not measured.
  static constexpr double shortage_note = 0.99;
  /// [points] If fewer points than this are missing, nothing is reported. Three points are one triangle. Not measured.
  static constexpr GlobalId shortage_slack = 3;
  /// [places] Approximate number of places at which the sizes of all ranks are compared before the run. Not measured.
  static constexpr std::size_t compared_sizes = 1000;
};

/// The numbers for estimating the remaining time, which is shown on a terminal; no mesh depends on them.
struct ForecastRules {
  /// [sweeps] Expected number of sweeps of a stage, used until its gains allow a better estimate. Not measured.
  static constexpr int usual_sweeps = 21;
  /// [sweeps of the final mesh] Time for clean-up, proof and output, divided by the time of one sweep. Measured: 20 to
  /// 30 on squares with 1e6 to 1e8 points.
  static constexpr int after_sweeps = 25;
};

} // namespace trime::meshing
