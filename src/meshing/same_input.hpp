// SPDX-License-Identifier: BSD-3-Clause
// Checks that all ranks have the same input. Every rank evaluates shape and size itself, and different processors or
// libraries might give different bits.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>

namespace trime::meshing {

/// Hashes of the domain, and of the sizes on its boundary.
struct InputHashes {
  std::int64_t shape = 0, sizes = 0;
};

/// @brief Checks that all ranks have the same domain and the same sizes at a thousand places on it. Also tests the
/// arithmetic of each rank. Collective. O(pieces)
/// @return the common hashes
/// @throws InternalError on all ranks if they differ, because ranks would then wait for each other without end or fail
/// the certificate; also throws the errors of the size field
InputHashes check_same_input(const geometry::Domain& domain, const sizing::SizeField& size,
                             const comm::Communicator& comm);

} // namespace trime::meshing
