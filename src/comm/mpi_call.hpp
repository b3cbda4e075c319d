// SPDX-License-Identifier: BSD-3-Clause
// Helpers for every MPI call of this module: they check its return code, and count what it sends.
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
/// Stops the clock of a simulated cluster (scripts/cluster/simulated_work.hpp), and does nothing in real runs.
struct InMpi {
  InMpi() {}
  ~InMpi() {}
};
inline void begin_simulated_work() {}
inline void end_simulated_work() {}
#endif

/// The kind of exchange that a message belongs to.
enum Tag : int { tag_known = 101, tag_head = 102, tag_bundle = 103, tag_scan = 104 };

/// Ends the job if an MPI call failed. No other code looks at return codes of MPI.
inline void check(int code) {
  if (code == MPI_SUCCESS)
    return;
  char text[MPI_MAX_ERROR_STRING];
  int length = 0;
  MPI_Error_string(code, text, &length);
  fmt::print(stderr, "trime_mpi: MPI error: {}\n", std::string(text, static_cast<std::size_t>(length)));
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::internal_error));
}

/// [bytes] Largest piece of a message, because MPI counts in int. Longer messages travel in several pieces, in order.
inline constexpr std::size_t piece_bytes = std::size_t{1} << 30;

/// Returns the handle for a collective call, and counts the call.
inline MPI_Comm collective(const Communicator::Native& native) {
  native.counters.add(Counter::collectives);
  return native.comm;
}

/// Lives during a call of MPI, and adds the duration to the time in which this rank waits for others.
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

/// Counts a message. Data that a rank sends to itself does not count.
inline void count_message(const Communicator::Native& native, int to, std::size_t bytes) {
  if (to != native.rank)
    native.counters.add_message(to, static_cast<std::int64_t>(bytes));
}

/// Returns a table with one value for each rank, and notes its memory.
template <class T>
std::vector<T> table_of_ranks(const Communicator& comm) {
  std::vector<T> table(static_cast<std::size_t>(comm.size()));
  comm.counters().note(Counter::rank_bytes, static_cast<std::int64_t>(table.size() * sizeof(T)));
  return table;
}

} // namespace trime::comm
