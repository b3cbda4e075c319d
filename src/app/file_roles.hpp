// SPDX-License-Identifier: BSD-3-Clause
// Checks that no file has two roles in a run: a run replaces its outputs, and removes the stop file that it finds, so
// neither may be an input.
#pragma once

#include "app/command_line.hpp"
#include "app/options.hpp"
#include "trime/comm/communicator.hpp"

namespace trime::app {

/// @brief Checks that no output of the run has the path of its config or of a file that it reads, even if
/// `output.overwrite` allows to replace files. The mesh file and the checkpoint from which the run starts may be
/// replaced. Also checks that the report is neither one of these files nor another output, and that the stop file (key
/// `checkpoint.stop_file`) is neither the config nor a file that the run reads or writes.
/// @throws ConfigError if a file has two roles; FileError if the stop file exists and is not a regular file; on all
/// ranks together
/// @note Collective.
void check_file_roles(const RunOptions& options, const CommandLine& line, const comm::Communicator& comm);

} // namespace trime::app
