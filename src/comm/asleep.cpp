// SPDX-License-Identifier: BSD-3-Clause
#include "comm/asleep.hpp"

#include "comm/mpi_call.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace trime::comm {

void barrier_asleep(const Communicator& comm) {
  if (is_simulated()) { // its ranks take turns, and would all sleep
    comm.barrier();
    return;
  }
  using std::chrono::microseconds;
  constexpr microseconds shortest{10}, longest{1000};
  const Wait wait(comm.native());
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Ibarrier(collective(comm.native()), &request));
  int done = 0;
  check(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
  for (microseconds nap = shortest; !done; nap = std::min(2 * nap, longest)) {
    std::this_thread::sleep_for(nap);
    check(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
  }
}

} // namespace trime::comm
