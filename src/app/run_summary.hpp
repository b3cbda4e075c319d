// SPDX-License-Identifier: BSD-3-Clause
// Makes the summary that a run prints at its end by default: at most 16 lines, with each fact once.
#pragma once

#include "app/measurements.hpp"
#include "app/provenance.hpp"
#include "app/run_report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::app {

/// References to the results of a run, for its summary.
/// @pre all referenced objects outlive this object
struct RunFacts {
  const Provenance& provenance;
  const meshing::MeshResult& result;
  const SizeSummary& size;
  const Measurements& measured;
  const io::WrittenFiles& files; ///< the files of the mesh; empty if the run writes no mesh
  const std::vector<std::int64_t>&
      part_edges; ///< number of edges of each part of the boundary and of each curve, see edges_of_parts
};

/// @brief Counts the boundary edges of the whole mesh for each part of the shape, and then the edges on each curve:
/// those on both sides of a split curve.
/// @param parts number of parts
/// @param curves number of curves
/// @note Collective.
std::vector<std::int64_t> edges_of_parts(const mesh::DistributedMesh& mesh, std::size_t parts, std::size_t curves,
                                         const comm::Communicator& comm);

/// Returns the summary. Each line begins with a word that names its subject. There is no line end after the last line.
std::string run_summary(const RunFacts& facts);

} // namespace trime::app
