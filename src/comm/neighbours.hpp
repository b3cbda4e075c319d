// SPDX-License-Identifier: BSD-3-Clause
// Ranks that talk to each other again and again: their messages need no counting, and no other rank waits for them.
#pragma once

#include "trime/comm/communicator.hpp"

#include <span>
#include <vector>

namespace trime::comm {

/// @brief Sends one message, perhaps an empty one, to each of some ranks, and receives one from each of them. Sizes
/// need not be known: a message contains its size, and everything beyond its first 4 kB follows at once. All ranks of
/// the list take part, no others.
/// @param peers without this rank; each of them calls with this rank among its own peers
/// @param outgoing for some of the peers, at most one each: the others get an empty message
/// @return the message of each peer, in their order
std::vector<Message> exchange_among(const Communicator& comm, std::span<const int> peers,
                                    std::span<const Message> outgoing);

/// @brief The ranks that a rank may talk to. The relation is symmetric.
class Neighbours {
public:
  /// None yet. The communicator must outlive the object.
  explicit Neighbours(const Communicator& comm) : comm_(comm) {}

  /// Adds ranks, and this rank to those that they know. Collective: one exchange_any. @param ranks other than this one
  void add(std::span<const int> ranks);

  /// Ascending.
  std::span<const int> ranks() const { return ranks_; }
  bool contains(int rank) const;

private:
  const Communicator& comm_;
  std::vector<int> ranks_;
};

} // namespace trime::comm
