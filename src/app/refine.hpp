// SPDX-License-Identifier: BSD-3-Clause
// Refines a mesh file: each triangle becomes four.
#pragma once

#include "app/command_line.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"
#include "trime/core/log.hpp"
#include "trime/io/mesh_file.hpp"

namespace trime::app {

/// @brief Does the work of `trime_mpi refine IN.h5 OUT.h5`.
/// @return ExitCode::done, or ExitCode::incomplete if the refined mesh is marked as incomplete
/// @throws ConfigError, FileError on all ranks; then nothing is written
/// @note Collective.
ExitCode refine(const CommandLine& line, io::RunFiles* files, const comm::Communicator& comm, Log& log);

} // namespace trime::app
