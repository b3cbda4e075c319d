// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/log.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace trime {
namespace {

/// A file in memory's stead: what was written to it is read back.
class Stream {
public:
  Stream() : file_(std::tmpfile(), &std::fclose) {}
  std::FILE* file() { return file_.get(); }
  std::string text() {
    std::rewind(file_.get());
    std::string text;
    for (int c = std::fgetc(file_.get()); c != EOF; c = std::fgetc(file_.get()))
      text += static_cast<char>(c);
    return text;
  }

private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// The rows that a log prints of records every third sweep.
std::string rows(LogLevel level, int interval, int last) {
  Stream stream;
  Log log(level, true, stream.file());
  log.set_progress_interval(interval);
  for (int k = 0; k <= last; k += 3) {
    log.phase("sweeps");
    log.progress({k, "live", "head", std::to_string(k), 1, k == 0});
  }
  return stream.text();
}

TEST(Log, PrintsSparseRowsHoweverFarApartTheRecordsAre) {
  EXPECT_EQ(rows(LogLevel::info, 0, 120), "head\n0\n3\n6\n12\n21\n51\n102\n");
}

TEST(Log, PrintsTheFirstRowAtOrAfterEachMultipleOfTheInterval) {
  EXPECT_EQ(rows(LogLevel::info, 10, 45), "head\n0\n12\n21\n30\n42\n");
  EXPECT_EQ(rows(LogLevel::info, 1, 9), "head\n0\n3\n6\n9\n");
}

TEST(Log, ASummaryHasRowsOnlyIfAnIntervalIsSet) {
  EXPECT_EQ(rows(LogLevel::summary, 0, 120), "");
  EXPECT_EQ(rows(LogLevel::summary, 10, 45), "head\n0\n12\n21\n30\n42\n");
}

TEST(Log, QuietPrintsNoProgress) {
  EXPECT_EQ(rows(LogLevel::warning, 1, 30), "");
}

TEST(Log, LeavesNoLiveLineWhereNobodyWatches) {
  rows(LogLevel::info, 0, 30);
  EXPECT_FALSE(live_line_stands());
}

TEST(Log, TellsDurationsAsExactlyAsAForecastIs) {
  EXPECT_EQ(duration_text(0.2), "1 s");
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(140), "2 min");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
}

} // namespace
} // namespace trime
