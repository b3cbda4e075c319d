// SPDX-License-Identifier: BSD-3-Clause
// Messages among ranks that know each other, and lists that travel in one message.
#include "comm/neighbours.hpp"

#include "comm/parcel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace trime::comm {
namespace {

/// What a rank sends to another one in a round: often nothing, sometimes about the 4 kB of a head, sometimes much more.
std::vector<std::byte> words(int from, int to, int round) {
  constexpr std::array<std::size_t, 6> sizes{0, 17, 4087, 4088, 4089, 300000};
  return std::vector<std::byte>(sizes[static_cast<std::size_t>(from + 2 * to + round) % sizes.size()],
                                static_cast<std::byte>(from + 16 * round));
}

TEST(Neighbours, ExchangeMessagesOfAnySize) {
  const Communicator comm = Communicator::world();
  std::vector<int> peers; // a chain: the ends have one only
  for (const int rank : {comm.rank() + 1, comm.rank() - 1})
    if (rank >= 0 && rank < comm.size())
      peers.push_back(rank);
  for (int round = 0; round < 12; ++round) {
    std::vector<Message> outgoing;
    for (const int peer : peers)
      if (!words(comm.rank(), peer, round).empty())
        outgoing.push_back({peer, words(comm.rank(), peer, round)});
    const std::vector<Message> incoming = exchange_among(comm, peers, outgoing);
    ASSERT_EQ(incoming.size(), peers.size());
    for (std::size_t k = 0; k < peers.size(); ++k) {
      EXPECT_EQ(incoming[k].peer, peers[k]);
      EXPECT_EQ(incoming[k].data, words(peers[k], comm.rank(), round));
    }
  }
}

/// Ranks beside a pair that talks are not waited for: here they do not even call.
TEST(Neighbours, OthersTakeNoPart) {
  const Communicator comm = Communicator::world();
  if (comm.rank() > 1 || comm.size() == 1)
    return;
  const std::vector<int> peers{1 - comm.rank()};
  comm.counters().take();
  EXPECT_EQ(exchange_among(comm, peers, {}).front().data.size(), 0u);
  const CounterValues counted = comm.counters().take();
  EXPECT_EQ(counted[Counter::messages], 1);
  EXPECT_EQ(counted[Counter::collectives], 0);
}

TEST(Neighbours, AreEachOthersNeighbours) {
  const Communicator comm = Communicator::world();
  Neighbours neighbours(comm);
  EXPECT_TRUE(neighbours.ranks().empty());
  std::vector<int> all_others(static_cast<std::size_t>(comm.size()));
  std::iota(all_others.begin(), all_others.end(), 0);
  std::erase(all_others, comm.rank());
  for (int time = 0; time < 2; ++time) { // nothing comes twice
    neighbours.add(comm.is_root() ? std::span<const int>(all_others) : std::span<const int>());
    if (comm.is_root())
      EXPECT_EQ(std::vector<int>(neighbours.ranks().begin(), neighbours.ranks().end()), all_others);
    else
      EXPECT_EQ(std::vector<int>(neighbours.ranks().begin(), neighbours.ranks().end()), std::vector<int>{0});
  }
  EXPECT_EQ(neighbours.contains(0), !comm.is_root());
  EXPECT_FALSE(neighbours.contains(comm.rank()));
  neighbours.add(all_others);
  EXPECT_EQ(std::vector<int>(neighbours.ranks().begin(), neighbours.ranks().end()), all_others);
}

TEST(Parcel, GivesListsBackInTheirOrder) {
  Parcel parcel;
  const std::vector<double> numbers{1, 2.5};
  const std::vector<std::int32_t> nothing, few{7};
  parcel.add(numbers);
  parcel.add(nothing);
  parcel.add(few);
  Parcel arrived(parcel.release());
  EXPECT_EQ(arrived.take<double>(), numbers);
  EXPECT_EQ(arrived.take<std::int32_t>(), nothing);
  EXPECT_EQ(arrived.take<std::int32_t>(), few);
  Parcel empty(std::vector<std::byte>{});
  EXPECT_TRUE(empty.take<double>().empty());
  EXPECT_TRUE(empty.take<std::int32_t>().empty());
}

} // namespace
} // namespace trime::comm
