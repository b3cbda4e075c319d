// SPDX-License-Identifier: BSD-3-Clause
// Guards against faults of MPI libraries. The guards also work if another part of the program has started MPI.
#pragma once

#include <mpi.h>

namespace trime::comm {

#ifdef SMPI_H // SimGrid's MPI, which knows no threads
inline constexpr int needed_thread_level = MPI_THREAD_SINGLE;
#else
inline constexpr int needed_thread_level = MPI_THREAD_FUNNELED;
#endif

/// @brief Keeps Open MPI 4 from using its collective file writer `vulcan`, which is known to write wrong data. Must be
/// called before MPI opens its first file, because Open MPI chooses its writer at that moment. If the user has chosen a
/// writer, it is kept.
void avoid_wrong_writer();

/// @brief Calls avoid_wrong_writer. Warns once on the standard error if MPI was started for one thread only although
/// OpenMP has several threads.
/// @pre MPI is running
void join_running_mpi();

/// @brief Warns once on the standard error if Open MPI 4 had already chosen its file writer when avoid_wrong_writer was
/// called, so that `vulcan` may write. Later calls cost almost nothing.
/// @param speaks whether this rank prints the warning
/// @pre MPI is running
void warn_of_wrong_writer(bool speaks);

/// Checks that `comm` can be duplicated, see duplicate_of.
/// @throws ConfigError if it cannot
void check_usable(MPI_Comm comm);

} // namespace trime::comm
