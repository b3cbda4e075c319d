// SPDX-License-Identifier: BSD-3-Clause
// First layout of the boundary sites of one loop: corners, shells at sharp corners, quantiles of the integral of ds/h.
#pragma once

#include "loop_metric.hpp"

#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <vector>

namespace trime::meshing {

enum class SiteKind : std::uint8_t { plain, corner, sharp_corner };

/// A site of one loop by its place along it.
struct LoopSite {
  double t;                ///< coordinate of LoopMetric, in [0, total)
  geometry::Vec2 position; ///< on the unrolled loop
  SiteKind kind;
};

/// @brief Sites in ascending t, at least 3.
/// @throws GeometryError if the size is too small for the lattice
std::vector<LoopSite> lay_out_loop(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle);

} // namespace trime::meshing
