// SPDX-License-Identifier: BSD-3-Clause
// Checks the path of the stop file (key `checkpoint.stop_file`). A run that finds the stop file removes it and stops.
#pragma once

#include "app/command_line.hpp"
#include "app/options.hpp"
#include "trime/comm/communicator.hpp"

namespace trime::app {

/// @brief Checks that removing the stop file cannot remove another file: it must not be the config, nor a file that the
/// run reads or writes.
/// @throws ConfigError if it is one of these files; FileError if it exists and is not a regular file; on all ranks
/// together
/// @note Collective.
void check_stop_file(const RunOptions& options, const CommandLine& line, const comm::Communicator& comm);

} // namespace trime::app
