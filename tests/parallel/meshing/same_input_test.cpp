// SPDX-License-Identifier: BSD-3-Clause
// Ranks whose shapes or sizes differ in a last bit are found before they wait for each other.
#include "meshing/same_input.hpp"

#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace trime::meshing {
namespace {

const comm::Communicator& world() {
  static const comm::Communicator& comm = *new comm::Communicator(comm::Communicator::world()); // until MPI has ended
  return comm;
}

bool is_last() {
  return world().size() > 1 && world().rank() == world().size() - 1;
}

const geometry::Frame frame(geometry::unit_square);

geometry::Boundary disc() {
  return shape::RegionShape({shape::Part::circle("disc", {0.5, 0.5}, 0.3, frame)}, "disc", frame).boundary();
}

std::string error_of(const geometry::Domain& domain, const sizing::SizeField& size) {
  try {
    check_same_input(domain, size, world());
    return "";
  } catch (const InternalError& error) {
    return error.what();
  }
}

TEST(SameInput, OfAllRanksIsAccepted) {
  EXPECT_EQ(error_of({frame, disc()}, sizing::UniformSize(0.1)), "");
}

/// A checkpoint is refused by these hashes.
TEST(SameInput, ThePartsTheCornersAndTheFixedPointsCount) {
  const sizing::UniformSize size(0.1);
  geometry::Boundary whole = disc();
  whole.part_names.emplace_back("other");
  const std::int64_t hash = check_same_input({frame, whole}, size, world()).shape;
  EXPECT_EQ(check_same_input({frame, disc()}, size, world()).shape, hash);
  geometry::Boundary other = whole;
  other.loops[0].pieces[0].part = 1;
  EXPECT_NE(check_same_input({frame, other}, size, world()).shape, hash);
  other = whole;
  other.loops[0].pieces[0].corner = true;
  EXPECT_NE(check_same_input({frame, other}, size, world()).shape, hash);
  geometry::Domain fixed(frame, whole);
  fixed.set_fixed_points({{{0.5, 0.5}, "here"}});
  EXPECT_NE(check_same_input(fixed, size, world()).shape, hash);
}

TEST(SameInput, AFixedPointOfOneRankIsFound) {
  geometry::Domain domain(frame, disc());
  if (is_last())
    domain.set_fixed_points({{{0.5, 0.5}, "here"}});
  EXPECT_EQ(error_of(domain, sizing::UniformSize(0.1)).empty(), world().size() == 1);
}

TEST(SameInput, AnotherContainerOnOneRankIsFound) {
  const geometry::Frame wider({{0, 0}, {is_last() ? 1.25 : 1, 1}}); // the same lattice
  EXPECT_EQ(error_of({wider, disc()}, sizing::UniformSize(0.1)).empty(), world().size() == 1);
}

TEST(SameInput, ABitOfTheShapeIsFound) {
  geometry::Boundary boundary = disc();
  double& radius = boundary.loops[0].pieces[0].radius;
  if (is_last())
    radius = std::nextafter(radius, 1);
  EXPECT_EQ(error_of({frame, boundary}, sizing::UniformSize(0.1)).find("different bits of the shape") !=
                std::string::npos,
            world().size() > 1);
}

TEST(SameInput, ABitOfTheSizeIsFound) {
  const sizing::UniformSize size(is_last() ? std::nextafter(0.1, 1) : 0.1);
  EXPECT_EQ(error_of({frame, disc()}, size).find("different bits of the size field") != std::string::npos,
            world().size() > 1);
}

} // namespace
} // namespace trime::meshing
