// SPDX-License-Identifier: BSD-3-Clause
// Finds out whether all ranks have failed, or only one rank for which the others wait.
#pragma once

#include "trime/comm/communicator.hpp"

namespace trime::comm {

/// @brief Returns true on all ranks if all of them call this function within `seconds`. A rank that waits for the
/// caller in another collective call does not arrive, so the result is false. After false, the caller may only call
/// abort_job.
/// @param comm is used for nothing else
bool all_arrive(const Communicator& comm, double seconds);

} // namespace trime::comm
