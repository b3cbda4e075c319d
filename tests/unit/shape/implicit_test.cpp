// SPDX-License-Identifier: BSD-3-Clause
// Shapes given by a function: corners, straight sides, accuracy of smooth curves, hard places, and what is refused.
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/traced_part.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <functional>
#include <limits>

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::cross;
using geometry::dot;
using geometry::Frame;
using geometry::length;
using geometry::Loop;
using geometry::Piece;
using geometry::squared_length;
using geometry::Vec2;

const Frame unit_frame(Box{{0, 0}, {1, 1}});

class Formula final : public tracing::Shape {
public:
  explicit Formula(std::function<double(Vec2)> f) : f_(std::move(f)) {}
  double signed_distance(Vec2 p) const override { return f_(p); }

private:
  std::function<double(Vec2)> f_;
};

RegionShape trace(const std::function<double(Vec2)>& f, const Frame& frame = unit_frame) {
  return traced(Formula(f), frame);
}

double disc(Vec2 p, Vec2 center, double radius) {
  return length(p - center) - radius;
}

double box_distance(Vec2 p, Vec2 center, Vec2 half) {
  const Vec2 q{std::fabs(p.x - center.x) - half.x, std::fabs(p.y - center.y) - half.y};
  return length({std::fmax(q.x, 0), std::fmax(q.y, 0)}) + std::fmin(std::fmax(q.x, q.y), 0);
}

/// Six-pointed star with tips at 2 r and concave corners at 2 r / sqrt(3); exact distance.
double hexagram(Vec2 p, double r) {
  const double half = 0.5, root = std::sqrt(3.0) / 2;
  p = {std::fabs(p.x), std::fabs(p.y)};
  const double first = std::fmin(-half * p.x + root * p.y, 0.0), second = std::fmin(root * p.x - half * p.y, 0.0);
  p = p - 2 * first * Vec2{-half, root};
  p = p - 2 * second * Vec2{root, -half};
  p = p - Vec2{std::fmin(std::fmax(p.x, r / std::sqrt(3.0)), r * std::sqrt(3.0)), r};
  return std::copysign(length(p), p.y);
}

std::vector<Vec2> corners(const Loop& loop, double degrees) {
  std::vector<Vec2> result;
  for (std::size_t k = 0; k < loop.pieces.size(); ++k)
    if (loop.turn_degrees(k) > degrees)
      result.push_back(loop.pieces[k].start);
  return result;
}

double distance_to(const std::vector<Vec2>& points, Vec2 p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec2 q : points)
    best = std::fmin(best, length(q - p));
  return best;
}

/// Each expected corner is there, and no other; turns elsewhere stay small.
void expect_corners(const Loop& loop, const std::vector<Vec2>& expected, double tolerance) {
  const std::vector<Vec2> found = corners(loop, 12);
  EXPECT_EQ(found.size(), expected.size());
  for (const Vec2 corner : expected)
    EXPECT_LT(distance_to(found, corner), tolerance) << corner.x << " " << corner.y;
}

/// Largest value of the function on vertices, and on middles of the segments.
std::array<double, 2> stray(const RegionShape& shape, const std::function<double(Vec2)>& f) {
  std::array<double, 2> largest{};
  for (const Loop& loop : shape.boundary().loops)
    for (const Piece& piece : loop.pieces) {
      largest[0] = std::fmax(largest[0], std::fabs(f(piece.start)));
      largest[1] = std::fmax(largest[1], std::fabs(f(0.5 * (piece.start + piece.end))));
    }
  return largest;
}

std::string message_of(const std::function<double(Vec2)>& f) {
  try {
    trace(f);
  } catch (const GeometryError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no GeometryError";
  return "";
}

TEST(Implicit, HexagramHasItsTwelveCornersAndTwelveSides) {
  const auto f = [](Vec2 p) { return hexagram(p - Vec2{0.5, 0.5}, 0.2); };
  const RegionShape shape = trace(f);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  ASSERT_EQ(shape.boundary().loops.size(), 1);
  const Loop& loop = shape.boundary().loops[0];
  EXPECT_EQ(loop.pieces.size(), 12);
  std::vector<Vec2> expected;
  for (int k = 0; k < 12; ++k) {
    const SinCos angle = sin_cos(pi / 6 * (k + 1)); // tips at 90 degrees and so on, concave corners between them
    expected.push_back(Vec2{0.5, 0.5} + (k % 2 == 0 ? 0.4 : 0.4 / std::sqrt(3.0)) * Vec2{angle.cos, angle.sin});
  }
  expect_corners(loop, expected, 1e-12);
}

TEST(Implicit, CircleIsRoundAndHasNoCorner) {
  for (const double radius : {0.003, 0.05, 0.2, 0.5}) { // the last one touches the container
    const auto f = [&](Vec2 p) { return disc(p, {0.5, 0.5}, radius); };
    const RegionShape shape = trace(f);
    expect_valid(shape.boundary());
    const auto [at_vertices, at_middles] = stray(shape, f);
    EXPECT_LT(at_vertices, 2e-13);
    EXPECT_LT(at_middles, 1e-6);
    EXPECT_NEAR(shape.boundary().area, pi * radius * radius, 2e-6 * 2 * pi * radius);
    expect_corners(shape.boundary().loops.at(0), {}, 0);
    EXPECT_LT(shape.boundary().loops[0].pieces.size(), 4000);
  }
}

TEST(Implicit, SidesOnGridLinesAndCornersOnNodes) {
  // All numbers are multiples of the cells, so nodes lie on the curve, some with a value of rounding.
  for (const double nudge : {0.0, 1e-17, -1e-17, 1e-13, 3e-4}) {
    const RegionShape shape = trace([&](Vec2 p) { return box_distance(p, {0.5, 0.5}, {0.25, 0.125}) + nudge; });
    ASSERT_EQ(shape.boundary().loops.size(), 1) << nudge;
    EXPECT_EQ(shape.boundary().loops[0].pieces.size(), 4) << nudge;
    const double x = 0.25 - nudge, y = 0.125 - nudge;
    expect_corners(shape.boundary().loops[0],
                   {{0.5 - x, 0.5 - y}, {0.5 + x, 0.5 - y}, {0.5 + x, 0.5 + y}, {0.5 - x, 0.5 + y}}, 1e-12);
  }
}

TEST(Implicit, WholeContainer) {
  const RegionShape shape = trace([](Vec2 p) { return box_distance(p, {0.5, 0.5}, {0.5, 0.5}); });
  EXPECT_EQ(shape.boundary().loops.at(0).pieces.size(), 4);
  EXPECT_NEAR(shape.boundary().area, 1, 1e-12);
}

TEST(Implicit, CornersBetweenArcsAndInSharpTips) {
  // A lens of two discs: the tips are sharp, and both arms are curved.
  for (const double shift : {0.05, 0.2, 0.29}) {
    const auto f = [&](Vec2 p) {
      return std::fmax(disc(p, {0.5 - shift, 0.47}, 0.3), disc(p, {0.5 + shift, 0.47}, 0.3));
    };
    const RegionShape shape = trace(f);
    ASSERT_EQ(shape.boundary().loops.size(), 1);
    const double half = std::sqrt(0.09 - shift * shift);
    expect_corners(shape.boundary().loops[0], {{0.5, 0.47 - half}, {0.5, 0.47 + half}}, 1e-9);
    EXPECT_LT(stray(shape, f)[1], 1e-6);
  }
  // A wedge of ten degrees, turned so that nothing lies along the grid.
  const SinCos low = sin_cos(0.3), high = sin_cos(0.3 + pi / 18);
  const Vec2 tip{0.2, 0.3};
  const RegionShape wedge = trace([&](Vec2 p) {
    const Vec2 q = p - tip;
    return std::fmax(std::fmax(-cross({low.cos, low.sin}, q), cross({high.cos, high.sin}, q)), q.x - 0.6);
  });
  EXPECT_EQ(wedge.boundary().loops.at(0).pieces.size(), 3);
  EXPECT_LT(distance_to(corners(wedge.boundary().loops[0], 30), tip), 1e-11);
}

TEST(Implicit, MildCornersAndRoundedOnes) {
  // Turns of 7.6 degrees between the sides of a regular polygon.
  const RegionShape polygon = trace([](Vec2 p) {
    double f = -1;
    for (int k = 0; k < 47; ++k) {
      const SinCos angle = sin_cos(2 * pi * k / 47);
      f = std::fmax(f, dot(p - Vec2{0.5, 0.5}, {angle.cos, angle.sin}) - 0.3);
    }
    return f;
  });
  EXPECT_EQ(polygon.boundary().loops.at(0).pieces.size(), 47);
  // Rounded corners of a small radius are no corners, and the straight sides between them stay whole.
  const RegionShape rounded = trace([](Vec2 p) { return box_distance(p, {0.5, 0.5}, {0.29, 0.19}) - 0.001; });
  expect_corners(rounded.boundary().loops.at(0), {}, 0);
  int sides = 0;
  for (const Piece& piece : rounded.boundary().loops[0].pieces)
    sides += piece.length() > 0.37 ? 1 : 0;
  EXPECT_EQ(sides, 4);
}

TEST(Implicit, FunctionsThatAreNoDistance) {
  // Values of 1e6 and of 1e-6, a gradient that vanishes in the middle, and |gradient| from 0.2 to 4 along the curve.
  for (const double scale : {1e6, 1e-6}) {
    const auto f = [&](Vec2 p) { return scale * (squared_length(p - Vec2{0.5, 0.5}) - 0.09); };
    EXPECT_NEAR(trace(f).boundary().area, pi * 0.09, 1e-6) << scale;
  }
  const RegionShape ellipse = trace([](Vec2 p) {
    const Vec2 q = p - Vec2{0.5, 0.5};
    return q.x * q.x / 0.16 + q.y * q.y / 0.0004 - 1;
  });
  EXPECT_NEAR(ellipse.boundary().area, pi * 0.4 * 0.02, 1e-6);
}

TEST(Implicit, ThinPartsAndManyPieces) {
  // A plate thinner than a coarse cell and a slot of the same width, both between nodes, and forty small discs.
  const double width = 1.0 / 600;
  const RegionShape plate = trace([&](Vec2 p) { return box_distance(p, {0.503, 0.5}, {width / 2, 0.3}); });
  EXPECT_NEAR(plate.boundary().area, width * 0.6, 1e-12);
  const RegionShape slot = trace([&](Vec2 p) {
    return std::fmax(disc(p, {0.5, 0.5}, 0.4), -box_distance(p, {0.503, 0.5}, {width / 2, 0.3}));
  });
  EXPECT_EQ(slot.boundary().holes(), 1);
  EXPECT_NEAR(slot.boundary().area, pi * 0.16 - width * 0.6, 3e-6);
  const RegionShape discs = trace([](Vec2 p) {
    double f = 1;
    for (int k = 0; k < 40; ++k)
      f = std::fmin(f, disc(p, {0.1 + 0.8 * random(k, 0), 0.02 * k + 0.11}, 0.004));
    return f;
  });
  EXPECT_EQ(discs.boundary().components(), 40);
}

TEST(Implicit, TakesPartInRegions) {
  const Formula wave([](Vec2 p) { return p.y - 0.5 - 0.1 * std::sin(10 * p.x); }); // reaches beyond the container
  const std::vector<Part> parts{traced_part("wave", wave, unit_frame),
                                Part::circle("disc", {0.5, 0.3}, 0.1, unit_frame)};
  const RegionShape shape(parts, "intersection(domain, difference(wave, disc))", unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  const double wave_area = 0.5 + 0.01 * (1 - std::cos(10.0));
  EXPECT_NEAR(shape.boundary().area, wave_area - pi * 0.01, 2e-6);
  EXPECT_LT(distance_to(corners(shape.boundary().loops.at(0), 30), {0, 0.5}), 1e-9);
  EXPECT_LT(distance_to(corners(shape.boundary().loops.at(0), 30), {1, 0.5 + 0.1 * std::sin(10.0)}), 1e-9);
}

TEST(Implicit, LargeShiftedAndLongContainers) {
  const Frame frame(Box{{1000, -50}, {3000, 50}});
  const RegionShape shape = trace([](Vec2 p) { return box_distance(p, {2000, 0}, {900, 40}); }, frame);
  ASSERT_EQ(shape.boundary().loops.at(0).pieces.size(), 4);
  EXPECT_NEAR(shape.boundary().area, 4.0 * 900 * 40, 1e-5);
}

TEST(Implicit, SameBitsForAnyThreads) {
  const auto f = [](Vec2 p) { return std::fmax(hexagram(p - Vec2{0.5, 0.5}, 0.2), -disc(p, {0.5, 0.5}, 0.1)); };
  const int threads = thread_count();
  std::vector<std::vector<Vec2>> places;
  for (const int count : {1, 3}) {
    set_thread_count(count);
    places.emplace_back();
    const RegionShape shape = trace(f);
    for (const Loop& loop : shape.boundary().loops)
      for (const Piece& piece : loop.pieces)
        places.back().push_back(piece.start);
  }
  set_thread_count(threads);
  EXPECT_EQ(places[0], places[1]);
}

TEST(Implicit, RefusesToCrossAPeriodicBorderWithoutItsPeriod) {
  const Frame frame(Box{{0, 0}, {1, 1}}, true, false);
  EXPECT_THROW(trace([](Vec2 p) { return disc(p, {0.95, 0.5}, 0.2); }, frame), GeometryError);
  EXPECT_NEAR(trace([](Vec2 p) { return disc(p, {0.75, 0.5}, 0.2); }, frame).boundary().area, pi * 0.04, 3e-6);
}

TEST(Implicit, RefusesWhatOscillatesBelowTheResolution) {
  const int threads = thread_count();
  const std::vector<std::function<double(Vec2)>> wild{
      [](Vec2 p) { return p.y - 0.5 + 0.1 * std::sin(100000 * p.x); },
      [](Vec2 p) {
        return disc(p, {0.5, 0.5}, 0.3) + 0.01 * std::sin(1e7 * p.x * p.y);
      }};
  for (const std::function<double(Vec2)>& f : wild) {
    std::vector<std::string> messages;
    for (const int count : {1, 3}) {
      set_thread_count(count);
      try {
        traced_part("wild", Formula(f), unit_frame, 1.0 / 128);
      } catch (const GeometryError& error) {
        messages.push_back(error.what());
      }
    }
    set_thread_count(threads);
    ASSERT_EQ(messages.size(), 2);
    EXPECT_NE(messages[0].find("oscillates below the resolution of 0.00781 near ("), std::string::npos) << messages[0];
    EXPECT_EQ(messages[0], messages[1]);
  }
}

TEST(Implicit, RefusesTooManyPieces) {
  const std::string many = message_of([](Vec2 p) { return std::sin(1000 * p.x) * std::sin(1000 * p.y) + 0.01; });
  EXPECT_NE(many.find("closed curves, expected at most 16384"), std::string::npos) << many;
}

TEST(Implicit, FollowsWhatOscillatesAboveTheResolution) {
  const RegionShape wave = trace([](Vec2 p) {
    return std::fmax(std::fabs(p.x - 0.5) - 0.4, std::fabs(p.y - 0.5 + 0.1 * std::sin(300 * p.x)) - 0.3);
  });
  EXPECT_EQ(wave.boundary().components(), 1);
  const RegionShape plate = trace([](Vec2 p) { // 20 x 20 holes
    const Vec2 q{25 * p.x - std::floor(25 * p.x), 25 * p.y - std::floor(25 * p.y)};
    return std::fmax(box_distance(p, {0.48, 0.48}, {0.4, 0.4}), -disc(q, {0.5, 0.5}, 0.3) / 25);
  });
  EXPECT_EQ(plate.boundary().holes(), 400);
}

TEST(Implicit, SaysThatAResolutionIsTooFine) {
  const Frame frame(Box{{0, 0}, {1, 1. / 64}}); // few cells
  const Formula strip([](Vec2 p) { return std::fabs(p.y - 1. / 128) - 1. / 256; });
  const Part part = traced_part("strip", strip, frame, 1e-4);
  ASSERT_EQ(part.warnings().size(), 1);
  EXPECT_NE(part.warnings()[0].find("0.0001 is finer than 0.00012207"), std::string::npos) << part.warnings()[0];
}

TEST(Implicit, RefusesWhatHasNoBoundary) {
  const std::string positive = message_of([](Vec2 p) { return 0.25 + squared_length(p - Vec2{0.5, 0.25}); });
  EXPECT_NE(positive.find("negative nowhere"), std::string::npos) << positive;
  EXPECT_NE(positive.find("0.25, at (0.5, 0.25)"), std::string::npos) << positive;
  const std::string negative = message_of([](Vec2) { return -1.0; });
  EXPECT_NE(negative.find("negative in the whole container"), std::string::npos) << negative;
  const std::string nan = message_of([](Vec2 p) { return std::sqrt(p.x - 0.25) - 0.5; });
  EXPECT_NE(nan.find("found"), std::string::npos) << nan;
  EXPECT_NE(nan.find("at (0, 0)"), std::string::npos) << nan;
  const std::string infinite = message_of([](Vec2 p) {
    return p == Vec2{0.5, 0.5} ? std::numeric_limits<double>::infinity() : p.x - 0.3;
  });
  EXPECT_NE(infinite.find("at (0.5, 0.5)"), std::string::npos) << infinite;
  const std::string beyond = message_of([](Vec2 p) { return disc(p, {0.9, 0.5}, 0.2); });
  EXPECT_NE(beyond.find("container"), std::string::npos) << beyond;
}

} // namespace
} // namespace trime::shape
