// SPDX-License-Identifier: BSD-3-Clause
// Errors that every rank throws together, so that no rank waits in a collective for one that has left.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

#include <functional>
#include <optional>

namespace trime::comm {

/// @brief If any rank brings an error, all ranks throw the error of the lowest such rank. The message names the rank
/// unless it is rank 0 or the only one. Collective; one integer reduction in the normal case.
void agree(const Communicator& comm, const std::optional<Error>& error);

/// @brief Runs `work`. @return what it threw. Anything that is not an Error becomes one: std::bad_alloc exit code 6,
/// anything else exit code 1.
std::optional<Error> error_of(const std::function<void()>& work);

/// @brief Runs `work` (which must not communicate) and agrees on what it threw, see error_of. Collective.
void run_agreed(const Communicator& comm, const std::function<void()>& work);

} // namespace trime::comm
