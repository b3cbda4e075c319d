// SPDX-License-Identifier: BSD-3-Clause
// Finds facts about the machine: cores, threads, memory, versions of libraries.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"

#include <cstdint>
#include <string>

namespace trime::app {

struct Placement {
  int ranks = 1;
  int setup_threads = 1, threads = 1; ///< threads of this rank while shape and size field are made, and afterwards
  int asked = 1; ///< the larger of the two numbers as the user asked for it; the rank may use fewer threads
  int nodes = 1;
  int cores = 1;   ///< number of processors that this rank may use
  int sharing = 1; ///< number of ranks on this node that may use exactly the same processors
  int before = 0;  ///< how many of the ranks with the same processors are lower than this rank
};

/// @brief Finds on which nodes and processors the ranks run, and how many threads each rank uses. If a positive number
/// is asked for, that number is used. Otherwise it is OMP_NUM_THREADS if set, or all processors that the rank may use
/// divided by the number of ranks that share them. The limit is the larger of 16 threads per processor and 64 threads,
/// because each thread has its own tables.
/// @note Collective.
Placement place_threads(int setup_threads, int mesh_threads, const comm::Communicator& comm);

/// Sets how many threads all later loops use. If there are enough processors, each thread is bound to a separate one.
void use_threads(const Placement& placement, int threads);

/// Prints the numbers of ranks and threads. Warns if there are more threads than processors, or if mpirun belongs to
/// another MPI library than the program.
/// @note Collective.
void report_placement(const Placement& placement, const comm::Communicator& comm, Log& log);

/// Returns the peak resident memory of this process in bytes; 0 if unknown.
std::int64_t peak_memory();

std::string host_name();
/// Returns the present time in the form 2000-12-31T23:59:59Z.
std::string utc_time();

/// The versions of the program, its compiler and its libraries.
struct BuildInfo {
  std::string version, git_commit, build_type, compiler, mpi_library, hdf5_library;
};
BuildInfo build_info();

} // namespace trime::app
