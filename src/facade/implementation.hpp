// SPDX-License-Identifier: BSD-3-Clause
// The members of a Mesh of the library: the mesh, its record, and the communicator of its ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/facade/mesh.hpp"
#include "trime/io/metadata.hpp"
#include "trime/meshing/options.hpp"
#include "trime/record/describe.hpp"

#include <memory>

namespace trime {

struct Mesh::Implementation {
  std::shared_ptr<const comm::Communicator> communicator;
  meshing::MeshResult result; ///< only mesh, quality and checks if the mesh was read from a file
  record::Origin origin;
  io::Metadata metadata; ///< metadata of the file that write() makes, or that was read
};

} // namespace trime
