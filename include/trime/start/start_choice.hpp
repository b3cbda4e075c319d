// SPDX-License-Identifier: BSD-3-Clause
// The ways in which a run may place its first points.
#pragma once

namespace trime::start {

/// @brief How a run places its first points. `lattice`: a hexagonal lattice, for uniform sizes. `hilbert`: along the
/// Hilbert curve, at equal shares of the wanted density. `coarse_to_fine`: a mesh of few points is relaxed and its
/// edges are divided, repeatedly. `automatic`: chosen by the size field.
enum class Start { automatic, lattice, hilbert, coarse_to_fine };

} // namespace trime::start
