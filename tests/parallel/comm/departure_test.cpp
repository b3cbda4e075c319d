// SPDX-License-Identifier: BSD-3-Clause
#include "comm/agree.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace trime::comm {
namespace {

TEST(Departure, AllArriveThoughOneIsLate) {
  const Communicator leaving = Communicator::world();
  if (leaving.rank() == leaving.size() - 1)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(all_arrive(leaving, 60));
}

TEST(Departure, OneThatIsAloneIsTold) {
  const Communicator world = Communicator::world(), leaving = Communicator::world();
  if (world.is_root() && world.size() > 1) {
    EXPECT_FALSE(all_arrive(leaving, 0.05));
  }
  world.barrier();        // where the others wait meanwhile
  if (!world.is_root()) { // late, so that the first barrier of this communicator ends and it can be freed
    EXPECT_TRUE(all_arrive(leaving, 60));
  }
  world.barrier();
}

} // namespace
} // namespace trime::comm
