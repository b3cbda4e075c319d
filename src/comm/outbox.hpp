// SPDX-License-Identifier: BSD-3-Clause
// Sends lists of values to other ranks.
#pragma once

#include "comm/agree.hpp"
#include "trime/comm/communicator.hpp"

#include <map>
#include <span>
#include <vector>

namespace trime::comm {

/// Values for other ranks, by rank.
template <class T>
using Outbox = std::map<int, std::vector<T>>;

/// Sends the values, and returns the messages that arrive, ascending by rank; from_bytes<T> makes values of each.
/// Collective, see Communicator::exchange_any.
template <class T>
std::vector<Message> send(const Communicator& comm, const Outbox<T>& outbox) {
  std::vector<Message> outgoing;
  for (const auto& [rank, values] : outbox)
    outgoing.push_back({rank, to_bytes(std::span<const T>(values))});
  return comm.exchange_any(outgoing);
}

} // namespace trime::comm
