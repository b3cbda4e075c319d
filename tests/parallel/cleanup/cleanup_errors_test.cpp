// SPDX-License-Identifier: BSD-3-Clause
// An error that one rank meets in a round of the clean-up reaches all ranks, and none waits for ever.
#include "cleanup/cleanup.hpp"

#include "support/boundary_shapes.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"
#include "support/periodic_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <set>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using sites::Stage;
using testing::unit_lattice;

constexpr double h = 0.03;

/// A field that fails from some time on at places that nobody has asked for before: those to which a patch moves sites.
class FailingSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override {
    const std::lock_guard lock(mutex_);
    if (const bool is_new = asked_.insert({p.x, p.y}).second; is_new && fails)
      throw GeometryError("the size fails here");
    return h;
  }
  bool fails = false;

private:
  mutable std::mutex mutex_;
  mutable std::set<std::pair<double, double>> asked_;
};

/// Random sites on the torus, far from any good mesh.
Stage torus_stage(const comm::Communicator& comm, const shape::RegionShape& torus, const sizing::SizeField& size) {
  Stage stage;
  stage.scaled_size = std::make_unique<sizing::ScaledSize>(size, 1);
  stage.size = std::make_unique<sizing::ScaledSize>(size, 1);
  stage.polygon = testing::make_boundary_sites(torus.boundary(), sizing::UniformSize(h), unit_lattice(), 30);
  stage.guard = std::make_unique<polygon::BoundaryGuard>(stage.polygon, unit_lattice());
  stage.state = std::make_unique<sites::SiteState>(comm, geometry::Box{{0, 0}, {1, 1}},
                                                   mesh::GridOptions{{}, {}, h, torus.boundary().periods});
  stage.state->distribute(testing::dealt(comm, testing::random_sites(1200, 5)));
  return stage;
}

TEST(CleanupErrors, OfOneRankReachAll) {
  const comm::Communicator world = comm::Communicator::world();
  const shape::RegionShape torus = testing::whole_torus();
  const delaunay::StarBuilder builder(unit_lattice(), 0.3);
  for (int failing = 0; failing <= world.size(); ++failing) { // at last none
    FailingSize size;
    Stage stage = torus_stage(world, torus, size);
    const auto compute_stars = [&] { stage.state->compute_stars(builder, *stage.size, sites::Wanted::all_sites); };
    compute_stars();
    compute_stars(); // with ghosts that were fetched on the way
    size.fails = world.rank() == failing;
    compute_stars(); // as `mend` does at first: no new places
    const auto run = [&] { return mend(stage, torus.boundary(), unit_lattice(), builder, {}); };
    if (failing < world.size()) {
      try {
        run();
        ADD_FAILURE() << "rank " << failing << " did not fail";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::geometry);
        EXPECT_NE(std::string(error.what()).find("the size fails here"), std::string::npos);
      }
    } else {
      EXPECT_GT(run().better, 0);
    }
  }
}

} // namespace
} // namespace trime::cleanup
