// SPDX-License-Identifier: BSD-3-Clause
// Writes meshes for other programs, at the end of a run or from a mesh file, and prints what is in a mesh file.
#pragma once

#include "app/command_line.hpp"
#include "app/options.hpp"
#include "trime/core/log.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/io/metadata.hpp"

#include <string>
#include <vector>

namespace trime::app {

/// Files of other formats that the run will write.
std::vector<std::string> export_paths(const RunOptions& options);

/// @throws FileError on all ranks if one of the files is there and may not be replaced @note Collective.
void check_exports(const RunOptions& options, const comm::Communicator& comm);

/// Writes the mesh in all formats of the options, next to the mesh file. @return the paths @note Collective.
std::vector<std::string> write_exports(const RunOptions& options, const mesh::DistributedMesh& mesh,
                                       const formats::Names& names, io::RunFiles* files,
                                       const comm::Communicator& comm);

/// The file of `trime_mpi convert IN OUT` in the format of the ending of OUT. @throws ConfigError, FileError on all
/// ranks @note Collective.
void convert(const CommandLine& line, io::RunFiles* files, const comm::Communicator& comm, Log& log);

/// Returns what `trime_mpi info FILE` prints. @throws FileError on all ranks @note Collective.
std::string info(const std::string& path, const comm::Communicator& comm);

} // namespace trime::app
