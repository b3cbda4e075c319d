// SPDX-License-Identifier: BSD-3-Clause
// The ways in which a run may place its first points.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <span>
#include <string>

namespace trime::start {

/// @brief How a run places its first points. `lattice`: a hexagonal lattice, for uniform sizes. `hilbert`: along the
/// Hilbert curve, at equal shares of the wanted density. `coarse_to_fine`: a mesh of few points is relaxed and its
/// edges are divided, repeatedly. `automatic`: chosen by the size field.
enum class Start { automatic, lattice, hilbert, coarse_to_fine };

/// The points of an old mesh, from which a new mesh starts. The new mesh depends on their places, and not on their
/// order or on the rank that holds them.
struct OldPoints {
  std::span<const geometry::Vec2> points; ///< any share of the points on each rank, each point once
  geometry::Vec2 periods{};               ///< periods of the old mesh; 0 along axes that are not periodic
  std::string name = "the old mesh";      ///< in messages: the file, if there is one
};

} // namespace trime::start
