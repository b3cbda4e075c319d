// SPDX-License-Identifier: BSD-3-Clause
// Bodies that the mesh changes are judged by their own size.
#include "boundary/changed_bodies.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trime::boundary {
namespace {

/// A square hole of side 0.1, as a square of another area in the mesh.
LoopFate square_of(double mesh_area) {
  LoopFate fate;
  fate.state = LoopFate::State::simplified;
  fate.place = {0.4, 0.4};
  fate.area = 0.01;
  fate.length = 0.4;
  fate.extent = 0.1414;
  fate.mesh_area = mesh_area;
  fate.mesh_length = 0.4;
  return fate;
}

FeatureReport report_of(const LoopFate& fate) {
  FeatureReport report;
  report.given_area = 1;
  report.loops = {LoopFate{}, fate};
  report.changed = {difference_of(fate) > 1, 1, 3.5};
  return report;
}

const std::vector<std::string> names{"pile"};

TEST(ChangedBodies, AreJudgedByTheirOwnArea) {
  EXPECT_LT(difference_of(square_of(0.0101)), 1);
  EXPECT_GT(difference_of(square_of(0.0103)), 1);
  EXPECT_GT(difference_of(square_of(0.0097)), 1);
  const std::string warning = body_warning(report_of(square_of(0.015)), names).text();
  EXPECT_NE(warning.find("1 of 2 loops differs noticeably from the shape"), std::string::npos) << warning;
  EXPECT_NE(warning.find("'pile' at (0.4, 0.4), 3.5 h around, has 50 % more area in the mesh"), std::string::npos)
      << warning;
  EXPECT_NE(warning.find("/trime_mpi/rings"), std::string::npos) << warning;
  const std::string before = body_warning(report_of(square_of(0.015)), names, Occasion::outlook).text();
  EXPECT_EQ(before.find("/trime_mpi/rings"), std::string::npos) << "there is no file yet: " << before;
}

TEST(ChangedBodies, AreJudgedByTheirOwnWidthAndExtent) {
  LoopFate bent = square_of(0.01), cut = square_of(0.01);
  bent.deviation = 0.004; // a tenth of the mean width is 0.005
  EXPECT_LT(difference_of(bent), 1);
  bent.deviation = 0.01;
  EXPECT_NE(body_warning(report_of(bent), names).text().find("is up to 20 % of its mean width away"),
            std::string::npos);
  cut.reach = 0.006;
  EXPECT_LT(difference_of(cut), 1);
  cut.reach = 0.02;
  EXPECT_NE(body_warning(report_of(cut), names).text().find("lost a tip that is 14.1 % of its extent long"),
            std::string::npos);
}

TEST(ChangedBodies, DoNotIncludeLoopsThatAreLost) {
  LoopFate lost = square_of(0.02);
  lost.state = LoopFate::State::merged;
  EXPECT_EQ(difference_of(lost), 0);
  lost.state = LoopFate::State::left_out;
  lost.mesh_area = 0;
  EXPECT_EQ(difference_of(lost), 0);
  EXPECT_EQ(body_warning(report_of(lost), names).text(), "");
}

TEST(ChangedBodies, NameTheAreaThatChordsOfHolesAdd) {
  FeatureReport report = report_of(square_of(0.01));
  report.hole_share = 0.0009;
  EXPECT_EQ(body_warning(report, names).text(), "");
  report.hole_share = 0.06;
  EXPECT_EQ(body_warning(report, names).text().find("the mesh is 6 % larger than the shape"), 0u);
}

} // namespace
} // namespace trime::boundary
