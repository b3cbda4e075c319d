// SPDX-License-Identifier: BSD-3-Clause
// Counts what a mesh file says about curves that are split, without reading the mesh.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <string>

namespace trime::io {

struct SplitCounts {
  std::int64_t pairs = 0;  ///< 0: no curve of the mesh is split
  std::int64_t paths = 0;  ///< runs of pairs along the curves
  std::int64_t copies = 0; ///< points at places where another point was before: a place with k points has k - 1
};

/// @brief Counts the pairs of a mesh file.
/// @throws FileError on all ranks
/// @note Collective. Only rank 0 reads. Memory there: about 60 bytes for each pair.
SplitCounts count_splits(const std::string& path, const comm::Communicator& comm);

} // namespace trime::io
