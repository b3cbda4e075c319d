// SPDX-License-Identifier: BSD-3-Clause
// Makes the size field of the lower level from a size of trime.hpp.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/facade/size.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime {

/// @pre `size` outlives the field @throws ConfigError on all ranks together @note Collective.
std::shared_ptr<const sizing::SizeField> build_size(const Size& size, const geometry::Domain& domain,
                                                    const meshing::MeshOptions& options,
                                                    const comm::Communicator& comm);

} // namespace trime
