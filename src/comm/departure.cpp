// SPDX-License-Identifier: BSD-3-Clause
#include "comm/departure.hpp"

#include "comm/mpi_call.hpp"

#include <chrono>
#include <thread>

namespace trime::comm {

bool all_arrive(const Communicator& comm, double seconds) {
  using Clock = std::chrono::steady_clock;
  if (comm.size() == 1)
    return true;
  const InMpi in_mpi;
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Ibarrier(native_handle(comm), &request));
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  int arrived = 0;
  check(MPI_Test(&request, &arrived, MPI_STATUS_IGNORE));
  while (arrived == 0 && Clock::now() < end) {
    if (!is_simulated())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    check(MPI_Test(&request, &arrived, MPI_STATUS_IGNORE));
  }
  return arrived != 0;
}

} // namespace trime::comm
