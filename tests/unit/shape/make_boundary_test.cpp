// SPDX-License-Identifier: BSD-3-Clause
// Boundaries of regions: areas by independent formulas, components and holes, coincident and touching parts.
#include "core/angle.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

namespace trime::shape {
namespace {

using geometry::Boundary;
using geometry::Box;
using geometry::dot;
using geometry::Frame;
using geometry::Loop;
using geometry::Piece;
using geometry::squared_length;
using geometry::Vec2;

const Frame unit_frame(Box{{0, 0}, {1, 1}});

Part rectangle(const char* name, double x0, double y0, double x1, double y1) {
  return Part::rectangle(name, {{x0, y0}, {x1, y1}}, unit_frame);
}
Part circle(const char* name, double x, double y, double r) {
  return Part::circle(name, {x, y}, r, unit_frame);
}

struct Expected {
  double area;
  int components = 1, holes = 0;
  std::size_t pieces = 0; ///< 0: any number
};

void expect_region(const std::vector<Part>& parts, const char* region, const Expected& expected) {
  SCOPED_TRACE(region);
  const RegionShape shape(parts, region, unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_NEAR(shape.boundary().area, expected.area, 1e-11);
  EXPECT_EQ(shape.boundary().components(), expected.components);
  EXPECT_EQ(shape.boundary().holes(), expected.holes);
  std::size_t pieces = 0;
  for (const Loop& loop : shape.boundary().loops)
    pieces += loop.pieces.size();
  if (expected.pieces > 0) {
    EXPECT_EQ(pieces, expected.pieces);
  }
}

std::string error_of(const std::vector<Part>& parts, const char* region) {
  return message_of<GeometryError>([&] { RegionShape(parts, region, unit_frame); });
}

TEST(MakeBoundary, SingleParts) {
  expect_region({rectangle("r", 0.1, 0.2, 0.6, 0.4)}, "r", {0.1, 1, 0, 4});
  expect_region({circle("c", 0.5, 0.5, 0.3)}, "c", {0.09 * pi, 1, 0, 4});
  expect_region({}, "domain", {1, 1, 0, 4});
  const Boundary domain = RegionShape({}, "domain", unit_frame).boundary();
  EXPECT_EQ(domain.part_names, std::vector<std::string>{"domain"});
  EXPECT_EQ(domain.loops[0].pieces[0].start, (Vec2{0, 0}));
  EXPECT_EQ(domain.bounding_box().max, (Vec2{1, 1}));
}

TEST(MakeBoundary, HolesNestAndCross) {
  const std::vector<Part> parts{rectangle("r", 0.1, 0.1, 0.9, 0.9), circle("c", 0.5, 0.5, 0.2),
                                circle("d", 0.5, 0.5, 0.1)};
  expect_region(parts, "difference(r, c)", {0.64 - 0.04 * pi, 1, 1, 8});
  expect_region(parts, "difference(r, difference(c, d))", {0.64 - 0.03 * pi, 2, 1, 12});
  expect_region(parts, "union(r, c, d)", {0.64, 1, 0, 4});
  expect_region(parts, "intersection(r, c, d)", {0.01 * pi, 1, 0, 4});
  expect_region(parts, "difference(domain, r)", {0.36, 1, 1, 8});
}

TEST(MakeBoundary, HalfDiscAndCornerCuts) {
  const std::vector<Part> parts{rectangle("r", 0.1, 0.1, 0.9, 0.5), circle("c", 0.5, 0.5, 0.2),
                                circle("corner", 0.9, 0.5, 0.1)};
  expect_region(parts, "intersection(r, c)", {0.02 * pi, 1, 0, 3});
  expect_region(parts, "difference(r, c)", {0.32 - 0.02 * pi});
  expect_region(parts, "union(r, c)", {0.32 + 0.02 * pi});
  expect_region(parts, "difference(r, corner)", {0.32 - 0.0025 * pi, 1, 0, 5});
  expect_region(parts, "union(r, corner)", {0.32 + 0.0075 * pi, 1, 0, 7});
}

TEST(MakeBoundary, LensOfTwoCircles) {
  const double r = 0.15, d = 0.2, half = std::acos(d / (2 * r));
  const double lens = 2 * r * r * (half - std::sin(half) * std::cos(half));
  const std::vector<Part> parts{circle("a", 0.4, 0.4, r), circle("b", 0.6, 0.4, r)};
  expect_region(parts, "intersection(a, b)", {lens});
  expect_region(parts, "union(a, b)", {2 * pi * r * r - lens});
  expect_region(parts, "difference(a, b)", {pi * r * r - lens});
  // Two crescents would meet in the two crossings.
  EXPECT_NE(error_of(parts, "union(difference(a, b), difference(b, a))").find("touches itself"), std::string::npos);
}

TEST(MakeBoundary, SquareMinusLeavesAndDisc) {
  const std::vector<Part> parts{rectangle("square", 0.1, 0.1, 0.9, 0.9),
                                circle("dl", 0.4, 0.4, 0.15),
                                circle("dr", 0.6, 0.4, 0.15),
                                circle("ul", 0.4, 0.6, 0.15),
                                circle("ur", 0.6, 0.6, 0.15),
                                circle("disc", 0.5, 0.5, 0.1)};
  // All four circles and the disc hold the centre: seen from there the cut-out is r(angle), a maximum of minima.
  const Vec2 centers[] = {{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};
  double area = 0;
  constexpr int n = 400000;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * pi * (k + 0.5) / n;
    const Vec2 u{std::cos(angle), std::sin(angle)};
    double exit[4], r = 0.1;
    for (int i = 0; i < 4; ++i) {
      const double along = dot(u, centers[i]);
      exit[i] = along + std::sqrt(along * along - squared_length(centers[i]) + 0.15 * 0.15);
    }
    for (int i = 0; i < 4; ++i)
      r = std::max(r, std::min(exit[i], exit[(i + 1) % 4]));
    area += 0.5 * r * r * 2 * pi / n;
  }
  const char* region = "difference(square, union(intersection(dl, dr), intersection(dl, ul), intersection(ul, ur), "
                       "intersection(dr, ur), disc))";
  const RegionShape shape(parts, region, unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_NEAR(shape.boundary().area, 0.64 - area, 1e-9);
  EXPECT_EQ(shape.boundary().components(), 1);
  EXPECT_EQ(shape.boundary().holes(), 1);
  int corners = 0;
  for (const Loop& loop : shape.boundary().loops)
    if (!loop.outer)
      for (std::size_t k = 0; k < loop.pieces.size(); ++k)
        corners += loop.turn_degrees(k) > 30 ? 1 : 0;
  EXPECT_EQ(corners, 12); // four tips, and each leaf leaves the disc twice
}

TEST(MakeBoundary, SharedSides) {
  const std::vector<Part> parts{rectangle("a", 0.1, 0.1, 0.5, 0.5), rectangle("b", 0.5, 0.1, 0.9, 0.5),
                                rectangle("low", 0.1, 0.1, 0.5, 0.3), rectangle("part", 0.5, 0.2, 0.7, 0.4)};
  expect_region(parts, "union(a, b)", {0.32, 1, 0, 6});
  expect_region(parts, "difference(a, low)", {0.08, 1, 0, 4});
  expect_region(parts, "union(a, low)", {0.16});
  expect_region(parts, "difference(a, b)", {0.16, 1, 0, 4});
  expect_region(parts, "union(a, part)", {0.16 + 0.04, 1, 0, 8});
  expect_region(parts, "difference(b, part)", {0.16 - 0.04});
}

TEST(MakeBoundary, SidesThatDifferByRounding) {
  // 0.1 + 0.2 and 0.3 are not the same number.
  const std::vector<Part> parts{rectangle("a", 0.1, 0.1, 0.1 + 0.2, 0.5),
                                Part::rectangle("b", {{0.3 + 3e-13, 0.1}, {0.6, 0.5 - 3e-13}}, unit_frame)};
  expect_region(parts, "union(a, b)", {0.2, 1, 0, 6});
  const std::vector<Part> slivers{rectangle("a", 0.1, 0.1, 0.5, 0.5),
                                  Part::rectangle("b", {{0.1, 0.1}, {0.5 - 8e-13, 0.5}}, unit_frame)};
  EXPECT_NE(error_of(slivers, "difference(a, b)").find("empty"), std::string::npos);
}

TEST(MakeBoundary, IdenticalParts) {
  const std::vector<Part> parts{rectangle("a", 0.1, 0.1, 0.5, 0.5), rectangle("b", 0.1, 0.1, 0.5, 0.5),
                                circle("c", 0.3, 0.3, 0.1), circle("d", 0.3, 0.3, 0.1)};
  expect_region(parts, "union(a, b)", {0.16, 1, 0, 4});
  expect_region(parts, "intersection(a, b)", {0.16, 1, 0, 4});
  expect_region(parts, "difference(a, union(c, d))", {0.16 - 0.01 * pi, 1, 1, 8});
  expect_region(parts, "difference(a, intersection(c, d))", {0.16 - 0.01 * pi, 1, 1, 8});
  for (const char* region : {"difference(a, b)", "difference(a, a)", "difference(c, d)", "difference(c, a)",
                             "intersection(difference(a, c), d)"})
    EXPECT_NE(error_of(parts, region).find("empty"), std::string::npos) << region;
}

TEST(MakeBoundary, TangentCircles) {
  const std::vector<Part> parts{rectangle("r", 0.25, 0.25, 0.75, 0.75), circle("in", 0.5, 0.5, 0.25),
                                circle("small", 0.625, 0.5, 0.125), circle("beside", 0.875, 0.5, 0.125),
                                circle("oblique", 0.5 + 0.3 * 0.6, 0.5 + 0.3 * 0.8, 0.05)};
  expect_region(parts, "intersection(r, in)", {0.0625 * pi});
  expect_region(parts, "union(r, in)", {0.25});
  expect_region(parts, "intersection(in, small)", {0.015625 * pi});
  expect_region(parts, "union(in, small)", {0.0625 * pi});
  expect_region(parts, "union(difference(in, small), small)", {0.0625 * pi});
  const auto touches = [&](const char* region, const char* place) {
    const std::string message = error_of(parts, region);
    EXPECT_NE(message.find("touches itself at"), std::string::npos) << region << ": " << message;
    EXPECT_NE(message.find(place), std::string::npos) << region << ": " << message;
  };
  touches("difference(in, small)", "(0.75, 0.5)");
  touches("union(in, beside)", "(0.75, 0.5)");
  touches("difference(r, in)", "touches");
  touches("union(in, oblique)", "(0.65, 0.7)");
}

TEST(MakeBoundary, CornersThatTouch) {
  const std::vector<Part> parts{rectangle("a", 0.1, 0.1, 0.5, 0.5), rectangle("b", 0.5, 0.5, 0.9, 0.9)};
  const std::string message = error_of(parts, "union(a, b)");
  EXPECT_NE(message.find("touches itself at (0.5, 0.5)"), std::string::npos) << message;
  EXPECT_NE(message.find("'a', 'b'"), std::string::npos) << message;
}

TEST(MakeBoundary, OutsideTheContainer) {
  const std::vector<Part> parts{circle("c", 0.9, 0.5, 0.3), circle("far", 1.6, 0.5, 0.3),
                                circle("touching", 0.75, 0.5, 0.25)};
  const std::string partly = error_of(parts, "c"), fully = error_of(parts, "far");
  EXPECT_NE(partly.find("partly outside"), std::string::npos) << partly;
  EXPECT_NE(partly.find("'c' reaches (1.2, 0.5), 0.2 beyond"), std::string::npos) << partly;
  EXPECT_NE(fully.find("lies outside"), std::string::npos) << fully;
  EXPECT_EQ(error_of(parts, "touching"), "");
  EXPECT_EQ(error_of(parts, "intersection(domain, c)"), "");
  EXPECT_NE(error_of(parts, "intersection(domain, far)").find("empty"), std::string::npos);
}

TEST(MakeBoundary, RandomRegionsHaveTheAreaThatAGridOfPointsCounts) {
  // All kinds of crossings, no special position. Each part occurs once: then no boundary can touch itself.
  const char* regions[] = {"union(difference(r, c), intersection(d, t))", "difference(union(r, c, d), t)",
                           "difference(r, union(c, intersection(d, t)))",
                           "union(intersection(r, c), difference(d, t))"};
  for (int seed = 0; seed < 20; ++seed) {
    const auto number = [&](int k, double low, double high) { return low + (high - low) * random(seed, k); };
    std::vector<Part> parts;
    parts.push_back(rectangle("r", number(0, 0.05, 0.4), number(1, 0.05, 0.4), number(2, 0.6, 0.95), 0.9));
    parts.push_back(circle("c", number(4, 0.3, 0.7), number(5, 0.3, 0.7), number(6, 0.05, 0.3)));
    parts.push_back(circle("d", number(7, 0.3, 0.7), number(8, 0.3, 0.7), number(9, 0.05, 0.3)));
    parts.push_back(Part::triangle(
        "t", {{{number(10, 0, 1), number(11, 0, 1)}, {number(12, 0, 1), number(13, 0, 1)}, {number(14, 0, 1), 0.5}}},
        unit_frame));
    const RegionShape shape(parts, regions[seed % 4], unit_frame);
    expect_valid(shape.boundary());
    expect_inside_on_left(shape);
    constexpr int n = 200;
    int count = 0;
    for (int i = 0; i < n * n; ++i)
      count += shape.inside(unit_frame.snap({(i % n + 0.5) / n, (i / n + 0.5) / n})) ? 1 : 0;
    EXPECT_NEAR(shape.boundary().area, count / double(n * n), 3.0 / n * shape.boundary().length() / 4) << seed;
  }
}

/// A random expression over parts p0 ... p(n-1).
std::string random_expression(std::uint64_t& counter, int depth, int n) {
  const auto pick = [&](int choices) { return static_cast<int>(random(counter++, 20) * choices); };
  if (depth == 0 || pick(4) == 0)
    return fmt::format("p{}", pick(n));
  const char* operations[] = {"union", "intersection", "difference"};
  std::string text = fmt::format("{}({}", operations[pick(3)], random_expression(counter, depth - 1, n));
  for (int k = 1 + pick(2); k > 0; --k)
    text += ", " + random_expression(counter, depth - 1, n);
  return text + ")";
}

TEST(MakeBoundary, SpecialPositionsGiveAShapeOrAClearRefusal) {
  // Multiples of 0.1 and regular polygons make sides, vertices and circles coincide and touch all the time.
  std::uint64_t counter = 0;
  const auto pick = [&](int choices) { return static_cast<int>(random(counter++, 20) * choices); };
  int made = 0, touching = 0, empty = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Part> parts;
    for (int k = 0; k < 4; ++k) {
      const std::string name = fmt::format("p{}", k);
      const Vec2 at{0.1 * (1 + pick(5)), 0.1 * (1 + pick(5))}, center{0.3 + 0.1 * pick(5), 0.3 + 0.1 * pick(5)};
      const double size = 0.1 * (1 + pick(3));
      std::vector<Vec2> ring;
      for (int j = 0, n = 3 + pick(20); j < n; ++j)
        ring.push_back(center + size * Vec2{sin_cos(2 * pi * j / n).cos, sin_cos(2 * pi * j / n).sin});
      const int kind = pick(3);
      parts.push_back(kind == 0   ? Part::rectangle(name, {at, at + Vec2{size, 0.1 * (1 + pick(3))}}, unit_frame)
                      : kind == 1 ? Part::circle(name, center, size, unit_frame)
                                  : Part::contour(name, contours::make_contour({ring}, name), {}, unit_frame));
    }
    const std::string region = random_expression(counter, 3, 4);
    try {
      const RegionShape shape(parts, region, unit_frame);
      expect_valid(shape.boundary());
      expect_inside_on_left(shape);
      ++made;
    } catch (const GeometryError& error) {
      const std::string message = error.what();
      const bool is_empty = message.find("empty") != std::string::npos;
      ASSERT_TRUE(is_empty || message.find("touches itself") != std::string::npos) << region << ": " << message;
      ++(is_empty ? empty : touching);
    }
    ASSERT_FALSE(HasFailure()) << region << " in round " << round;
  }
  EXPECT_GT(made, 200);
  EXPECT_GT(touching, 2);
  EXPECT_GT(empty, 20);
}

TEST(MakeBoundary, ContourVerticesStayBitForBit) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 500; ++k) {
    const SinCos s = sin_cos(2 * pi * k / 500);
    const double r = 0.3 + 0.1 * random(k, 3);
    ring.push_back({0.5 + r * s.cos, 0.5 + r * s.sin});
  }
  const std::vector<Part> parts{rectangle("r", 0.5, 0.5, 0.99, 0.99), circle("c", 0.5, 0.5, 0.35),
                                Part::contour("m", contours::make_contour({ring}, "m"), {}, unit_frame)};
  const RegionShape shape(parts, "union(difference(m, c), intersection(m, c, r), difference(r, m))", unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  const RegionShape whole(parts, "m", unit_frame);
  for (const Vec2 p : ring) {
    const Vec2 q = unit_frame.snap(p);
    const auto& pieces = whole.boundary().loops[0].pieces;
    EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.start == q; }));
  }
  EXPECT_EQ(whole.boundary().loops[0].pieces.size(), 500u);
}

TEST(MakeBoundary, DiscsAlongAFineContour) {
  // Segments much shorter than a disc, which the bins of the contour list several times; one disc holds it all.
  constexpr int vertices = 20000, discs = 40;
  std::vector<Vec2> ring;
  for (int k = 0; k < vertices; ++k) {
    const SinCos s = sin_cos(2 * pi * k / vertices);
    ring.push_back({0.5 + 0.3 * s.cos, 0.5 + 0.3 * s.sin});
  }
  std::vector<Part> parts{Part::contour("m", contours::make_contour({ring}, "m"), {}, unit_frame),
                          circle("all", 0.5, 0.5, 0.45)};
  std::string united = "union(all";
  std::string beads = "union(d0";
  for (int k = 0; k < discs; ++k) {
    const SinCos s = sin_cos(2 * pi * (k + random(k, 1) / 2) / discs);
    parts.push_back(circle(fmt::format("d{}", k).c_str(), 0.5 + 0.3 * s.cos, 0.5 + 0.3 * s.sin, 0.005));
    united += fmt::format(", d{}", k);
    beads += k > 0 ? fmt::format(", d{}", k) : "";
  }
  beads += ")";
  const Boundary without = RegionShape(parts, fmt::format("difference(m, {})", beads), unit_frame).boundary();
  const Boundary within = RegionShape(parts, fmt::format("intersection(m, {})", beads), unit_frame).boundary();
  expect_valid(without);
  expect_valid(within);
  EXPECT_EQ(within.components(), discs);
  EXPECT_EQ(without.components(), 1);
  const double whole = RegionShape(parts, "m", unit_frame).boundary().area;
  EXPECT_NEAR(without.area + within.area, whole, 1e-12);
  EXPECT_NEAR(within.area, discs * pi * 0.005 * 0.005 / 2, 0.01 * within.area);
  EXPECT_NEAR(RegionShape(parts, united + ", m)", unit_frame).boundary().area, pi * 0.45 * 0.45, 1e-12);
}

TEST(MakeBoundary, ContoursCrossEachOther) {
  const auto wave = [](double phase) {
    std::vector<Vec2> ring;
    for (int k = 0; k < 1000; ++k) {
      const double angle = 2 * pi * k / 1000;
      const double r = 0.3 + 0.05 * std::sin(10 * angle + phase);
      ring.push_back({0.5 + r * std::cos(angle), 0.5 + r * std::sin(angle)});
    }
    return ring;
  };
  const std::vector<Part> parts{Part::contour("a", contours::make_contour({wave(0.1)}, "a"), {}, unit_frame),
                                Part::contour("b", contours::make_contour({wave(0.1 + pi)}, "b"), {}, unit_frame)};
  const double a = RegionShape(parts, "a", unit_frame).boundary().area,
               b = RegionShape(parts, "b", unit_frame).boundary().area;
  const double both = RegionShape(parts, "intersection(a, b)", unit_frame).boundary().area;
  const Boundary united = RegionShape(parts, "union(a, b)", unit_frame).boundary();
  expect_valid(united);
  EXPECT_EQ(united.components(), 1);
  EXPECT_NEAR(united.area, a + b - both, 1e-12);
  EXPECT_EQ(RegionShape(parts, "difference(a, b)", unit_frame).boundary().components(), 10);
}

} // namespace
} // namespace trime::shape
