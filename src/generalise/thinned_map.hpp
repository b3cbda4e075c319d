// SPDX-License-Identifier: BSD-3-Clause
// Thins curves as far as they do not cross, and gives the map that proves it.
#pragma once

#include "generalise/curve_map.hpp"
#include "generalise/ragged_curves.hpp"

#include <memory>
#include <optional>
#include <span>

namespace trime::generalise {

/// A boundary without its ragged runs, and its map. The map refers to the boundary, and is destroyed before it.
struct ThinnedMap {
  std::unique_ptr<const geometry::Boundary> thinned; ///< null if nothing was ragged
  std::optional<CurveMap> map;
};

/// A way to thin curves, see without_ragged_runs.
struct ThinningTrial {
  double share; ///< [h] see without_ragged_runs
  Thinning thinning;
};

/// @brief Returns the curves of the first trial in which they do not cross, or nothing. O(n log n) for each trial.
/// @param inside lattice points that must stay inside, see CurveMap
/// @throws GeometryError if a size is not positive and finite
ThinnedMap thinned_map(const geometry::Boundary& boundary, const sizing::SizeField& size,
                       const geometry::Lattice& lattice, std::span<const geometry::Vec2> inside,
                       std::span<const ThinningTrial> trials);

} // namespace trime::generalise
