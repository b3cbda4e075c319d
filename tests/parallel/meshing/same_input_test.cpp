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

geometry::Boundary disc() {
  const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}});
  return shape::RegionShape({shape::Part::circle("disc", {0.5, 0.5}, 0.3, frame)}, "disc", frame).boundary();
}

std::string error_of(const geometry::Boundary& boundary, const sizing::SizeField& size,
                     const std::vector<boundary::FixedPoint>& fixed = {}) {
  try {
    check_same_input(boundary, fixed, size, world());
    return "";
  } catch (const InternalError& error) {
    return error.what();
  }
}

TEST(SameInput, OfAllRanksIsAccepted) {
  EXPECT_EQ(error_of(disc(), sizing::UniformSize(0.1)), "");
}

/// A checkpoint is refused by these hashes.
TEST(SameInput, ThePartsTheCornersAndTheFixedPointsCount) {
  const sizing::UniformSize size(0.1);
  const geometry::Boundary whole = disc();
  const std::int64_t hash = check_same_input(whole, {}, size, world()).shape;
  EXPECT_EQ(check_same_input(disc(), {}, size, world()).shape, hash);
  geometry::Boundary other = whole;
  other.loops[0].pieces[0].part = 1;
  EXPECT_NE(check_same_input(other, {}, size, world()).shape, hash);
  other = whole;
  other.loops[0].pieces[0].corner = true;
  EXPECT_NE(check_same_input(other, {}, size, world()).shape, hash);
  const std::vector<boundary::FixedPoint> fixed{{{0.5, 0.5}, "here"}};
  EXPECT_NE(check_same_input(whole, fixed, size, world()).shape, hash);
}

TEST(SameInput, AFixedPointOfOneRankIsFound) {
  std::vector<boundary::FixedPoint> fixed;
  if (is_last())
    fixed.push_back({{0.5, 0.5}, "here"});
  EXPECT_EQ(error_of(disc(), sizing::UniformSize(0.1), fixed).empty(), world().size() == 1);
}

TEST(SameInput, ABitOfTheShapeIsFound) {
  geometry::Boundary boundary = disc();
  double& radius = boundary.loops[0].pieces[0].radius;
  if (is_last())
    radius = std::nextafter(radius, 1);
  EXPECT_EQ(error_of(boundary, sizing::UniformSize(0.1)).find("different bits of the shape") != std::string::npos,
            world().size() > 1);
}

TEST(SameInput, ABitOfTheSizeIsFound) {
  const sizing::UniformSize size(is_last() ? std::nextafter(0.1, 1) : 0.1);
  EXPECT_EQ(error_of(disc(), size).find("different bits of the size field") != std::string::npos, world().size() > 1);
}

} // namespace
} // namespace trime::meshing
