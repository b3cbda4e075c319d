// SPDX-License-Identifier: BSD-3-Clause
// Sizes that fall to nearly nothing on a line: the boundary is simplified on both sides of it, but not across it.
#include "support/plain_shapes.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace trime::meshing {
namespace {

using geometry::Vec2;
using shape::Part;
using testing::mesh_silently;
using testing::unit_frame;

/// A bar with a long spit, narrower than most of the sizes.
shape::RegionShape bar_with_spit() {
  return shape::RegionShape({Part::rectangle("bar", {{0.1, 0.1}, {0.3, 0.9}}, unit_frame()),
                             Part::triangle("spit", {Vec2{0.2, 0.4}, {0.2, 0.44}, {0.9, 0.45}}, unit_frame())},
                            "union(bar, spit)", unit_frame());
}

/// Valleys with walls steeper than triangles can follow, on parallel lines. Counts how often it is asked.
class Valleys final : public sizing::SizeField {
public:
  explicit Valleys(Vec2 across, double least = 1e-3) : across_(across), least_(least) {}
  double size(Vec2 p) const override {
    asked_.fetch_add(1, std::memory_order_relaxed);
    return std::fabs(std::sin(geometry::dot(across_, p))) + least_;
  }
  std::int64_t asked() const { return asked_; }

private:
  Vec2 across_;
  double least_;
  mutable std::atomic<std::int64_t> asked_ = 0;
};

mesh::Check generalisation_of(const MeshResult& result) {
  const auto found = std::ranges::find(result.checks, "generalisation", &mesh::Check::name);
  return found == result.checks.end() ? mesh::Check{} : *found;
}

TEST(SteepSize, TheBoundaryStaysAsNearAsTheSizeInAValleyAsks) {
  for (const Vec2 across : {Vec2{50, 0}, Vec2{25, 10}})
    for (const GlobalId points : {200, 400}) {
      SCOPED_TRACE(::testing::Message() << across.x << ", " << points << " points");
      MeshOptions options;
      options.points = points;
      options.max_sweeps = 20;
      const MeshResult result =
          mesh_silently(comm::Communicator::world(), bar_with_spit().domain(), Valleys(across), options);
      const mesh::Check check = generalisation_of(result);
      EXPECT_TRUE(check.passed) << check.found << " of " << check.expected;
      testing::expect_certified(result);
    }
}

/// Simplified by less than the usual distance, the boundary is still simplified: it is not left as it was.
TEST(SteepSize, ASmallerDistanceLeavesLessButSimplifiesAllTheSame) {
  for (const double within : {0.5, 0.1}) {
    SCOPED_TRACE(within);
    MeshOptions options;
    options.points = 400;
    options.max_sweeps = 20;
    options.features.within = within;
    const MeshResult result =
        mesh_silently(comm::Communicator::world(), bar_with_spit().domain(), Valleys({25, 10}), options);
    const mesh::Check check = generalisation_of(result);
    EXPECT_TRUE(check.passed) << check.found << " of " << check.expected;
    testing::expect_certified(result);
  }
}

TEST(SteepSize, NarrowValleysAreNotLookedIntoToTheirGround) {
  const Valleys narrow({50, 0}, 1e-7);
  const shape::RegionShape bar({Part::rectangle("bar", {{0.1, 0.3}, {0.9, 0.7}}, unit_frame())}, "bar", unit_frame());
  MeshOptions options;
  options.points = 400;
  options.max_sweeps = 20;
  mesh_silently(comm::Communicator::world(), bar.domain(), narrow, options);
  EXPECT_LT(narrow.asked(), 20'000'000); // 6e8 where trials with far too many sites are counted to the end
}

TEST(SteepSize, AnEdgeLengthBoundsThePlacesThatAreFollowed) {
  const Valleys narrow({50, 0}, 1e-7);
  const shape::RegionShape bar({Part::rectangle("bar", {{0.1, 0.3}, {0.9, 0.7}}, unit_frame())}, "bar", unit_frame());
  MeshOptions options;
  options.edge_length = 0.2;
  options.gradation = 1;
  options.max_sweeps = 5;
  mesh_silently(comm::Communicator::world(), bar.domain(), narrow, options);
  EXPECT_LT(narrow.asked(), 20'000'000);
}

} // namespace
} // namespace trime::meshing
