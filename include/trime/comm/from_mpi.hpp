// SPDX-License-Identifier: BSD-3-Clause
// For programs that start MPI themselves: a communicator of theirs becomes one of ours.
#pragma once

#include "trime/comm/communicator.hpp"

#include <mpi.h>

namespace trime::comm {

/// @brief A duplicate of any intracommunicator: the world, or a part of it from MPI_Comm_split. The caller may free
/// `comm` afterwards. Needs no Environment. As Environment does, it keeps Open MPI 4 from its file writer `vulcan`.
/// Where MPI was started for one thread only (MPI_Init) and OpenMP has several, it warns once on the standard error.
/// @throws ConfigError if MPI is not running; also for MPI_COMM_NULL, an intercommunicator, and, where the MPI library
/// notices it, a communicator that was freed
/// @note Collective over `comm`.
Communicator duplicate_of(MPI_Comm comm);

/// MPI is initialised and not yet finalised.
bool mpi_is_running();

} // namespace trime::comm
