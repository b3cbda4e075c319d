// SPDX-License-Identifier: BSD-3-Clause
// Tables that explain the numbers of a mesh file: regions, curves and interfaces.
#include "record/groups.hpp"

#include <gtest/gtest.h>

namespace trime::record {
namespace {

using Integers = std::vector<std::int32_t>;
using Words = std::vector<std::string>;

Origin origin_with(geometry::Regions regions) {
  Origin origin;
  origin.part_names = {"coast", "island"};
  origin.part_markers = {0, 0};
  origin.regions = std::move(regions);
  return origin;
}

TEST(Groups, OneRegionIsNamedByTheExpressionAndHasNoTableOfInterfaces) {
  const Origin origin = origin_with(named({}, "coast - island"));
  const io::Metadata metadata = with_inner_edges({{}, {}, {tags_group(origin, {})}}, origin);
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "tags", "region_id"), Integers{1});
  EXPECT_EQ(io::column_of<std::string>(metadata, "tags", "region_name"), Words{"coast - island"});
  EXPECT_FALSE(io::has_regions(metadata));
  EXPECT_TRUE(io::interface_names(metadata).empty());
  EXPECT_EQ(metadata.groups.size(), 1u);
}

TEST(Groups, RegionsCountFromOneAndLabelsOfInterfacesFollowThoseOfCurves) {
  Origin origin = origin_with(named({{"rest", "rock", "soil"}, {{0, 2}, {1, 2}}}, "coast - island"));
  origin.curve_names = {"fault"};
  const io::Metadata metadata = with_inner_edges({{}, {}, {tags_group(origin, {})}}, origin);
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "tags", "region_id"), (Integers{1, 2, 3}));
  EXPECT_EQ(io::column_of<std::string>(metadata, "tags", "region_name"), (Words{"rest", "rock", "soil"}));
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "curves", "label"), Integers{3});
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "interfaces", "pair_id"), (Integers{0, 1}));
  EXPECT_EQ(io::interface_names(metadata), (Words{"rest|soil", "rock|soil"}));
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "interfaces", "left"), (Integers{1, 2}));
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "interfaces", "right"), (Integers{3, 3}));
  EXPECT_EQ(io::column_of<std::int32_t>(metadata, "interfaces", "label"), (Integers{4, 5}));
}

TEST(Groups, KindsOfCurvesAreReadAgain) {
  Origin origin = origin_with(named({}, "coast"));
  origin.curve_names = {"fault", "dam", "crack"};
  EXPECT_TRUE(curve_kinds(with_inner_edges({}, origin)).empty());
  origin.curve_kinds.assign(3, {});
  EXPECT_TRUE(curve_kinds(with_inner_edges({}, origin)).empty()) << "no curve is split";
  origin.curve_kinds[1] = {true, 2.5, 0.75, 0.5};
  origin.curve_kinds[2].split = true;
  EXPECT_EQ(curve_kinds(with_inner_edges({}, origin)), origin.curve_kinds);
}

TEST(Groups, RegionsThatDoNotTouchHaveAnEmptyTableOfInterfaces) {
  const Origin origin = origin_with({{"rest", "rock"}});
  EXPECT_TRUE(io::has_regions(with_inner_edges({}, origin)));
  EXPECT_TRUE(io::interface_names(with_inner_edges({}, origin)).empty());
}

} // namespace
} // namespace trime::record
