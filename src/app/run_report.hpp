// SPDX-License-Identifier: BSD-3-Clause
// The report of a run as text for people, and its exit code.
#pragma once

#include "app/measurements.hpp"
#include "app/user_places.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/mesher.hpp"

#include <string>
#include <vector>

namespace trime::app {

/// Facts about the size field.
struct SizeSummary {
  std::string description;          ///< such as "automatic, gradation 0.1, ..."
  double smallest = 0, largest = 0; ///< target edge length over the points of the mesh
};

/// @note Collective.
SizeSummary summarize_size(std::string description, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// @brief The report of a run, several lines. `files` may be empty.
std::string run_report(const meshing::MeshResult& result, const SizeSummary& size, const Measurements& measured,
                       const io::WrittenFiles& files, const std::vector<NormalizedPart>& normalized = {});

/// Number of the triangulation that became the final mesh, from 1: one more than those of the sweeps.
int final_retriangulation(const meshing::MeshResult& result);

/// Returns the exit code of a finished run: done, or incomplete if the stop rule was not met or a check failed.
ExitCode exit_code(const meshing::MeshResult& result);

/// Why the mesh is not complete, one sentence for a warning. @pre !is_complete(result) @param written to a file
std::string incompleteness(const meshing::MeshResult& result, bool written);

} // namespace trime::app
