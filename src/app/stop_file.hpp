// SPDX-License-Identifier: BSD-3-Clause
// The file of `checkpoint.stop_file`, which a run that finds it removes.
#pragma once

#include "app/command_line.hpp"
#include "app/options.hpp"
#include "trime/comm/communicator.hpp"

namespace trime::app {

/// @brief Nothing else may go with it: neither the config, nor a file that the run reads or writes.
/// @throws ConfigError if it is one of these, FileError if it is there and no regular file; on all ranks together
/// @note Collective.
void check_stop_file(const RunOptions& options, const CommandLine& line, const comm::Communicator& comm);

} // namespace trime::app
