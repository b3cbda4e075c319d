// SPDX-License-Identifier: BSD-3-Clause
// Helpers for all MPI calls of this module: they check return codes, and count messages, bytes and waiting times.
#pragma once

#include "comm/native.hpp"
#include "trime/core/error.hpp"
#include "trime/core/timer.hpp"

#include <cstddef>
#include <string>
#include <vector>

#ifdef TRIME_SIMULATE
#include <simulated_work.hpp> // in scripts/cluster
#endif

namespace trime::comm {

#ifndef TRIME_SIMULATE
/// In simulations of a cluster, the version of this class in scripts/cluster/simulated_work.hpp stops the simulated
/// clock while it exists. In real runs the class does nothing.
struct InMpi {
  InMpi() {}
  ~InMpi() {}
};
inline void begin_simulated_work() {}
inline void end_simulated_work() {}
#endif

/// The MPI tags of messages: one for each kind of exchange.
enum Tag : int { tag_known = 101, tag_head = 102, tag_bundle = 103, tag_scan = 104 };

/// Ends the job if an MPI call failed. Only this function looks at return codes of MPI.
inline void check(int code) {
  if (code == MPI_SUCCESS)
    return;
  char text[MPI_MAX_ERROR_STRING];
  int length = 0;
  MPI_Error_string(code, text, &length);
  fmt::print(stderr, "trime_mpi: MPI error: {}\n", std::string(text, static_cast<std::size_t>(length)));
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::internal_error));
}

/// [bytes] Longer messages are sent in several pieces of this size, in order, because MPI counts in int.
inline constexpr std::size_t piece_bytes = std::size_t{1} << 30;

/// Counts a collective call, and returns the MPI communicator for it.
inline MPI_Comm collective(const Communicator::Native& native) {
  native.counters.add(Counter::collectives);
  return native.comm;
}

/// Exists during an MPI call, and adds the duration of the call to the time in which this rank waits for others.
class Wait {
public:
  explicit Wait(const Communicator::Native& native) : counters_(native.counters), start_(wall_seconds()) {}
  ~Wait() { counters_.add(Counter::wait_ns, static_cast<std::int64_t>(1e9 * (wall_seconds() - start_))); }
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

private:
  InMpi in_mpi_;
  Counters& counters_;
  double start_; // [s]
};

/// Counts a message to another rank. Messages of a rank to itself are not counted.
inline void count_message(const Communicator::Native& native, int to, std::size_t bytes) {
  if (to != native.rank)
    native.counters.add_message(to, static_cast<std::int64_t>(bytes));
}

/// Returns a table with one value for each rank, and counts the memory of the table.
template <class T>
std::vector<T> table_of_ranks(const Communicator& comm) {
  std::vector<T> table(static_cast<std::size_t>(comm.size()));
  comm.counters().note(Counter::rank_bytes, static_cast<std::int64_t>(table.size() * sizeof(T)));
  return table;
}

} // namespace trime::comm
