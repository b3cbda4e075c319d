// SPDX-License-Identifier: BSD-3-Clause
// Converts a mesh file for other programs, and prints what is in a mesh file.
#pragma once

#include "app/command_line.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/io/mesh_file.hpp"

#include <string>

namespace trime::app {

/// The file of `trime_mpi convert IN OUT` in the format of the ending of OUT. @throws ConfigError, FileError on all
/// ranks @note Collective.
void convert(const CommandLine& line, io::RunFiles* files, const comm::Communicator& comm, Log& log);

/// Returns what `trime_mpi info FILE` prints. @throws FileError on all ranks @note Collective.
std::string info(const std::string& path, const comm::Communicator& comm);

} // namespace trime::app
