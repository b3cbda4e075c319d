// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which a rank keeps its sites.
#pragma once

#include "trime/core/types.hpp"

#include <limits>

namespace trime::sites {

/// The numbers of the sites module.
struct SiteRules {
  /// [sites] A rank with fewer owned sites fetches the wider halo. With 6000 it was 14 rounds, but there were half as
  /// many ghosts again in the last stage of 256 ranks. A quarter more or less: Not measured.
  static constexpr int few_owned = 3000;
  /// [rounds] Of asking for more bins: every round reaches at least one bin farther, and two suffice in practice. More
  /// means a fault of the program.
  static constexpr int most_halo_rounds = 100;
  /// [sites] Owned by a rank at most: sites and ghosts are counted by LocalIndex, and one in eight is left for ghosts
  /// and growth. Not measured.
  static constexpr std::int64_t most_owned = std::numeric_limits<LocalIndex>::max() / 8 * 7;
};

} // namespace trime::sites
