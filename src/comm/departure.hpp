// SPDX-License-Identifier: BSD-3-Clause
// Whether an error is that of all ranks, or of one that others wait for.
#pragma once

#include "trime/comm/communicator.hpp"

namespace trime::comm {

/// @brief Do all ranks call this within so many seconds? True then, on all of them. A rank that waits for the caller in
/// another collective does not come, so the answer is no. Once it was no, only abort_job may follow.
/// @param comm a communicator that is used for nothing else
bool all_arrive(const Communicator& comm, double seconds);

} // namespace trime::comm
