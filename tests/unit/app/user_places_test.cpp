// SPDX-License-Identifier: BSD-3-Clause
// Places in messages, told in the user's own coordinates and by the line of the nearest vertex.
#include "app/user_places.hpp"

#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

using geometry::Vec2;

/// A square of side 200 around (1000, 5000), which goes to [0.1, 0.9]^2.
UserPlaces places_of_square() {
  const contours::Contour contour =
      contours::parse_xy("# a coast\n900 4900\n1100 4900\n1100 5100\n900 5100\n", "coast.xy");
  UserPlaces places;
  places.add(contour, {{1000, 5000}, {0.5, 0.5}, 0.004});
  return places;
}

UserPlaces square_as_given() {
  UserPlaces places;
  places.add(contours::make_contour({{{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}}, "ring.xy"), {});
  return places;
}

std::string explained(const UserPlaces& places, const std::string& message) {
  return places.explain(PlacedText(message));
}

TEST(UserPlaces, TellPlacesOfANormalizedContourInItsCoordinates) {
  EXPECT_EQ(explained(places_of_square(), fmt::format("worst triangle at {}", Place(Vec2{0.88, 0.9}))),
            "worst triangle at (0.88, 0.9) [coast.xy:4: (1095, 5100)]");
}

TEST(UserPlaces, TellTheLineOfTheNearestVertex) {
  EXPECT_EQ(explained(square_as_given(), fmt::format("too narrow near {}: 3 apart", Place(Vec2{0.88, 0.11}))),
            "too narrow near (0.88, 0.11) [ring.xy:2]: 3 apart");
  EXPECT_EQ(explained(square_as_given(), fmt::format("at {}, {}", Place(Vec2{0.5, 0.9}), Place(Vec2{0.1, 0.1000001}))),
            "at (0.5, 0.9) [ring.xy:3], (0.1, 0.1000001) [ring.xy:1]");
}

TEST(UserPlaces, KnowTheLineWhereTheRingOfALoopBegins) {
  const contours::Contour contour =
      contours::parse_xy("# two\n0.1 0.1\n0.2 0.1\n0.2 0.2\n\n0.5 0.5\n0.6 0.5\n0.6 0.6\n", "rings.xy");
  UserPlaces places;
  places.add(contour, {});
  const geometry::Boundary boundary =
      testing::boundary_of({testing::polygon_loop({{0.6, 0.5}, {0.6, 0.6}, {0.5, 0.5}}),
                            testing::polygon_loop({{0.7, 0.1}, {0.2, 0.1}, {0.2, 0.2}}),
                            testing::polygon_loop({{0.7, 0.7}, {0.8, 0.7}, {0.8, 0.8}})});
  EXPECT_EQ(places.ring_lines(boundary), (std::vector<std::int32_t>{6, 2, 0}));
  EXPECT_EQ(UserPlaces().ring_lines(boundary), (std::vector<std::int32_t>{0, 0, 0}));
}

TEST(UserPlaces, AddLongitudeAndLatitudeWhereTheyAreKnown) {
  UserPlaces places = square_as_given();
  places.set_on_earth([](Vec2 p) { return p.x < 8 ? std::optional(p + Vec2{5, 60}) : std::nullopt; });
  EXPECT_EQ(explained(places, fmt::format("at {}", Place(Vec2{0.5, 0.9}))),
            "at (0.5, 0.9) [ring.xy:3: longitude 5.5, latitude 60.9]");
  EXPECT_EQ(explained(places, fmt::format("at {}", Place(Vec2{7, 7}))), "at (7, 7) [longitude 12, latitude 67]");
  EXPECT_EQ(explained(places, fmt::format("at {}", Place(Vec2{9, 9}))), "at (9, 9)");
}

TEST(UserPlaces, LeaveTheRestAlone) {
  for (const char* text : {"atan2(0.5, 0.5) is no place", "between (0.5, 0.5) and the box", ""})
    EXPECT_EQ(explained(square_as_given(), text), text);
  EXPECT_EQ(explained(square_as_given(), fmt::format("far away at {}", Place(Vec2{7, 7}))), "far away at (7, 7)");
  EXPECT_EQ(explained(UserPlaces(), fmt::format("at {}", Place(Vec2{0.5, 0.5}))), "at (0.5, 0.5)");
}

} // namespace
} // namespace trime::app
