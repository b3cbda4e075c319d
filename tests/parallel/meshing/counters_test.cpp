// SPDX-License-Identifier: BSD-3-Clause
// What a run counts adds up: whatever is work on sites is the same on any ranks, and alone a rank sends nothing.
#include "app/measurements.hpp"
#include "support/plain_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::meshing {
namespace {

using app::Measurements;

struct CountedRun {
  MeshResult result;
  Measurements measured;
};

CountedRun run(const comm::Communicator& comm, MeshOptions options) {
  options.points = 3000;
  options.max_sweeps = 30;
  Log log(LogLevel::silent, false);
  TimerTable timers(&comm.counters());
  comm.counters().take(); // of earlier tests
  const sizing::UniformSize size;
  const shape::RegionShape shape = testing::disc_with_hole();
  CountedRun counted{Mesher(comm, shape.domain(), size, options, log, timers).run(), {}};
  counted.measured = app::gather_measurements(timers, comm);
  return counted;
}

bool has_phase(const CountedRun& run, const std::string& name) {
  return std::ranges::find(run.measured.phases, name, &app::Phase::name) != run.measured.phases.end();
}

TEST(Counters, EverySiteIsSweptOrAsleepInEveryPass) {
  MeshOptions options;
  options.start = start::Start::lattice; // one stage
  options.cleanup = false;
  const CountedRun counted = run(comm::Communicator::world(), options);
  const app::CounterSpreads& all = counted.measured.counters;
  for (const sweep::SweepRecord& record : counted.result.history)
    ASSERT_EQ(record.points, counted.result.mesh.point_slab.total) << "this test needs a run that deletes nothing";
  EXPECT_EQ(all[Counter::passes].min, all[Counter::passes].max);
  EXPECT_GT(all[Counter::passes].max, counted.result.history.back().sweep);
  EXPECT_EQ(all[Counter::sites_swept].sum + all[Counter::sites_slept].sum,
            all[Counter::passes].max * counted.result.mesh.point_slab.total);
  EXPECT_EQ(all[Counter::sites_started].sum, counted.result.mesh.point_slab.total);
  EXPECT_EQ(all[Counter::sites_extracted].sum, counted.result.mesh.point_slab.total);
  EXPECT_LT(0, all[Counter::sites_moved].sum);
  EXPECT_LE(all[Counter::sites_moved].sum, all[Counter::sites_swept].sum);
  EXPECT_GE(all[Counter::stars_by_emptiness].sum, counted.result.mesh.point_slab.total) << "the first ones";
  EXPECT_LE(all[Counter::stars_rebuilt].sum, all[Counter::stars_by_emptiness].sum);
}

TEST(Counters, TheWorkOnSitesIsTheSameOnAnyRanks) {
  const comm::Communicator world = comm::Communicator::world();
  const CountedRun together = run(world, {}), alone = run(comm::Communicator::self(), {});
  for (const Counter counter : {Counter::sites_started, Counter::sites_swept, Counter::sites_slept,
                                Counter::sites_moved, Counter::patches, Counter::sites_extracted})
    EXPECT_EQ(together.measured.counters[counter].sum, alone.measured.counters[counter].sum) << name_of(counter).name;
  for (const Counter counter : {Counter::passes, Counter::cleanup_rounds, Counter::densest_tile})
    EXPECT_EQ(together.measured.counters[counter].max, alone.measured.counters[counter].max) << name_of(counter).name;
  EXPECT_EQ(together.measured.counters[Counter::patches].sum, together.result.cleanup.patches);
}

TEST(Counters, TellWhatRanksHoldOfEachOther) {
  const comm::Communicator world = comm::Communicator::world();
  const CountedRun counted = run(world, {});
  const app::CounterSpreads& all = counted.measured.counters;
  if (world.size() == 1) {
    for (const Counter counter : {Counter::messages, Counter::bytes, Counter::neighbours, Counter::ghosts,
                                  Counter::sites_migrated, Counter::fetch_rounds})
      EXPECT_EQ(all[counter].sum, 0) << name_of(counter).name;
    return;
  }
  EXPECT_GT(all[Counter::ghosts].min, 0);
  EXPECT_LT(all[Counter::ghosts].max, counted.result.mesh.point_slab.total);
  EXPECT_GE(all[Counter::neighbours].min, 1);
  EXPECT_LT(all[Counter::neighbours].max, world.size());
  EXPECT_GE(all[Counter::bytes].sum, 8 * all[Counter::messages].sum / 2); // a size of 8 bytes, and what it announces
  EXPECT_EQ(all[Counter::fetch_rounds].min, all[Counter::fetch_rounds].max) << "ranks fetch together";
}

/// app/run_limit.cpp goes by these names.
TEST(Counters, ThePhasesHaveTheNamesThatTheReportGoesBy) {
  const CountedRun counted = run(comm::Communicator::world(), {});
  for (const char* name : {"boundary", "start", "sweeps", "clean-up"})
    EXPECT_TRUE(has_phase(counted, name)) << name;
}

TEST(Counters, TellOfTablesThatEveryRankHolds) {
  const comm::Communicator world = comm::Communicator::world();
  const CountedRun counted = run(world, {});
  const app::CounterSpreads& all = counted.measured.counters;
  for (const Counter counter : {Counter::grid_bytes, Counter::boundary_bytes, Counter::rank_bytes}) {
    EXPECT_GT(all[counter].min, 0) << name_of(counter).name;
    EXPECT_LT(all[counter].max, 1 << 20) << name_of(counter).name;
  }
  EXPECT_GE(all[Counter::rank_bytes].min, static_cast<std::int64_t>(sizeof(std::int64_t)) * world.size());
  EXPECT_EQ(all[Counter::size_bytes].max, 0) << "a uniform size has no table";
}

} // namespace
} // namespace trime::meshing
