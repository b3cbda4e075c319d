// SPDX-License-Identifier: BSD-3-Clause
// The work of the program between reading the command line and returning the exit code.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

namespace trime::io {
class RunFiles;
}

namespace trime::app {

class SignalRequests;
class UserPlaces;

/// The objects that the program shares with main().
struct Process {
  io::RunFiles* files;     ///< keeps the names of existing files for a signal handler; may be null
  SignalRequests& signals; ///< the requests that signals have made
  UserPlaces& places;      ///< receives the data with which main() explains where in the user's files an error lies
};

/// @brief Runs the program and returns its exit code.
/// @note Collective.
/// @throws Error on all ranks together
ExitCode run_program(int argc, const char* const* argv, const comm::Communicator& comm, const Process& process);

} // namespace trime::app
