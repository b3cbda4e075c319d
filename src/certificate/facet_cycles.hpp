// SPDX-License-Identifier: BSD-3-Clause
// Counts the cycles of the facets of a mesh. No rank needs all facets.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"

#include <cstdint>
#include <span>

namespace trime::certificate {

/// A facet with its tag.
struct TaggedFacet {
  GlobalId first, second;
  std::int64_t tag;
};

/// @brief Counts of cycles of facets. Each facet is followed by the one that starts where it ends. A point is regular
/// if exactly one facet starts there and exactly one ends.
struct CycleCounts {
  std::int64_t irregular = 0; ///< ends of facets at irregular points
  std::int64_t cycles = 0;    ///< closed cycles with regular points only
  std::int64_t changes = 0;   ///< regular points where the tag changes
  std::uint64_t tags = 0;     ///< sum of the tag_hash of each cycle, mod 2^64
};
std::uint64_t tag_hash(std::int64_t tag);

/// @brief Returns the counts of this rank; their sums over all ranks are the counts of all facets. Each rank gets the
/// facets at its share of the ids and joins consecutive ones to one link. Then pairs of ranks join their links, pairs
/// of pairs do, and so on; closed cycles are counted and not sent further. So a message holds the passages of the
/// boundary through a range of ids. If ids run along the Hilbert curve, their number is of the order of the square root
/// of the number of points. O(facets of the rank, times their logarithm) and log(ranks) consecutive messages.
/// Collective.
/// @param points all global ids are below this
CycleCounts count_cycles(std::span<const TaggedFacet> facets, GlobalId points, const comm::Communicator& comm);

} // namespace trime::certificate
