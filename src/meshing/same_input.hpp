// SPDX-License-Identifier: BSD-3-Clause
// Every rank evaluates shape and size for itself. Unlike processors or libraries may then give unlike bits.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>

namespace trime::meshing {

/// Hashes of the domain, and of sizes on its boundary.
struct InputHashes {
  std::int64_t shape = 0, sizes = 0;
};

/// @brief Do all ranks have the same domain, and the same sizes at a thousand places on it? Also
/// tests the arithmetic of each rank. Collective. O(pieces)
/// @return the hashes that they agree on
/// @throws InternalError on all ranks if they differ, since ranks would wait for each other without end or fail the
/// certificate; also throws what the size field throws
InputHashes check_same_input(const geometry::Domain& domain, const sizing::SizeField& size,
                             const comm::Communicator& comm);

} // namespace trime::meshing
