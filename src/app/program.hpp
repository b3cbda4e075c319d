// SPDX-License-Identifier: BSD-3-Clause
// The program between the command line and the exit code.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

namespace trime::io {
class RunFiles;
}

namespace trime::app {

class SignalRequests;
class UserPlaces;

/// @brief Runs the program. @note Collective.
/// @param files notes which files exist, for a signal handler; may be null
/// @param signals what signals ask for
/// @param places gets what the caller needs to explain an error that is thrown
/// @throws Error on all ranks together
ExitCode run_program(int argc, const char* const* argv, const comm::Communicator& comm, io::RunFiles* files,
                     SignalRequests& signals, UserPlaces& places);

} // namespace trime::app
