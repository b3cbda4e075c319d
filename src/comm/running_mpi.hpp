// SPDX-License-Identifier: BSD-3-Clause
// What must be looked after where MPI was started by another part of the program.
#pragma once

#include <mpi.h>

namespace trime::comm {

#ifdef SMPI_H // SimGrid's MPI, which knows no threads
inline constexpr int needed_thread_level = MPI_THREAD_SINGLE;
#else
inline constexpr int needed_thread_level = MPI_THREAD_FUNNELED;
#endif

/// @brief Keeps Open MPI 4 from its collective file writer `vulcan`, which is known to write wrong data. Works until
/// the first file is opened by MPI: that is when Open MPI chooses the writer. A choice of the user stays.
void avoid_wrong_writer();

/// @brief avoid_wrong_writer, and one warning on the standard error if MPI was started for one thread only while OpenMP
/// has several. @pre MPI is running
void join_running_mpi();

/// @brief Warns once on the standard error if Open MPI 4 has chosen its file writer before avoid_wrong_writer was
/// called, so that `vulcan` may write. Cheap after the first call. @param speaks whether this rank prints @pre MPI is
/// running
void warn_of_wrong_writer(bool speaks);

/// @throws ConfigError if `comm` cannot be duplicated, see duplicate_of
void check_usable(MPI_Comm comm);

} // namespace trime::comm
