// SPDX-License-Identifier: BSD-3-Clause
// Exchanges messages between ranks that communicate repeatedly. Such an exchange
// needs no collective call, and no other rank waits.
#pragma once

#include "trime/comm/communicator.hpp"

#include <span>
#include <vector>

namespace trime::comm {

/// @brief Sends one message, which may be empty, to each of the peers, and receives one from each of them. The receiver
/// need not know the size: it is sent along with the first 4 kB of the message, and the rest follows in a second
/// message. Only this rank and its peers take part.
/// @param peers other ranks; each of them must call this function with this rank among its peers
/// @param outgoing at most one message for each peer; a peer without a message gets an empty one
/// @return the messages of the peers, in the order of `peers`
std::vector<Message> exchange_among(const Communicator& comm, std::span<const int> peers,
                                    std::span<const Message> outgoing);

/// @brief The ranks with which this rank may exchange messages. If a rank has another rank as its neighbour, the other
/// rank has it as neighbour too.
class Neighbours {
public:
  /// Contains no ranks at first. The communicator must outlive this object.
  explicit Neighbours(const Communicator& comm) : comm_(comm) {}

  /// Adds other ranks as neighbours of this rank, and this rank as a neighbour of theirs. Collective: one exchange_any.
  void add(std::span<const int> ranks);

  /// Returns the neighbours in ascending order.
  std::span<const int> ranks() const { return ranks_; }
  bool contains(int rank) const;

private:
  const Communicator& comm_;
  std::vector<int> ranks_;
};

} // namespace trime::comm
