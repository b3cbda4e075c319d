// SPDX-License-Identifier: BSD-3-Clause
// For programs that start MPI themselves: makes a trime::comm::Communicator from an MPI communicator.
#pragma once

#include "trime/comm/communicator.hpp"

#include <mpi.h>

namespace trime::comm {

/// @brief Returns a duplicate of any intracommunicator: of the world, or of a part of it from MPI_Comm_split. The
/// caller may free `comm` afterwards. Needs no Environment. As Environment does, it keeps Open MPI 4 from using its
/// file writer `vulcan`. If MPI was started for one thread only (MPI_Init) and OpenMP has several threads, it warns
/// once on the standard error.
/// @throws ConfigError if MPI is not running, or if `comm` is MPI_COMM_NULL or an intercommunicator; also for a
/// communicator that was freed, if the MPI library notices that
/// @note Collective over `comm`.
Communicator duplicate_of(MPI_Comm comm);

/// Returns whether MPI is initialised and not yet finalised.
bool mpi_is_running();

} // namespace trime::comm
