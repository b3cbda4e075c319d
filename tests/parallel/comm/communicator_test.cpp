// SPDX-License-Identifier: BSD-3-Clause
// The few collectives that the program uses, on any number of ranks.
#include "comm/agree.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace trime::comm {
namespace {

TEST(Communicator, ReducesAndScans) {
  const Communicator comm = Communicator::world();
  const std::int64_t n = comm.size();
  EXPECT_EQ(comm.sum(std::int64_t{comm.rank()}), n * (n - 1) / 2);
  EXPECT_EQ(comm.max(std::int64_t{comm.rank()}), n - 1);
  const std::int64_t rank = comm.rank();
  EXPECT_EQ(comm.exclusive_scan(2), 2 * rank);
  EXPECT_EQ(comm.exclusive_scan(rank * rank), (rank - 1) * rank * (2 * rank - 1) / 6); // of squares below rank^2
  EXPECT_EQ(comm.all_gather(std::int64_t{comm.rank()}).back(), n - 1);
}

TEST(Communicator, BroadcastsAndGathersTextsOfAnyLength) {
  const Communicator comm = Communicator::world();
  const std::string text = comm.broadcast(comm.is_root() ? std::string("a\0b", 3) : "other", 0);
  EXPECT_EQ(text, std::string("a\0b", 3));
  const std::vector<std::string> all = comm.gather(std::string(static_cast<std::size_t>(comm.rank()), 'x'));
  ASSERT_EQ(all.size(), comm.is_root() ? static_cast<std::size_t>(comm.size()) : 0u);
  for (std::size_t rank = 0; rank < all.size(); ++rank)
    EXPECT_EQ(all[rank].size(), rank);
}

TEST(Communicator, ExchangesWithPeersThatDoNotKnowEachOther) {
  const Communicator comm = Communicator::world();
  std::vector<Message> outgoing;
  for (int peer = 0; peer < comm.rank(); ++peer) { // each rank writes to all lower ranks
    const std::vector<int> values(static_cast<std::size_t>(peer), comm.rank());
    outgoing.push_back({peer, to_bytes(std::span<const int>(values))});
  }
  const std::vector<Message> incoming = comm.exchange_any(outgoing);
  ASSERT_EQ(static_cast<int>(incoming.size()), comm.size() - 1 - comm.rank());
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    EXPECT_EQ(incoming[k].peer, comm.rank() + 1 + static_cast<int>(k));
    const std::vector<int> values = from_bytes<int>(incoming[k].data);
    EXPECT_EQ(values, std::vector<int>(static_cast<std::size_t>(comm.rank()), incoming[k].peer));
  }
}

TEST(Agree, AllRanksThrowTheErrorOfTheLowestFailingRank) {
  const Communicator comm = Communicator::world();
  const int failing = comm.size() - 1;
  EXPECT_NO_THROW(agree(comm, std::nullopt));
  try {
    run_agreed(comm, [&] {
      if (comm.rank() >= failing)
        throw FileError("disk full");
    });
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::file);
    EXPECT_EQ(std::string(error.what()), failing == 0 ? "disk full" : fmt::format("disk full (rank {})", failing));
  }
}

TEST(Agree, AllRanksKnowThePlacesOfTheError) {
  const Communicator comm = Communicator::world();
  struct {
    double x = 1.0 / 3, y = 0.5;
  } const place;
  try {
    run_agreed(comm, [&] {
      if (comm.rank() == comm.size() - 1)
        throw GeometryError(fmt::format("too near at {}", Place(place, 3)));
    });
    ADD_FAILURE() << "no error was thrown";
  } catch (const GeometryError& error) {
    ASSERT_EQ(error.message().places().size(), 1u);
    EXPECT_EQ(error.message().places()[0].x, place.x);
    EXPECT_EQ(error.message().text().substr(0, error.message().places()[0].end), "too near at (0.333, 0.5)");
  }
}

TEST(Agree, WhatIsNoStandardExceptionEndsAllRanksToo) {
  const Communicator comm = Communicator::world();
  try {
    run_agreed(comm, [&] {
      if (comm.rank() == comm.size() - 1)
        throw 42; // NOLINT(hicpp-exception-baseclass)
    });
    ADD_FAILURE() << "no error was thrown";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("not a std::exception"), std::string::npos) << error.what();
  }
  comm.barrier();
}

} // namespace
} // namespace trime::comm
