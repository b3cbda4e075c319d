// SPDX-License-Identifier: BSD-3-Clause
// Sites that sleep: the mesh is that of sweeps in which none does, and which of them sleep does not depend on ranks.
#include "app/measurements.hpp"
#include "support/distributed.hpp"
#include "support/plain_shapes.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trime::sweep {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Vec2;
using shape::Part;
using shape::RegionShape;

struct SleepRun {
  std::uint64_t hash;
  int sweeps;
  double mean_alpha;
  std::int64_t swept, slept; // over all ranks
};

enum class Stars { by_lemma, by_emptiness };

SleepRun run(const comm::Communicator& comm, const RegionShape& shape, Method method, bool sleepless = false,
             Stars stars = Stars::by_lemma) {
  meshing::MeshOptions options;
  options.points = 12000;
  options.method = method;
  options.max_sweeps = 30;
  options.cleanup = false;
  options.star_tests.sleepless = sleepless;
  options.star_tests.by_emptiness = stars == Stars::by_emptiness;
  Log log(LogLevel::silent, false);
  TimerTable timers(&comm.counters());
  comm.counters().take(); // of earlier tests
  const sizing::UniformSize size;
  const meshing::MeshResult result = meshing::Mesher(comm, shape.domain(), size, options, log, timers).run();
  const app::Measurements measured = app::gather_measurements(timers, comm);
  return {result.mesh.hash, result.history.back().sweep, result.history.back().mean_alpha,
          measured.counters[Counter::sites_swept].sum, measured.counters[Counter::sites_slept].sum};
}

struct Case {
  std::string name;
  Frame frame;
  std::vector<Part> parts;
  std::string region;
  Method method = Method::hybrid;
};

/// Inside, all of them are lattices, whose sites sleep.
std::vector<Case> cases() {
  const Frame unit(Box{{0, 0}, {1, 1}});
  const Part disc = Part::circle("d", {0.5, 0.5}, 0.45, unit), hole = Part::circle("h", {0.6, 0.55}, 0.1, unit);
  return {{"disc", unit, {disc}, "d"},
          {"ring by cells", unit, {disc, hole}, "difference(d, h)", Method::cvd},
          {"ring by bars", unit, {disc, hole}, "difference(d, h)", Method::distmesh}};
}

TEST(Sleep, TheMeshIsThatOfSweepsInWhichNothingSleeps) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const RegionShape shape(c.parts, c.region, c.frame);
    const SleepRun usual = run(comm::Communicator::world(), shape, c.method),
                   sleepless = run(comm::Communicator::world(), shape, c.method, true);
    EXPECT_EQ(usual.hash, sleepless.hash);
    EXPECT_EQ(usual.sweeps, sleepless.sweeps);
    EXPECT_EQ(usual.mean_alpha, sleepless.mean_alpha);
    EXPECT_LT(3 * usual.swept, 2 * sleepless.swept) << "many sites sleep";
    EXPECT_EQ(usual.swept + usual.slept, sleepless.swept + sleepless.slept);
  }
}

/// Even where the sets of stars that are certified by emptiness do.
TEST(Sleep, WhichSitesSleepDoesNotDependOnRanks) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const RegionShape shape(c.parts, c.region, c.frame);
    const SleepRun alone = run(comm::Communicator::self(), shape, c.method);
    for (const Stars stars : {Stars::by_lemma, Stars::by_emptiness}) {
      const SleepRun together = run(comm::Communicator::world(), shape, c.method, false, stars);
      EXPECT_EQ(together.hash, alone.hash);
      EXPECT_EQ(together.swept, alone.swept);
      EXPECT_EQ(together.slept, alone.slept);
    }
  }
}

} // namespace
} // namespace trime::sweep
