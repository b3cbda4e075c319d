// SPDX-License-Identifier: BSD-3-Clause
// Writes the report of a run as one JSON file, for scripts that compare many runs; it is also written by runs without a
// mesh. The section "The report as JSON" of src/files.md describes its content.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"

#include <string>
#include <vector>

namespace trime::io {

/// Version of the report's content. The version is raised when a member is removed or changes its meaning, but not when
/// members are added.
inline constexpr int report_version = 1;

/// The end of a run: facts that are not part of its metadata.
struct Outcome {
  int exit_code = 0;
  std::vector<std::string> files;      ///< paths of the written files
  std::vector<std::string> warnings{}; ///< warnings of the run, as it printed them
};

/// @brief Returns {"format": "trime_mpi-report", "format_version": 1, "exit_code", "files": [...], "warnings": [...],
/// "attributes": {name: value}, "groups": {group: {"attributes": {...}, "columns": {name: [values]}}}}. Attributes and
/// groups have the same names as in the group /trime_mpi of a mesh file; texts are left out. Numbers that are not
/// finite become null, and bytes that are not UTF-8 are replaced, because JSON cannot hold them.
std::string report_json(const Metadata& metadata, const Outcome& outcome);

/// @brief Checks that the file can be written and would not replace a link, pipe or device. Called before long
/// computations whose result would otherwise be lost.
/// @throws FileError on all ranks
/// @note Collective.
void check_report_file(const std::string& path, const comm::Communicator& comm);

/// @brief Writes the report of rank 0 to `path`; a file of this name is replaced. The file appears complete or not at
/// all.
/// @throws FileError on all ranks
/// @note Collective.
void write_report_file(const std::string& path, const Metadata& metadata, const Outcome& outcome,
                       const comm::Communicator& comm);

} // namespace trime::io
