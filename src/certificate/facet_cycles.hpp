// SPDX-License-Identifier: BSD-3-Clause
// The cycles that the facets of a mesh make, counted where they lie: no rank sees all of them.
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

/// @brief The cycles of facets, when each facet is followed by the one that starts where it ends. A point is regular if
/// exactly one facet starts there and exactly one ends.
struct CycleCounts {
  std::int64_t irregular = 0; ///< ends of facets that are not regular
  std::int64_t cycles = 0;    ///< closed ones, of regular points alone
  std::int64_t changes = 0;   ///< regular points where the tag changes
  std::uint64_t tags = 0;     ///< sum of the tag_hash of each cycle, mod 2^64
};
std::uint64_t tag_hash(std::int64_t tag);

/// @brief Returns the counts of this rank; their sums over all ranks are the counts of all facets. Each rank gets the
/// facets at its share of the ids and joins what follows on each other to one link. Then ranks join links in pairs,
/// pairs of pairs, and so on: what is closed is counted and goes no further. So a message holds the ways of the
/// boundary through a range of ids, which are of the order of the square root of its points where ids run along the
/// Hilbert curve. O(facets of the rank, log of them), log(ranks) messages one after the other. Collective.
/// @param points global ids are below
CycleCounts count_cycles(std::span<const TaggedFacet> facets, GlobalId points, const comm::Communicator& comm);

} // namespace trime::certificate
