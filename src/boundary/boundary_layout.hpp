// SPDX-License-Identifier: BSD-3-Clause
// First layout of the boundary sites of one loop: corners, shells at sharp corners, quantiles of the integral of ds/h.
#pragma once

#include "boundary/loop_metric.hpp"
#include "boundary/site_places.hpp"

#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <vector>

namespace trime::boundary {

enum class SiteKind : std::uint8_t { plain, corner, sharp_corner };

/// A site of one loop by its place along it.
struct LoopSite {
  double t;                ///< coordinate of LoopMetric, in [0, total)
  geometry::Vec2 position; ///< on the unrolled loop
  SiteKind kind;
};

/// What a junction is as a site: of pieces, at the start of one of them.
SiteKind kind_of_junction(const geometry::Loop& loop, std::size_t piece, double corner_angle);

/// @brief Sites in ascending t, at least 3.
/// @throws GeometryError if the size is too small for the lattice
std::vector<LoopSite> lay_out_loop(const LoopMetric& metric, const geometry::Lattice& lattice, double corner_angle,
                                   const FeatureTolerance& tolerance);

} // namespace trime::boundary
