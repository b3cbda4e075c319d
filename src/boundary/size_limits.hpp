// SPDX-License-Identifier: BSD-3-Clause
// Finds the places where the boundary needs smaller triangles than the size field gives.
#pragma once

#include "polygon/polygon.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::boundary {

/// @brief Returns a limit on the size for each place where the size is too large for the boundary. There are three
/// kinds. The first lies at the middle of a boundary edge (chord) that is clearly shorter than the size, because of a
/// corner or a nearby part of the boundary. The second lies at the middle of a chord that is too long for the channel
/// next to it: from another part of the boundary across the channel, it is seen at an angle of more than 75 degrees.
/// The third lies at a boundary site with another site near it across the inside. Chords at corners of less than 60
/// degrees, and the sides of these corners, set no limit. No limit is below a twentieth of `asked`, the size before it
/// was lowered. Limits are in the order of the chords. Most limits that follow from another limit, which grows with
/// `gradation` around its place, are left out. Cost: O(B log B) for B boundary sites.
std::vector<sizing::SizeLimit> size_limits(const polygon::BoundarySites& boundary, const sizing::SizeField& size,
                                           const sizing::SizeField& asked, double gradation);

/// Returns the same limits as the function above, computed by all ranks together: each rank examines a share of the
/// chords and of the sites near them. Both sides of the curves inside count. Collective.
std::vector<sizing::SizeLimit> size_limits(const comm::Communicator& comm, const polygon::BoundarySites& boundary,
                                           const sizing::SizeField& size, const sizing::SizeField& asked,
                                           double gradation);

} // namespace trime::boundary
