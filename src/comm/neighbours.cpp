// SPDX-License-Identifier: BSD-3-Clause
#include "comm/neighbours.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <cstring>

namespace trime::comm {
namespace {

/// The first part of a message with the size of all of it before: small enough for MPI to send it at once.
constexpr std::size_t head_bytes = 4096;
using Size = std::uint64_t;
constexpr std::size_t most_in_head = head_bytes - sizeof(Size);

std::vector<std::byte> head_of(std::span<const std::byte> data) {
  const Size size = data.size();
  std::vector<std::byte> head(sizeof size + std::min(data.size(), most_in_head));
  std::memcpy(head.data(), &size, sizeof size);
  std::copy_n(data.begin(), head.size() - sizeof size, head.begin() + sizeof size);
  return head;
}

/// What follows the head, if anything does.
void add_rest(int peer, std::span<const std::byte> data, std::vector<Message>& rests) {
  if (data.size() > most_in_head)
    rests.push_back({peer, {data.begin() + most_in_head, data.end()}});
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
                 "a message for rank {}, which is none of the {} peers", message.peer, peers.size());
  comm.exchange_known(heads, incoming);
  for (Message& message : incoming) {
    Size size = 0;
    std::memcpy(&size, message.data.data(), sizeof size);
    message.data.erase(message.data.begin(), message.data.begin() + sizeof size);
    message.data.resize(std::min<std::size_t>(size, most_in_head));
    if (size > most_in_head)
      more.push_back({message.peer, std::vector<std::byte>(size - most_in_head)});
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
