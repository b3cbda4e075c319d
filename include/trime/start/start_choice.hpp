// SPDX-License-Identifier: BSD-3-Clause
// The ways in which a run may place its first points.
#pragma once

namespace trime::start {

/// @brief Where the points come from. Lattice: hexagonal, for uniform sizes. Hilbert: quantiles along the Hilbert
/// curve. Coarse to fine: a mesh of few points is relaxed, its edges are divided, and again.
enum class Start { automatic, lattice, hilbert, coarse_to_fine };

} // namespace trime::start
