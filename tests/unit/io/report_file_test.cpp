// SPDX-License-Identifier: BSD-3-Clause
#include "io/report_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace trime::io {
namespace {

TEST(ReportFile, HoldsAttributesAndColumnsByName) {
  const Metadata metadata{{{"mesh_hash", ~std::uint64_t{0}}, {"share", 0.1}, {"stop_reason", std::string("done")}},
                          {{"config_text", "a long text"}},
                          {{"timers", {{"ranks", std::int64_t{2}}}, {{"avg", std::vector<double>{0.25, 1e-9}}}}}};
  const nlohmann::json report = nlohmann::json::parse(report_json(metadata, {5, {"out/m.h5"}, {"too far"}}));
  EXPECT_EQ(report["warnings"].get<std::vector<std::string>>(), std::vector<std::string>{"too far"});
  EXPECT_EQ(report["attributes"]["mesh_hash"].get<std::uint64_t>(), ~std::uint64_t{0});
  EXPECT_EQ(report["attributes"]["share"].get<double>(), 0.1); // the same bits
  EXPECT_EQ(report["attributes"]["stop_reason"], "done");
  EXPECT_EQ(report["groups"]["timers"]["attributes"]["ranks"], 2);
  EXPECT_EQ(report["groups"]["timers"]["columns"]["avg"].get<std::vector<double>>(), (std::vector<double>{0.25, 1e-9}));
  EXPECT_EQ(report["format"], "trime_mpi-report");
  EXPECT_EQ(report["format_version"], 1);
  EXPECT_EQ(report["exit_code"], 5);
  EXPECT_EQ(report["files"].get<std::vector<std::string>>(), std::vector<std::string>{"out/m.h5"});
  EXPECT_EQ(report.dump().find("a long text"), std::string::npos);
}

TEST(ReportFile, HoldsWhatJsonCannotAsNullOrReplaced) {
  const Metadata metadata{
      {{"ratio", std::numeric_limits<double>::quiet_NaN()}, {"name", std::string("a\xff")}}, {}, {}};
  const nlohmann::json report = nlohmann::json::parse(report_json(metadata, {5, {"out/m.h5"}}));
  EXPECT_TRUE(report["attributes"]["ratio"].is_null());
  EXPECT_EQ(report["attributes"]["name"], "a\xEF\xBF\xBD");
}

} // namespace
} // namespace trime::io
