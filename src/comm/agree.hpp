// SPDX-License-Identifier: BSD-3-Clause
// Makes every rank throw the same error together, so that no rank waits in a collective call for one that has left.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

#include <functional>
#include <optional>

namespace trime::comm {

/// @brief If any rank passes an error, all ranks throw the error of the lowest such rank. The message names the rank
/// unless it is rank 0 or the only one. Collective; one integer reduction in the usual case.
void agree(const Communicator& comm, const std::optional<Error>& error);

/// @brief Runs `work` and returns the error that it threw, or nothing. Other exceptions become an Error: std::bad_alloc
/// gets exit code 6, anything else exit code 1.
std::optional<Error> error_of(const std::function<void()>& work);

/// @brief Runs `work`, which must not communicate, and then calls agree with the error that it threw. Collective.
void run_agreed(const Communicator& comm, const std::function<void()>& work);

} // namespace trime::comm
