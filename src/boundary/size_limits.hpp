// SPDX-License-Identifier: BSD-3-Clause
// Finds where the boundary needs smaller triangles than the size field.
#pragma once

#include "polygon/polygon.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::boundary {

/// @brief Returns limits where the size is too large for the boundary. One kind is at the middle of a chord that is
/// clearly shorter than the size, because of a corner or a part of the boundary near it. Another kind is at the middle
/// of a chord that is too long for the channel next to it: seen from another part of the boundary across the inside, it
/// spans more than 75 degrees. The third kind is at a site with another site near it across the inside. Chords at
/// corners of less than 60 degrees, and their arms, set no limit. No limit is below a twentieth of `asked`, the size
/// before anything was lowered. Limits are in the order of the chords. Most limits that follow from another one, which
/// grows with `gradation` around it, are left out. O(B log B)
std::vector<sizing::SizeLimit> size_limits(const polygon::BoundarySites& boundary, const sizing::SizeField& size,
                                           const sizing::SizeField& asked, double gradation);

/// Does the same on all ranks together: each rank examines a share of the chords and the sites near them. Collective.
std::vector<sizing::SizeLimit> size_limits(const comm::Communicator& comm, const polygon::BoundarySites& boundary,
                                           const sizing::SizeField& size, const sizing::SizeField& asked,
                                           double gradation);

} // namespace trime::boundary
