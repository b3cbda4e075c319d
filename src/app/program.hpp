// SPDX-License-Identifier: BSD-3-Clause
// The program between the command line and the exit code.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

namespace trime::app {

/// @brief Runs the program. @note Collective.
/// @throws Error on all ranks together
ExitCode run_program(int argc, const char* const* argv, const comm::Communicator& comm);

} // namespace trime::app
