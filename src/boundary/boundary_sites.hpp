// SPDX-License-Identifier: BSD-3-Clause
// Lays out the sites on the boundary of a shape, before any site inside. Corners are kept; arcs are divided by the size
// field, sharp corners by shells. Then chords are halved until the diametral disc of every chord holds no other site,
// and the polygon of chords has the topology of the curve.
#pragma once

#include "boundary/feature_rule.hpp"
#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <limits>
#include <span>

namespace trime::boundary {

/// @brief Lays out the sites of `boundary` for the absolute element size `size`.
///
/// A junction of two pieces that turns by more than `corner_angle` degrees is a corner; `rule` says which corners and
/// loops are left out. Between corners that are surely kept, or along a whole loop without corners, the sites lie at
/// equal quantiles of the integral of ds/h. Where corners between them may be left out, a shortest path chooses the
/// corners that stay, and places between them (site_path.hpp). Where two arms meet at less than 60 degrees, both get
/// sites at equal distances from the corner until their gap reaches h (shells; Ruppert 1995). Then a chord is divided
/// while another site lies in its diametral disc, or the curve between its ends leaves that disc, or the curve turns by
/// more than 60 degrees and strays from the chord by more than the tolerance. It is divided in the middle, or, next to
/// a sharp corner, on a power-of-two radius (concentric shells), so that the process ends for any angle. The discs are
/// kept free of the points of `inside`, too. Sites always lie on the curve. Deterministic; O(B log^2 B) for B sites and
/// pieces.
/// @param affordable halving ends at this number of sites: the caller only wants to know that there are too many
/// @throws GeometryError with the place, if two parts of the boundary are too close to separate, or if the size asks
/// for more than 2^27 sites
polygon::BoundarySites make_boundary_sites(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                           const geometry::Lattice& lattice, double corner_angle,
                                           std::span<const geometry::Vec2> inside = {}, const FeatureRule& rule = {},
                                           std::size_t affordable = std::numeric_limits<std::size_t>::max());

} // namespace trime::boundary
