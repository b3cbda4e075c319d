// SPDX-License-Identifier: BSD-3-Clause
// What a run has to say at its end, as text for people: the report and the exit code.
#pragma once

#include "app/user_places.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"
#include "trime/core/timer.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/make_mesh.hpp"

#include <string>
#include <vector>

namespace trime::app {

/// Seconds of one section over the ranks, and what was sent in it.
struct TimeRow {
  std::string section;
  std::int64_t calls = 0;
  double min = 0, mean = 0, max = 0;
  std::int64_t messages = 0, bytes = 0; ///< of all ranks together
  std::int64_t collectives = 0;         ///< of the rank with most
};

/// What the ranks measured, brought together.
struct Measurements {
  std::vector<TimeRow> times; ///< sections, then "other": the means add up to the total
  double total = 0;           ///< seconds, mean over ranks
  int ranks = 1;
  std::int64_t most_points = 0;                 ///< of a rank
  double mean_points = 1;                       ///< over ranks
  std::int64_t peak_memory = 0, memory_sum = 0; ///< bytes: largest of a rank, and of all ranks together
};

/// What the size field was, and what became of it.
struct SizeSummary {
  std::string description;          ///< such as "automatic, gradation 0.1, ..."
  double smallest = 0, largest = 0; ///< target edge length over the points of the mesh
};

/// @note Collective.
SizeSummary summarize_size(std::string description, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// @param points that this rank holds
/// @note Collective.
Measurements gather_measurements(const TimerTable& timers, std::int64_t points, const comm::Communicator& comm);

/// @brief The report of a run, several lines. `files` may be empty.
std::string run_report(const meshing::MeshResult& result, const SizeSummary& size, const Measurements& measured,
                       const io::WrittenFiles& files, const std::vector<NormalizedPart>& normalized = {});

/// Number of the triangulation that became the final mesh, from 1: one more than those of the sweeps.
int final_retriangulation(const meshing::MeshResult& result);

/// Of a run that came to its end: done, or incomplete if the stop rule was not met or a check failed.
ExitCode exit_code(const meshing::MeshResult& result);

/// Why the mesh is not complete, one sentence for a warning. @pre !is_complete(result) @param written to a file
std::string incompleteness(const meshing::MeshResult& result, bool written);

} // namespace trime::app
