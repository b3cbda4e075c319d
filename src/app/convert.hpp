// SPDX-License-Identifier: BSD-3-Clause
// Converts a mesh file to formats of other programs, and prints the contents of a mesh file.
#pragma once

#include "app/command_line.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"
#include "trime/core/log.hpp"
#include "trime/formats/exchange.hpp"
#include "trime/io/mesh_file.hpp"

#include <string>

namespace trime::app {

/// Does the work of `trime_mpi convert IN OUT`: writes the mesh in the format that belongs to the ending of OUT.
/// @return ExitCode::incomplete if the file has Voronoi cells and a check of them failed
/// @throws ConfigError, FileError on all ranks
/// @note Collective.
ExitCode convert(const CommandLine& line, io::RunFiles* files, const comm::Communicator& comm, Log& log);

/// Prints a line about the Voronoi cells of a file, and a warning for each check that failed.
void print_cells(const formats::Exported& made, Log& log);

/// Returns the text that `trime_mpi info FILE` prints. Lists with many names are cut unless `prints_all`.
/// @throws FileError on all ranks
/// @note Collective.
std::string info(const std::string& path, bool prints_all, const comm::Communicator& comm);

} // namespace trime::app
