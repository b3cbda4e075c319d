// SPDX-License-Identifier: BSD-3-Clause
// The summary that a run prints at its end unless the user asks for more: at most 16 lines, each fact once.
#pragma once

#include "app/measurements.hpp"
#include "app/provenance.hpp"
#include "app/run_report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::app {

/// Holds references to the results of a run, for its summary. @pre all outlive this object
struct RunFacts {
  const Provenance& provenance;
  const meshing::MeshResult& result;
  const SizeSummary& size;
  const Measurements& measured;
  const io::WrittenFiles& files;               ///< empty if the run writes no mesh
  const std::vector<std::int64_t>& part_edges; ///< edges of the mesh on each part of the boundary, see edges_of_parts
};

/// @brief Counts the boundary edges of the whole mesh by the part of the shape that they follow.
/// @param parts the number of parts
/// @note Collective.
std::vector<std::int64_t> edges_of_parts(const mesh::DistributedMesh& mesh, std::size_t parts,
                                         const comm::Communicator& comm);

/// The summary. Each line begins with a word that says what it is about. The last line ends without a line end.
std::string run_summary(const RunFacts& facts);

} // namespace trime::app
