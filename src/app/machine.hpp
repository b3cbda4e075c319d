// SPDX-License-Identifier: BSD-3-Clause
// Facts about the machine: cores, threads, memory, versions.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"

#include <cstdint>
#include <string>

namespace trime::app {

struct Placement {
  int ranks = 1;
  int setup_threads = 1, threads = 1; ///< threads of this rank while shape and size field are made, and afterwards
  int asked = 1;                      ///< the larger number as it was asked for: this rank may use fewer
  int nodes = 1;
  int cores = 1;   ///< processors that this rank may use
  int sharing = 1; ///< ranks of this node with exactly these processors
  int before = 0;  ///< number of these ranks that are lower than this one
};

/// @brief Finds where the ranks are, and how many threads each uses: the number asked for if positive, else
/// OMP_NUM_THREADS, else all processors that the rank may use, divided among the ranks that share them. The limit is 16
/// threads per processor, or 64, because each thread has separate tables.
/// @note Collective.
Placement place_threads(int setup_threads, int mesh_threads, const comm::Communicator& comm);

/// Sets how many threads all later loops use, and starts them on processors of their own where there are enough.
void use_threads(const Placement& placement, int threads);

/// Says ranks x threads, and warns where threads outnumber processors, or the launcher is that of another MPI.
/// @note Collective.
void report_placement(const Placement& placement, const comm::Communicator& comm, Log& log);

/// Peak resident memory of this process in bytes; 0 if unknown.
std::int64_t peak_memory();

std::string host_name();
/// Now, as 2000-12-31T23:59:59Z.
std::string utc_time();

/// Versions of the program and of what it was built with.
struct BuildInfo {
  std::string version, git_commit, build_type, compiler, mpi_library, hdf5_library;
};
BuildInfo build_info();

} // namespace trime::app
