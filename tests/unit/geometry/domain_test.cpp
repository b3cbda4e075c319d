// SPDX-License-Identifier: BSD-3-Clause
// A boundary and a container that do not belong together are refused, with a message that names the place.
#include "trime/geometry/boundary.hpp"

#include "support/boundary_shapes.hpp"
#include "support/periodic_shapes.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace trime::geometry {
namespace {

const Frame unit_frame(unit_square);

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "";
}

std::string error_of(const Frame& frame, const Boundary& boundary, const std::vector<std::int32_t>& markers = {}) {
  return error_of([&] { const Domain domain(frame, boundary, markers); });
}

bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

Boundary square(Vec2 min = {0.25, 0.25}, Vec2 max = {0.75, 0.75}) {
  return testing::boundary_of({testing::polygon_loop({min, {max.x, min.y}, max, {min.x, max.y}})});
}

TEST(Domain, KeepsWhatItIsMadeOf) {
  Domain domain(unit_frame, square());
  EXPECT_EQ(domain.boundary().loops.size(), 1u);
  EXPECT_EQ(domain.part_markers(), std::vector<std::int32_t>{0});
  EXPECT_EQ(Domain(unit_frame, square(), {7}).part_markers(), std::vector<std::int32_t>{7});
  domain.set_fixed_points({{{0.5, 0.5}, "here"}});
  EXPECT_EQ(domain.fixed_points().size(), 1u);
}

TEST(Domain, TakesEveryBoundaryThatAShapeMakes) {
  for (const shape::RegionShape& shape : testing::periodic_shapes())
    EXPECT_EQ(error_of(shape.frame(), shape.boundary()), "");
  EXPECT_EQ(error_of(unit_frame, testing::boundary_of({testing::circle_loop({0.5, 0.5}, 0.5)})), "");
}

TEST(Domain, RefusesABoundaryThatLeavesTheContainer) {
  const std::string error = error_of(unit_frame, square({0.25, 0.25}, {1.5, 0.75}));
  EXPECT_TRUE(says(error, "leaves the container [0, 1] x [0, 1]")) << error;
  EXPECT_TRUE(says(error, "found the point (1.5, 0.25) of loop 1")) << error;
  const std::string arc =
      error_of(unit_frame, testing::boundary_of({testing::circle_loop({0.5, 0.875}, 0.25, false, 1)}));
  EXPECT_TRUE(says(arc, "leaves the container")) << "an arc can leave it between its ends; " << arc;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Boundary broken = square();
  broken.loops[0].pieces[0].start.x = nan;
  EXPECT_TRUE(says(error_of(unit_frame, broken), "leaves the container"));
}

TEST(Domain, RefusesABoundaryOfAnotherLattice) {
  const Frame wide({{0, 0}, {1000, 500}});
  Boundary fine = square();
  fine.loops[0].pieces[0].start.x = fine.loops[0].pieces[3].end.x += unit_frame.step();
  EXPECT_EQ(error_of(unit_frame, fine), "");
  const std::string error = error_of(wide, fine);
  EXPECT_TRUE(says(error, "does not belong to the container [0, 1000] x [0, 500]")) << error;
  EXPECT_TRUE(says(error, "expected vertices on its lattice")) << error;
}

TEST(Domain, RefusesOtherPeriods) {
  const std::string missing = error_of(testing::unit_torus(), square());
  EXPECT_TRUE(says(missing, "expected the periods (1, 1) of the container, found (0, 0)")) << missing;
  EXPECT_TRUE(says(error_of(unit_frame, testing::band().boundary()), "expected the periods (0, 0)"));
}

TEST(Domain, RefusesAnOpenLoop) {
  Boundary open = square();
  open.loops[0].pieces.pop_back();
  const std::string error = error_of(unit_frame, open);
  EXPECT_TRUE(says(error, "loop 1 of the boundary is not closed")) << error;
  EXPECT_TRUE(says(error, "start at (0.25, 0.75), found (0.25, 0.25)")) << error;
}

TEST(Domain, RefusesPartsWithoutAName) {
  Boundary other = square();
  other.loops[0].pieces[1].part = 1;
  EXPECT_TRUE(says(error_of(unit_frame, other), "names part 1, but the boundary has 1 names of parts"));
  EXPECT_TRUE(says(error_of(unit_frame, square(), {1, 2}), "a marker for each of the 1 parts"));
}

TEST(Frame, RefusesAContainerWithoutArea) {
  EXPECT_TRUE(says(error_of([] { const Frame frame({{0, 0}, {1, 0}}); }), "found [0, 1] x [0, 0]"));
  EXPECT_TRUE(says(error_of([] { const Frame frame(Box{}); }), "positive and finite"));
}

/// The parts of a shape know no frame; they must fit that of the shape.
TEST(Domain, AShapeRefusesPartsOfAnotherFrame) {
  using shape::Part;
  using shape::RegionShape;
  const Frame wide({{0, 0}, {1000, 500}});
  const Part far = Part::rectangle("plate", {{50, 50}, {950, 450}}, wide);
  const std::string reach = error_of([&] { const RegionShape shape({far}, "plate", unit_frame); });
  EXPECT_TRUE(says(reach, "part 'plate' was made in another frame: expected points within twice the size of the "
                          "container [0, 1] x [0, 1], found (950, 50)") ||
              says(reach, "found (50, 50)"))
      << reach;
  for (const Part& fine :
       {Part::rectangle("p", {{0.1, 0.1}, {0.9, 0.9}}, unit_frame), Part::circle("p", {0.5, 0.5}, 0.1, unit_frame)}) {
    const std::string lattice = error_of([&] { const RegionShape shape({fine}, "p", wide); });
    EXPECT_TRUE(says(lattice, "part 'p' was made in another frame: expected points on the lattice")) << lattice;
  }
  const Part coarse = Part::rectangle("p", {{1, 1}, {2, 2}}, wide); // on the finer lattice, too
  EXPECT_EQ(error_of([&] { const RegionShape shape({coarse}, "p", Frame({{0, 0}, {3, 3}})); }), "");
}

} // namespace
} // namespace trime::geometry
