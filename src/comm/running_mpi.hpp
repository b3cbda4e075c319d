// SPDX-License-Identifier: BSD-3-Clause
// Guards against faults of MPI libraries, also where another part of the program started MPI.
#pragma once

#include <mpi.h>

namespace trime::comm {

#ifdef SMPI_H // SimGrid's MPI, which knows no threads
inline constexpr int needed_thread_level = MPI_THREAD_SINGLE;
#else
inline constexpr int needed_thread_level = MPI_THREAD_FUNNELED;
#endif

/// @brief Keeps Open MPI 4 from its collective file writer `vulcan`, which is known to write wrong data. Must be called
/// before MPI opens its first file, because Open MPI chooses the writer then. Keeps a writer that the user has chosen.
void avoid_wrong_writer();

/// @brief Calls avoid_wrong_writer, and warns once on the standard error if MPI was started for one thread only while
/// OpenMP has several. @pre MPI is running
void join_running_mpi();

/// @brief Warns once on the standard error if Open MPI 4 has chosen its file writer before avoid_wrong_writer was
/// called, so that `vulcan` may write. Cheap after the first call. @param speaks whether this rank prints @pre MPI is
/// running
void warn_of_wrong_writer(bool speaks);

/// @throws ConfigError if `comm` cannot be duplicated, see duplicate_of
void check_usable(MPI_Comm comm);

} // namespace trime::comm
