// SPDX-License-Identifier: BSD-3-Clause
#include "comm/neighbours.hpp"

#include "comm/parcel.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::comm {
namespace {

/// Receives the bytes that follow the head, if there are any.
void add_rest(int peer, std::span<const std::byte> data, std::vector<Message>& rests) {
  if (const std::span<const std::byte> rest = rest_of(data); !rest.empty())
    rests.push_back({peer, {rest.begin(), rest.end()}});
}

} // namespace

std::vector<Message> exchange_among(const Communicator& comm, std::span<const int> peers,
                                    std::span<const Message> outgoing) {
  std::vector<Message> heads, rests, incoming, more;
  for (const int peer : peers) {
    const auto own = std::find_if(outgoing.begin(), outgoing.end(), [&](const Message& m) { return m.peer == peer; });
    const std::span<const std::byte> data = own != outgoing.end() ? std::span(own->data) : std::span<std::byte>();
    heads.push_back({peer, head_of(data)});
    add_rest(peer, data, rests);
    incoming.push_back({peer, std::vector<std::byte>(head_bytes)});
  }
  for (const Message& message : outgoing)
    TRIME_ASSERT(std::find(peers.begin(), peers.end(), message.peer) != peers.end(),
                 "there is a message for rank {}, which is not one of the {} peers", message.peer, peers.size());
  comm.exchange_known(heads, incoming);
  for (Message& message : incoming) {
    if (const std::size_t left = open_head(message.data); left > 0)
      more.push_back({message.peer, std::vector<std::byte>(left)});
  }
  comm.exchange_known(rests, more);
  for (const Message& rest : more) {
    const auto head =
        std::find_if(incoming.begin(), incoming.end(), [&](const Message& m) { return m.peer == rest.peer; });
    head->data.insert(head->data.end(), rest.data.begin(), rest.data.end());
  }
  return incoming;
}

void Neighbours::add(std::span<const int> ranks) {
  std::vector<Message> outgoing;
  for (const int rank : ranks)
    if (!contains(rank) &&
        std::none_of(outgoing.begin(), outgoing.end(), [&](const Message& m) { return m.peer == rank; }))
      outgoing.push_back({rank, {}});
  for (const Message& message : comm_.exchange_any(outgoing))
    outgoing.push_back(message);
  for (const Message& message : outgoing)
    ranks_.push_back(message.peer);
  std::sort(ranks_.begin(), ranks_.end());
  ranks_.erase(std::unique(ranks_.begin(), ranks_.end()), ranks_.end());
}

bool Neighbours::contains(int rank) const {
  return std::binary_search(ranks_.begin(), ranks_.end(), rank);
}

} // namespace trime::comm
