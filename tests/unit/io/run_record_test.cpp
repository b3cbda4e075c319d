// SPDX-License-Identifier: BSD-3-Clause
#include "io/run_record.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace trime::io {
namespace {

TEST(RunRecord, HoldsAttributesAndColumnsByName) {
  const Metadata metadata{{{"mesh_hash", ~std::uint64_t{0}}, {"share", 0.1}, {"stop_reason", std::string("done")}},
                          {{"config_text", "a long text"}},
                          {{"timers", {{"ranks", std::int64_t{2}}}, {{"avg", std::vector<double>{0.25, 1e-9}}}}}};
  const nlohmann::json record = nlohmann::json::parse(record_text(metadata));
  EXPECT_EQ(record["attributes"]["mesh_hash"].get<std::uint64_t>(), ~std::uint64_t{0});
  EXPECT_EQ(record["attributes"]["share"].get<double>(), 0.1); // the same bits
  EXPECT_EQ(record["attributes"]["stop_reason"], "done");
  EXPECT_EQ(record["groups"]["timers"]["attributes"]["ranks"], 2);
  EXPECT_EQ(record["groups"]["timers"]["columns"]["avg"].get<std::vector<double>>(), (std::vector<double>{0.25, 1e-9}));
  EXPECT_EQ(record.dump().find("a long text"), std::string::npos);
}

TEST(RunRecord, HoldsWhatJsonCannotAsNullOrReplaced) {
  const Metadata metadata{
      {{"ratio", std::numeric_limits<double>::quiet_NaN()}, {"name", std::string("a\xff")}}, {}, {}};
  const nlohmann::json record = nlohmann::json::parse(record_text(metadata));
  EXPECT_TRUE(record["attributes"]["ratio"].is_null());
  EXPECT_EQ(record["attributes"]["name"], "a\xEF\xBF\xBD");
}

} // namespace
} // namespace trime::io
