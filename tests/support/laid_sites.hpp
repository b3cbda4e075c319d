// SPDX-License-Identifier: BSD-3-Clause
// Places the sites of a boundary in one process, without communication.
#pragma once

#include "boundary/boundary_refiner.hpp"
#include "sizing/lowered_size.hpp"

#include <limits>
#include <memory>
#include <span>

namespace trime::testing {

/// Returns the same sites as boundary::make_boundary_sites, made by one refiner without communication. By default every
/// corner and loop is kept.
/// @throws GeometryError under the same conditions
inline polygon::BoundarySites make_boundary_sites(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                                  const geometry::Lattice& lattice, double corner_angle,
                                                  std::span<const geometry::Vec2> inside = {},
                                                  const boundary::FeatureRule& rule = {},
                                                  std::size_t affordable = std::numeric_limits<std::size_t>::max(),
                                                  const geometry::InnerCurves& inner = {}) {
  const auto curves = std::make_shared<const boundary::LaidCurves>(boundary, inner);
  boundary::BoundaryRefiner refiner(curves, {size, size}, lattice, {corner_angle, inside, inside, rule, affordable});
  refiner.run(refiner.begin(refiner.lay_out({}), {}));
  return refiner.result();
}

} // namespace trime::testing
