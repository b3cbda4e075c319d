// SPDX-License-Identifier: BSD-3-Clause
// Waits for ranks that work alone for long.
#pragma once

#include "trime/comm/communicator.hpp"

namespace trime::comm {

/// @brief Waits until all ranks have come here, as a barrier does, but sleeps meanwhile: MPI waits by asking again and
/// again, on a core that the rank which works may need. Wakes up within about a millisecond. Collective.
void barrier_asleep(const Communicator& comm);

} // namespace trime::comm
