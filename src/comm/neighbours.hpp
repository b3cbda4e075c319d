// SPDX-License-Identifier: BSD-3-Clause
// Messages between ranks that talk to each other repeatedly: they need no collective call, and no other rank waits.
#pragma once

#include "trime/comm/communicator.hpp"

#include <span>
#include <vector>

namespace trime::comm {

/// @brief Sends one message, perhaps an empty one, to each of the peers, and receives one from each of them. The
/// receiver need not know the size: a message contains it, and everything beyond the first 4 kB follows at once. Only
/// this rank and its peers take part.
/// @param peers does not contain this rank; each of them calls this function with this rank among its peers
/// @param outgoing has at most one message for each peer; peers without one get an empty message
/// @return the message of each peer, in the order of `peers`
std::vector<Message> exchange_among(const Communicator& comm, std::span<const int> peers,
                                    std::span<const Message> outgoing);

/// @brief The ranks that a rank may talk to. The relation is symmetric.
class Neighbours {
public:
  /// Knows no ranks yet. The communicator must outlive the object.
  explicit Neighbours(const Communicator& comm) : comm_(comm) {}

  /// Adds ranks other than this one, and adds this rank to their neighbours. Collective: one exchange_any.
  void add(std::span<const int> ranks);

  /// Returns the ranks in ascending order.
  std::span<const int> ranks() const { return ranks_; }
  bool contains(int rank) const;

private:
  const Communicator& comm_;
  std::vector<int> ranks_;
};

} // namespace trime::comm
