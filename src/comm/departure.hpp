// SPDX-License-Identifier: BSD-3-Clause
// Finds out whether all ranks have an error, or only one that the others wait for.
#pragma once

#include "trime/comm/communicator.hpp"

namespace trime::comm {

/// @brief Returns true on all ranks if all of them call this within this time. A rank that waits for the caller in
/// another collective does not arrive, so the result is false. After false, only abort_job may follow.
/// @param comm a communicator that is used for nothing else
bool all_arrive(const Communicator& comm, double seconds);

} // namespace trime::comm
