// SPDX-License-Identifier: BSD-3-Clause
// Counts the closed cycles of the boundary edges (facets) of a mesh. No rank needs all facets.
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

/// @brief Counts of cycles of facets. A facet is followed by the facet that starts where it ends. A point is regular if
/// exactly one facet starts there and exactly one ends there.
struct CycleCounts {
  std::int64_t irregular = 0; ///< ends of facets at irregular points
  std::int64_t cycles = 0;    ///< closed cycles that contain regular points only
  std::int64_t changes = 0;   ///< regular points at which the tag changes
  std::uint64_t tags = 0;     ///< sum of the tag_hash of each cycle, mod 2^64
};
std::uint64_t tag_hash(std::int64_t tag);

/// @brief Returns the counts of this rank; their sums over all ranks are the counts of all facets. Each rank gets the
/// facets at its share of the point ids and joins consecutive facets to one link. Then pairs of ranks join their links,
/// then pairs of pairs, and so on; closed cycles are counted and not sent further. So a message contains the passages
/// of the boundary through a range of ids. If ids follow the Hilbert curve, the number of passages is of the order of
/// the square root of the number of points. Cost: O(f log f) for f facets of the rank, and log(ranks) consecutive
/// messages. Collective.
/// @param points number of points of the mesh; all global ids are smaller
CycleCounts count_cycles(std::span<const TaggedFacet> facets, GlobalId points, const comm::Communicator& comm);

} // namespace trime::certificate
