// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module sites.
#pragma once

#include "trime/core/types.hpp"

#include <limits>

namespace trime::sites {

/// Limits of the halo, and of the number of sites on a rank.
struct SiteRules {
  /// [sites] A rank with fewer owned sites fetches a wider halo. With 6000, 256 ranks needed 14 rounds, but had 1.5
  /// times as many ghosts in the last stage. The effect of a quarter more or less: Not measured.
  static constexpr int few_owned = 3000;
  /// [rounds] Largest number of rounds in which ranks ask for more bins. Every round reaches at least one bin farther,
  /// and two rounds are enough in practice. If more are needed, the program has an error.
  static constexpr int most_halo_rounds = 100;
  /// [sites] Largest number of owned sites on a rank. LocalIndex counts sites and ghosts, and one eighth of its range
  /// is left for ghosts and growth. Not measured.
  static constexpr std::int64_t most_owned = std::numeric_limits<LocalIndex>::max() / 8 * 7;
};

} // namespace trime::sites
