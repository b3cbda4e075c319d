// SPDX-License-Identifier: BSD-3-Clause
// Where the boundary asks for smaller triangles than the size field does.
#pragma once

#include "boundary/boundary_sites.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::boundary {

/// @brief Limits where the size is too large for the boundary: at the middle of each chord that is clearly shorter than
/// it (a corner, or a part of the boundary near by, has made it so), or too long for the channel that it borders
/// (another part of the boundary sees it, from the inside, at an angle of more than 75 degrees), and at each site that
/// has another near across the inside. Chords at corners of less than 60 degrees, and their arms, set no limit. No
/// limit is below a twentieth of `asked`, the size before anything was lowered. In the order of the chords, most of
/// those left out that the size implies around another, which grows with `gradation` from it. O(B log B)
std::vector<sizing::SizeLimit> size_limits(const polygon::BoundarySites& boundary, const sizing::SizeField& size,
                                           const sizing::SizeField& asked, double gradation);

/// The same by all ranks, each of which looks at a share of the chords and at the sites near them. Collective.
std::vector<sizing::SizeLimit> size_limits(const comm::Communicator& comm, const polygon::BoundarySites& boundary,
                                           const sizing::SizeField& size, const sizing::SizeField& asked,
                                           double gradation);

} // namespace trime::boundary
