// SPDX-License-Identifier: BSD-3-Clause
// The measurements of a sweep: sums over the stars of the inner sites, for the history and for the rules.
#pragma once

#include "sites/star_view.hpp"
#include "sweep/alpha_bins.hpp"
#include "trime/core/sum.hpp"

#include <cstdint>

namespace trime::sweep {

/// Sums of one sweep over the inner sites of a rank, in integers: their order is irrelevant.
struct SweepSums {
  FixedSum squared_length_ratio; ///< L^2 / h_ref^2 over the bars seen from inner sites
  FixedSum squared_size_ratio;   ///< h^2 / h_ref^2 over the same bars, h the mean of both ends
  FixedSum excess_alpha;         ///< alpha - 1, each triangle with an inner site once
  AlphaBins alpha_bins;          ///< of the same triangles
  std::int64_t triangles = 0;
  double max_alpha = 1;
  FixedSum power; ///< of the last move: sum of -move . (move + lead before) / h^2, each term at most 2^10

  void add(const SweepSums& other);
};

/// Adds the star of the inner site i.
void measure_star(const sites::StarView& view, LocalIndex i, double reference_size, SweepSums& sums);

/// Sums over the inner owned sites. Threads over tiles. @param reference_size h_ref, any typical size
SweepSums measure(const sites::StarView& view, double reference_size);

} // namespace trime::sweep
