// SPDX-License-Identifier: BSD-3-Clause
// Lets ranks wait for a long time without using their core.
#pragma once

#include "trime/comm/communicator.hpp"

namespace trime::comm {

/// @brief Waits until all ranks have called this function, as MPI_Barrier does, but sleeps while waiting. MPI_Barrier
/// polls all the time, and so takes up a core that the working rank may need. Returns within about a millisecond after
/// the last rank has arrived. Collective.
void barrier_asleep(const Communicator& comm);

} // namespace trime::comm
