// SPDX-License-Identifier: BSD-3-Clause
// The exchanges and reductions of the communicator in their uglier cases.
#include "comm/agree.hpp"
#include "comm/parcel.hpp"
#include "support/distributed.hpp"
#include "trime/comm/communicator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace trime::comm {
namespace {

std::vector<std::byte> bytes_of(std::size_t n, int value) {
  return std::vector<std::byte>(n, static_cast<std::byte>(value));
}

TEST(Exchange, AnyTakesEmptyMessagesAndMessagesToOneself) {
  const Communicator comm = Communicator::world();
  std::vector<Message> outgoing{{comm.rank(), bytes_of(3, comm.rank())}};
  const int next = (comm.rank() + 1) % comm.size();
  if (next != comm.rank())
    outgoing.push_back({next, {}});
  const std::vector<Message> incoming = comm.exchange_any(outgoing);
  ASSERT_EQ(incoming.size(), outgoing.size());
  for (const Message& message : incoming)
    EXPECT_EQ(message.data, message.peer == comm.rank() ? bytes_of(3, comm.rank()) : bytes_of(0, 0));
}

TEST(Exchange, ManyRoundsOfAnyDoNotMix) {
  const Communicator comm = Communicator::world();
  for (int round = 0; round < 50; ++round) {
    std::vector<Message> outgoing;
    for (int peer = 0; peer < comm.size(); ++peer)
      if ((peer + round) % 3 != comm.rank() % 3)
        outgoing.push_back({peer, bytes_of(static_cast<std::size_t>(round + peer), round)});
    for (const Message& message : comm.exchange_any(outgoing))
      EXPECT_EQ(message.data, bytes_of(static_cast<std::size_t>(round + comm.rank()), round));
  }
}

/// A step sends a bundle in one message or in two: all sizes around that of the head, and much longer bundles.
TEST(Exchange, AnyMovesBundlesAroundTheSizeOfAHead) {
  const Communicator comm = Communicator::world();
  for (std::size_t n = head_bytes - 40; n < head_bytes + 8; ++n) {
    std::vector<Message> outgoing;
    for (int peer = 0; peer < comm.size(); ++peer)
      if ((peer + static_cast<int>(n)) % 2 == 0 || peer == (comm.rank() + 1) % comm.size())
        outgoing.push_back({peer, bytes_of(n, comm.rank() + 1)});
    for (const Message& message : comm.exchange_any(outgoing))
      EXPECT_EQ(message.data, bytes_of(n, message.peer + 1));
  }
}

TEST(Exchange, KnownMovesLongMessagesBetweenNeighboursOnly) {
  const Communicator comm = Communicator::world();
  const std::size_t n = 300000; // beyond any eager limit
  std::vector<Message> outgoing, incoming;
  for (const int peer : {comm.rank() - 1, comm.rank() + 1})
    if (peer >= 0 && peer < comm.size()) {
      outgoing.push_back({peer, bytes_of(n + static_cast<std::size_t>(comm.rank()), comm.rank())});
      incoming.push_back({peer, bytes_of(n + static_cast<std::size_t>(peer), 99)});
    }
  comm.exchange_known(outgoing, incoming);
  for (const Message& message : incoming)
    EXPECT_EQ(message.data, bytes_of(n + static_cast<std::size_t>(message.peer), message.peer));
  comm.exchange_known({}, {}); // nobody to talk to
}

TEST(Communicator, ReducesEveryElementAndNothing) {
  const Communicator comm = Communicator::world();
  const int n = comm.size();
  std::array<std::int64_t, 2> counts{1, comm.rank()};
  comm.sum(counts);
  EXPECT_EQ(counts[0], n);
  EXPECT_EQ(counts[1], n * (n - 1) / 2);
  std::array<double, 2> low{0.5 * comm.rank(), INFINITY}, high{0.5 * comm.rank(), -INFINITY};
  comm.min(low);
  comm.max(high);
  EXPECT_EQ(low[0], 0);
  EXPECT_EQ(high[0], 0.5 * (n - 1));
  EXPECT_EQ(low[1], INFINITY);
  comm.sum(std::span<std::int64_t>());
  EXPECT_EQ(comm.exclusive_scan(std::int64_t{1} << 40), (std::int64_t{1} << 40) * comm.rank());
}

TEST(Communicator, BroadcastsFromAnyRank) {
  const Communicator comm = Communicator::world();
  for (int root = 0; root < comm.size(); ++root)
    EXPECT_EQ(comm.broadcast(comm.rank() == root ? std::string(100000, 'r') : "", root), std::string(100000, 'r'));
  EXPECT_EQ(comm.broadcast("", comm.size() - 1), "");
}

TEST(Communicator, SelfIsAloneAndMovable) {
  Communicator self = Communicator::self();
  EXPECT_EQ(self.size(), 1);
  EXPECT_TRUE(self.is_root());
  EXPECT_EQ(self.sum(std::int64_t{7}), 7);
  EXPECT_EQ(self.exclusive_scan(7), 0);
  Communicator other = std::move(self);
  EXPECT_EQ(other.max(2.5), 2.5);
  other = Communicator::self();
  EXPECT_EQ(other.exchange_any({}).size(), 0u);
}

TEST(Agree, EveryKindOfExceptionBecomesAnErrorWithItsExitCodeOnAllRanks) {
  const Communicator comm = Communicator::world();
  const int failing = comm.size() / 2;
  const auto code_of = [&](auto thrower) {
    try {
      run_agreed(comm, [&] {
        if (comm.rank() == failing)
          thrower();
      });
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::done;
  };
  EXPECT_EQ(code_of([] { throw GeometryError("g"); }), ExitCode::geometry);
  EXPECT_EQ(code_of([] { throw ConfigError("c"); }), ExitCode::usage);
  EXPECT_EQ(code_of([] { throw std::bad_alloc(); }), ExitCode::out_of_memory);
  EXPECT_EQ(code_of([] { throw std::out_of_range("o"); }), ExitCode::internal_error);
  EXPECT_EQ(code_of([] {}), ExitCode::done);
}

TEST(Agree, OfSeveralErrorsTheLowestRankWins) {
  const Communicator comm = Communicator::world();
  try {
    run_agreed(comm, [&] { throw FileError(fmt::format("rank {}", comm.rank())); });
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "rank 0");
  }
}

TEST(Exchange, AllBytesComeToAllRanksInTheirOrder) {
  const Communicator comm = Communicator::world();
  const auto share = [](int rank) { return rank % 3 == 1 ? std::size_t{0} : static_cast<std::size_t>(5 * rank + 3); };
  for (const std::size_t times : {std::size_t{0}, std::size_t{1}, std::size_t{10000}}) {
    std::vector<std::byte> expected;
    for (int rank = 0; rank < comm.size(); ++rank) {
      const std::vector<std::byte> theirs = bytes_of(times * share(rank), rank + 1);
      expected.insert(expected.end(), theirs.begin(), theirs.end());
    }
    const std::vector<std::byte> own = bytes_of(times * share(comm.rank()), comm.rank() + 1);
    EXPECT_EQ(comm.all_gather(std::span<const std::byte>(own)), expected) << times;
  }
}

} // namespace
} // namespace trime::comm
