// SPDX-License-Identifier: BSD-3-Clause
// What the ranks have measured and counted comes together whole, in few collectives.
#include "app/measurements.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

TEST(Measurements, TheTimesAddUpOverRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  TimerTable timers;
  timers.add("stars", 0.001 * (1 + comm.rank()));
  if (comm.rank() == 1)
    timers.add("known to rank 1 only", 0.001);
  const Measurements measured = gather_measurements(timers, comm);
  ASSERT_EQ(measured.phases.size(), 2u);
  EXPECT_EQ(measured.phases[1].name, "other");
  EXPECT_DOUBLE_EQ(measured.phases[0].min, 0.001);
  EXPECT_DOUBLE_EQ(measured.phases[0].max, 0.001 * comm.size());
  EXPECT_NEAR(measured.phases[0].mean, 0.0005 * (1 + comm.size()), 1e-6);
  EXPECT_DOUBLE_EQ(measured.phases[0].mean + measured.phases[1].mean, measured.total);
  EXPECT_DOUBLE_EQ(measured.share("stars"), measured.phases[0].mean / measured.total);
  EXPECT_EQ(measured.share("no such phase"), 0);
  EXPECT_GE(measured.memory_sum, measured.peak_memory);
  EXPECT_GT(measured.peak_memory, 1 << 20);
}

TEST(Measurements, CountersAreToldByPhaseAndForTheWholeRun) {
  const comm::Communicator comm = comm::Communicator::world();
  TimerTable timers(&comm.counters());
  const auto count = [&](std::int64_t sites, std::int64_t ghosts) {
    comm.counters().add(Counter::sites_swept, sites);
    comm.counters().note(Counter::ghosts, ghosts);
  };
  {
    const auto time = timers.scope("sweeps");
    count(100 * (1 + comm.rank()), 10);
  }
  if (comm.rank() == comm.size() - 1) { // a phase of this rank alone counts as "other", unless it is rank 0
    const auto time = timers.scope("alone");
    count(5, 20);
  }
  count(1, 15);
  const Measurements measured = gather_measurements(timers, comm);
  const std::int64_t n = comm.size();
  const Spread& swept = measured.phases[0].counters[Counter::sites_swept];
  EXPECT_EQ(swept.sum, 50 * n * (n + 1));
  EXPECT_EQ(swept.min, 100);
  EXPECT_EQ(swept.max, 100 * n);
  EXPECT_EQ(measured.phases[0].counters[Counter::ghosts].max, 10);
  EXPECT_EQ(measured.phases.back().counters[Counter::sites_swept].sum, n + (n > 1 ? 5 : 0));
  EXPECT_EQ(measured.counters[Counter::sites_swept].sum, 50 * n * (n + 1) + n + 5);
  EXPECT_EQ(measured.counters[Counter::ghosts].max, 20);
  EXPECT_EQ(measured.counters[Counter::ghosts].min, n > 1 ? 15 : 20);
  EXPECT_EQ(measured.counters[Counter::ghosts].sum, 15 * (n - 1) + 20) << "the largest of each rank";
  EXPECT_DOUBLE_EQ(measured.imbalance(Counter::ghosts), 20.0 / measured.mean(Counter::ghosts));
  EXPECT_EQ(measured.imbalance(Counter::patches), 1) << "nothing was counted";
}

TEST(Measurements, TrafficIsWhatGoesToOtherRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  TimerTable timers(&comm.counters());
  {
    const auto time = timers.scope("talk");
    std::vector<comm::Message> outgoing, incoming;
    const auto bytes_of = [](int rank) { return std::vector<std::byte>(static_cast<std::size_t>(100 * rank)); };
    if (!comm.is_root())
      outgoing.push_back({0, bytes_of(comm.rank())});
    for (int rank = 1; comm.is_root() && rank < comm.size(); ++rank)
      incoming.push_back({rank, bytes_of(rank)});
    comm.exchange_known(outgoing, incoming);
    comm.all_gather(std::int64_t{1});
  }
  const Measurements measured = gather_measurements(timers, comm);
  const CounterSpreads& talk = measured.phases[0].counters;
  const int others = comm.size() - 1;
  EXPECT_EQ(talk[Counter::messages].sum, others);
  EXPECT_EQ(talk[Counter::messages].min, 0);
  EXPECT_EQ(talk[Counter::bytes].sum, 50 * others * comm.size());
  EXPECT_EQ(talk[Counter::collectives].max, 1);
  EXPECT_GT(talk[Counter::wait_ns].min, 0);
  EXPECT_LE(static_cast<double>(talk[Counter::wait_ns].max), 1e9 * measured.phases[0].max) << "nobody waits longer";
  EXPECT_EQ(talk[Counter::neighbours].sum, others);
  EXPECT_EQ(talk[Counter::neighbours].max, others > 0 ? 1 : 0);
  EXPECT_EQ(talk[Counter::rank_bytes].max, comm.size() * static_cast<std::int64_t>(sizeof(std::int64_t)));
}

TEST(Measurements, TakeAsManyCollectivesForManyPhasesAsForOne) {
  const comm::Communicator comm = comm::Communicator::world();
  const auto collectives = [&](int phases) {
    TimerTable timers;
    for (int k = 0; k < phases; ++k)
      timers.add("phase " + std::to_string(k), 1);
    comm.counters().take();
    EXPECT_EQ(std::ssize(gather_measurements(timers, comm).phases), phases + 1);
    return comm.counters().take()[Counter::collectives];
  };
  EXPECT_EQ(collectives(40), collectives(1));
}

} // namespace
} // namespace trime::app
