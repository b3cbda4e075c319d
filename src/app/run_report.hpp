// SPDX-License-Identifier: BSD-3-Clause
// Makes the report of a run as text for people, and chooses its exit code.
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

/// A description of the size field and the range of its values.
struct SizeSummary {
  std::string description;          ///< a text such as "automatic, gradation 0.1, ..."
  double smallest = 0, largest = 0; ///< smallest and largest target edge length at the points of the mesh
};

/// Finds the range of target edge lengths over all ranks.
/// @note Collective.
SizeSummary summarize_size(std::string description, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// @brief Returns the report of a run, which has several lines. `files` may be empty.
std::string run_report(const meshing::MeshResult& result, const SizeSummary& size, const Measurements& measured,
                       const io::WrittenFiles& files, const std::vector<NormalizedPart>& normalized = {});

/// Returns the number of the triangulation that became the final mesh, counted from 1. The sweeps made all earlier
/// ones.
int final_retriangulation(const meshing::MeshResult& result);

/// Returns the exit code of a finished run: done, or incomplete if the sweeps were ended by max_sweeps or a check
/// failed.
ExitCode exit_code(const meshing::MeshResult& result);

/// Returns a sentence for a warning that says why the mesh is not complete.
/// @pre !is_complete(result)
/// @param written whether the mesh was written to a file
std::string incompleteness(const meshing::MeshResult& result, bool written);

} // namespace trime::app
