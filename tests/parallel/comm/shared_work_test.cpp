// SPDX-License-Identifier: BSD-3-Clause
// Work that ranks share and whose results every rank needs.
#include "comm/agree.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace trime::comm {
namespace {

TEST(SharedWork, GivesEveryRankTheSameList) {
  const Communicator comm = Communicator::world();
  for (const std::ptrdiff_t n : {0, 1, 5, 1000}) {
    const std::vector<int> found = gather_shared<int>(comm, n, 3, [](std::ptrdiff_t k, std::vector<int>& list) {
      for (int copy = 0; copy < k % 3; ++copy)
        list.push_back(static_cast<int>(k));
    });
    std::vector<int> expected;
    for (std::ptrdiff_t k = 0; k < n; ++k)
      expected.insert(expected.end(), static_cast<std::size_t>(k % 3), static_cast<int>(k));
    EXPECT_EQ(found, expected) << n;
    const std::vector<double> squares = compute_shared<double>(
        comm, static_cast<std::size_t>(n), [](std::size_t k) { return static_cast<double>(k * k); });
    ASSERT_EQ(std::ssize(squares), n);
    for (std::size_t k = 0; k < squares.size(); ++k)
      EXPECT_EQ(squares[k], static_cast<double>(k * k));
  }
}

/// The share of the last rank fails; the others learn it by the gather that they wait in.
TEST(SharedWork, FailsOnAllRanksTogether) {
  const Communicator comm = Communicator::world();
  const std::ptrdiff_t n = 4 * comm.size();
  try {
    gather_shared<int>(comm, n, 2, [&](std::ptrdiff_t k, std::vector<int>&) {
      if (k == n - 1)
        throw GeometryError("no place for the last one");
    });
    FAIL() << "nothing was thrown";
  } catch (const GeometryError& e) {
    EXPECT_NE(std::string(e.what()).find("no place for the last one"), std::string::npos) << e.what();
  }
  EXPECT_EQ(comm.sum(std::int64_t{1}), comm.size()); // all have left the gather
}

/// One for the sizes, in which the errors travel, and one for the values.
TEST(SharedWork, TakesTwoCollectives) {
  const Communicator comm = Communicator::world();
  comm.counters().take();
  compute_shared<double>(comm, 5000, [](std::size_t k) { return static_cast<double>(k); });
  EXPECT_EQ(comm.counters().take()[Counter::collectives], comm.size() == 1 ? 0 : 2);
}

} // namespace
} // namespace trime::comm
