// SPDX-License-Identifier: BSD-3-Clause
// The library in one header: shapes, sizes, make_mesh, and what a program does with a mesh. All names are in `trime`;
// modules such as trime::meshing are the lower level, for those who need more.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"
#include "trime/facade/mesh.hpp"
#include "trime/facade/shape.hpp"
#include "trime/facade/size.hpp"

namespace trime {

/// One object in main starts MPI and ends it; it does nothing where MPI is running already.
using Environment = comm::Environment;

} // namespace trime
