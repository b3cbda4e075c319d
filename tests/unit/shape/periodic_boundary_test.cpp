// SPDX-License-Identifier: BSD-3-Clause
// Boundaries in periodic containers: loops that cross the border or lead around, area, topology, inside, distance.
#include "core/angle.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

namespace trime::shape {
namespace {

using geometry::Boundary;
using geometry::Box;
using geometry::cross;
using geometry::Frame;
using geometry::length;
using geometry::lexicographically_less;
using geometry::Loop;
using geometry::Periods;
using geometry::Piece;
using geometry::Vec2;

const Frame torus(Box{{0, 0}, {1, 1}}, true, true);
const Frame cylinder(Box{{0, 0}, {1, 1}}, true, false);

Part disc(const std::string& name, Vec2 center, double radius, const Frame& frame = torus) {
  return Part::circle(name, center, radius, frame);
}
Part box(const std::string& name, Vec2 low, Vec2 high, const Frame& frame = torus) {
  return Part::rectangle(name, {low, high}, frame);
}

/// Is any image of p by up to `reach` periods inside the region as if nothing were periodic?
bool inside_by_images(const RegionShape& shape, Vec2 p) {
  const Periods& periods = shape.frame().periods();
  const int reach_x = periods.x > 0 ? 2 : 0, reach_y = periods.y > 0 ? 2 : 0;
  return shape.region().contains([&](int part) {
    if (shape.parts()[part].name() == domain_name)
      return true;
    for (int i = -reach_x; i <= reach_x; ++i)
      for (int j = -reach_y; j <= reach_y; ++j)
        if (shape.parts()[part].inside(p + Vec2{i * periods.x, j * periods.y}))
          return true;
    return false;
  });
}

double distance_by_images(const RegionShape& shape, Vec2 p) {
  const Periods& periods = shape.frame().periods();
  double best = INFINITY;
  for (const Loop& loop : shape.boundary().loops)
    for (const Piece& piece : loop.pieces)
      for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j)
          best = std::min(best, piece.distance(p + Vec2{i * periods.x, j * periods.y}));
  return best;
}

struct Expected {
  int loops, components, holes, euler;
  double area;
};

/// All that must hold for any shape, and what is expected of this one.
void check(const RegionShape& shape, const Expected& expected) {
  SCOPED_TRACE(shape.region().text());
  const Boundary& boundary = shape.boundary();
  const Periods& periods = shape.frame().periods();
  EXPECT_EQ(static_cast<int>(boundary.loops.size()), expected.loops);
  EXPECT_EQ(boundary.components(), expected.components);
  EXPECT_EQ(boundary.holes(), expected.holes);
  EXPECT_EQ(boundary.euler_characteristic(), expected.euler);
  EXPECT_NEAR(boundary.area, expected.area, 1e-11);
  Vec2 winding;
  for (const Loop& loop : boundary.loops) {
    EXPECT_EQ(loop.pieces[0].start, periods.wrap(loop.pieces[0].start));
    for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
      const bool last = k + 1 == loop.pieces.size();
      EXPECT_EQ(loop.pieces[k].end, last ? loop.pieces[0].start + loop.winding : loop.pieces[k + 1].start);
      EXPECT_FALSE(lexicographically_less(periods.wrap(loop.pieces[k].start), loop.pieces[0].start));
    }
    winding = winding + loop.winding;
  }
  EXPECT_EQ(winding, Vec2{});
  expect_inside_on_left(shape);
  std::int64_t inside = 0;
  const std::int64_t samples = 2000;
  for (std::int64_t i = 0; i < samples; ++i) {
    const Vec2 p = random_point(static_cast<std::uint64_t>(i), shape.frame().inner(), shape.frame());
    inside += shape.inside(p) ? 1 : 0;
    EXPECT_EQ(shape.inside(p), inside_by_images(shape, p));
    const Vec2 image = p + Vec2{3 * periods.x, -2 * periods.y};
    EXPECT_EQ(shape.inside(p), shape.inside(image));
    if (i < 50 && !boundary.loops.empty()) {
      EXPECT_NEAR(shape.distance_to_boundary(image), distance_by_images(shape, p), 1e-12);
    }
  }
  EXPECT_NEAR(static_cast<double>(inside) / samples, boundary.area, 0.05);
}

TEST(PeriodicBoundary, TheWholeTorusHasNoBoundary) {
  check(RegionShape({}, "domain", torus), {0, 1, 0, 0, 1});
  check(RegionShape({box("all", {0, 0}, {1, 1})}, "all", torus), {0, 1, 0, 0, 1});
  check(RegionShape({box("more", {-0.25, -0.5}, {1.5, 1.125})}, "more", torus), {0, 1, 0, 0, 1});
}

TEST(PeriodicBoundary, ADiscAcrossACornerOrASideIsOneLoop) {
  const double area = pi * 0.04;
  for (const Vec2 center : {Vec2{0, 0}, Vec2{1, 1}, Vec2{0, 1}, Vec2{0.05, 0.9}, Vec2{0.97, 0.5}, Vec2{0.5, 0.5},
                            Vec2{-0.3, 1.2}, Vec2{0.2, 0.8}}) {
    check(RegionShape({disc("a", center, 0.2)}, "a", torus), {1, 1, 0, 1, area});
    const RegionShape rest({disc("a", center, 0.2)}, "difference(domain, a)", torus);
    check(rest, {1, 1, 1, -1, 1 - area});
    EXPECT_TRUE(rest.boundary().covers_torus);
    EXPECT_NEAR(rest.boundary().length(), 0.4 * pi, 1e-12);
  }
}

TEST(PeriodicBoundary, ADiscAcrossTheSideOfACylinder) {
  const double area = pi * 0.04;
  check(RegionShape({disc("a", {0.95, 0.5}, 0.2, cylinder)}, "a", cylinder), {1, 1, 0, 1, area});
  check(RegionShape({disc("a", {0.95, 0.5}, 0.2, cylinder)}, "difference(domain, a)", cylinder),
        {3, 1, 1, -1, 1 - area});
  check(RegionShape({}, "domain", cylinder), {2, 1, 0, 0, 1});
}

TEST(PeriodicBoundary, BandsAreBoundedByWindingLoops) {
  for (const Frame& frame : {torus, cylinder}) {
    for (const Part& band : {box("b", {0, 0.25}, {1, 0.5}, frame), box("b", {-0.5, 0.25}, {0.75, 0.5}, frame)}) {
      const RegionShape shape({band}, "b", frame);
      check(shape, {2, 1, 0, 0, 0.25});
      EXPECT_EQ(shape.boundary().loops[0].winding, (Vec2{1, 0}));
      EXPECT_EQ(shape.boundary().loops[1].winding, (Vec2{-1, 0}));
    }
    check(RegionShape({box("b", {0, 0.25}, {1, 0.5}, frame), box("c", {0, 0.625}, {1, 0.75}, frame)}, "union(b, c)",
                      frame),
          {4, 2, 0, 0, 0.375});
  }
  check(RegionShape({box("b", {0.25, -0.125}, {0.5, 1})}, "b", torus), {2, 1, 0, 0, 0.25});
  check(RegionShape({box("b", {0, 0.75}, {1, 1.25})}, "b", torus), {2, 1, 0, 0, 0.5});
  check(RegionShape({box("b", {0, 0.25}, {1, 0.5})}, "difference(domain, b)", torus), {2, 1, 0, 0, 0.75});
}

TEST(PeriodicBoundary, ASlantedBandWindsBothWays) {
  const contours::Contour contour =
      contours::make_contour({{{-0.1, -0.1}, {0.1, -0.1}, {1.1, 0.9}, {1.1, 1.1}, {0.9, 1.1}, {-0.1, 0.1}}}, "c");
  const RegionShape shape({Part::contour("band", contour, {}, torus)}, "band", torus);
  check(shape, {2, 1, 0, 0, 0.4});
}

TEST(PeriodicBoundary, ABandAndADiscThatMeetAtTheBorder) {
  // The disc reaches over the upper side of the band and over the border of the container.
  const Part band = box("b", {0, 0.25}, {1, 0.5}), spot = disc("d", {0, 0.5}, 0.125);
  const double half = 0.5 * pi * 0.125 * 0.125;
  check(RegionShape({band, spot}, "union(b, d)", torus), {2, 1, 0, 0, 0.25 + half});
  check(RegionShape({band, spot}, "difference(b, d)", torus), {2, 1, 0, 0, 0.25 - half});
  check(RegionShape({band, spot}, "intersection(b, d)", torus), {1, 1, 0, 1, half});
  check(RegionShape({band, disc("d", {1, 0.375}, 0.0625)}, "difference(b, d)", torus),
        {3, 1, 1, -1, 0.25 - pi * 0.0625 * 0.0625});
}

TEST(PeriodicBoundary, ADiscWiderThanThePeriodMeetsItsOwnImages) {
  // Four gaps of the plane are one hole of the torus.
  const double r = 0.6, cap = r * r * std::acos(0.5 / r) - 0.5 * std::sqrt(r * r - 0.25);
  check(RegionShape({disc("a", {0.5, 0.5}, r)}, "a", torus), {1, 1, 1, -1, pi * r * r - 4 * cap});
  check(RegionShape({disc("a", {0.1, 0.3}, r)}, "difference(domain, a)", torus),
        {1, 1, 0, 1, 1 - pi * r * r + 4 * cap});
}

TEST(PeriodicBoundary, AGridOfHolesOnTheTorus) {
  std::vector<Part> parts;
  std::string region = "difference(domain";
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      parts.push_back(disc(fmt::format("d{}", parts.size()), {0.25 * i, 0.25 * j}, 0.1));
      region += fmt::format(", {}", parts.back().name());
    }
  region += ")";
  check(RegionShape(parts, region, torus), {16, 1, 16, -16, 1 - 16 * pi * 0.01});
}

TEST(PeriodicBoundary, OtherContainersAndRandomDiscs) {
  const Frame frame(Box{{-1.3, 0.1}, {0.7, 1.8}}, true, true);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Vec2 center{-1.3 + 2 * random(i, 0), 0.1 + 1.7 * random(i, 1)};
    const double radius = 0.02 + 0.6 * random(i, 2);
    const RegionShape shape({disc("a", center, radius, frame)}, "a", frame);
    EXPECT_EQ(shape.boundary().euler_characteristic(), 1);
    EXPECT_NEAR(shape.boundary().area, pi * radius * radius, 1e-10);
    EXPECT_NEAR(shape.boundary().length(), 2 * pi * radius, 1e-10);
    const RegionShape rest({disc("a", center, radius, frame)}, "difference(domain, a)", frame);
    EXPECT_EQ(rest.boundary().euler_characteristic(), -1);
    EXPECT_NEAR(rest.boundary().area, 2 * 1.7 - pi * radius * radius, 1e-10);
    expect_inside_on_left(rest);
  }
}

TEST(PeriodicBoundary, RandomTrianglesKeepTheirAreaAndCloseUp) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    std::array<Vec2, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(k)] = {-0.2 + 0.9 * random(i, 2 * k), 0.4 + 0.9 * random(i, 2 * k + 1)};
    const RegionShape shape({Part::triangle("t", corners, torus)}, "t", torus);
    const double area = 0.5 * std::fabs(cross(corners[1] - corners[0], corners[2] - corners[0]));
    EXPECT_NEAR(shape.boundary().area, area, 1e-11) << i;
    EXPECT_EQ(shape.boundary().euler_characteristic(), 1) << i;
    const RegionShape rest({Part::triangle("t", corners, torus)}, "difference(domain, t)", torus);
    EXPECT_NEAR(rest.boundary().area, 1 - area, 1e-11) << i;
  }
}

class Formula final : public tracing::Shape {
public:
  explicit Formula(double (*f)(Vec2)) : f_(f) {}
  double signed_distance(Vec2 p) const override { return f_(p); }

private:
  double (*f_)(Vec2);
};

TEST(PeriodicBoundary, AFunctionWithThePeriodOfTheContainerGoesOnAcrossTheBorder) {
  // Waves around the cylinder and the torus: the area is what straight bands have.
  const auto wave = [](Vec2 p) { return std::fabs(p.y - 0.5 - 0.1 * std::sin(2 * pi * p.x)) - 0.2; };
  for (const Frame& frame : {cylinder, torus}) {
    const RegionShape shape = traced(Formula(wave), frame);
    EXPECT_EQ(shape.boundary().loops.size(), 2u);
    EXPECT_EQ(shape.boundary().components(), 1);
    EXPECT_EQ(shape.boundary().euler_characteristic(), 0);
    EXPECT_NEAR(shape.boundary().area, 0.4, 1e-5);
    for (const Loop& loop : shape.boundary().loops)
      for (std::size_t k = 0; k < loop.pieces.size(); ++k)
        EXPECT_LT(loop.turn_degrees(k), 5);
  }
  // Discs of |cos| around the corners and the middle: a checkerboard of two on the torus.
  const auto checker = [](Vec2 p) { return 1 - std::cos(2 * pi * p.x) * std::cos(2 * pi * p.y) - 0.5; };
  const RegionShape shape = traced(Formula(checker), torus);
  EXPECT_EQ(shape.boundary().loops.size(), 2u);
  EXPECT_EQ(shape.boundary().components(), 2);
  EXPECT_EQ(shape.boundary().euler_characteristic(), 2);
  EXPECT_NEAR(shape.boundary().loops[0].length(), shape.boundary().loops[1].length(), 1e-5);
  for (const Loop& loop : shape.boundary().loops)
    for (std::size_t k = 0; k < loop.pieces.size(); ++k)
      EXPECT_LT(loop.turn_degrees(k), 5) << loop.pieces[k].start.x << " " << loop.pieces[k].start.y;
}

TEST(PeriodicBoundary, AFunctionThatIsNotPeriodicIsRefused) {
  const auto tilted = [](Vec2 p) { return std::fabs(p.y - 0.5 - 0.1 * p.x) - 0.2; };
  const std::string message = message_of<GeometryError>([&] { traced(Formula(tilted), cylinder); });
  EXPECT_NE(message.find("expected a function with the period of the container in x"), std::string::npos) << message;
  const auto inner = [](Vec2 p) { return length(p - Vec2{0.5, 0.5}) - 0.3; };
  EXPECT_NEAR(traced(Formula(inner), torus).boundary().area, pi * 0.09, 1e-5);
}

TEST(PeriodicBoundary, APartMoreThanAPeriodAwayIsRefused) {
  const std::string message = message_of<GeometryError>([] {
    RegionShape({disc("far", {1.9, 0.5}, 0.2)}, "far", torus);
  });
  EXPECT_NE(message.find("part 'far' reaches from x = 1.7 to 2.1"), std::string::npos) << message;
  EXPECT_NE(message_of<GeometryError>([] {
              RegionShape({disc("a", {0.5, 0.95}, 0.2, cylinder)}, "a", cylinder);
            }).find("lies partly outside the container"),
            std::string::npos);
}

} // namespace
} // namespace trime::shape
