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

/// The program shares these with main().
struct Process {
  io::RunFiles* files;     ///< notes which files exist, for a signal handler; may be null
  SignalRequests& signals; ///< what signals ask for
  UserPlaces& places;      ///< gets what main() needs to explain an error that is thrown
};

/// @brief Runs the program. @note Collective.
/// @throws Error on all ranks together
ExitCode run_program(int argc, const char* const* argv, const comm::Communicator& comm, const Process& process);

} // namespace trime::app
