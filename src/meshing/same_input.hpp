// SPDX-License-Identifier: BSD-3-Clause
// Checks that all ranks have the same input. Every rank evaluates shape and size itself, and different processors or
// libraries could give different bits.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>

namespace trime::meshing {

/// Hashes of the domain, and of the sizes at places on its boundary.
struct InputHashes {
  std::int64_t shape = 0, sizes = 0;
};

/// @brief Checks that all ranks have the same domain, and the same sizes at a thousand places on its boundary. Also
/// tests the floating-point arithmetic of each rank. Collective. Cost: O(pieces).
/// @return the hashes, which are the same on all ranks
/// @throws InternalError on all ranks if the hashes differ. Otherwise ranks could wait for each other without end, or
/// the certificate could fail. Also throws the errors of the size field
InputHashes check_same_input(const geometry::Domain& domain, const sizing::SizeField& size,
                             const comm::Communicator& comm);

} // namespace trime::meshing
