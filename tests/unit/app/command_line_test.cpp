// SPDX-License-Identifier: BSD-3-Clause
// The command line: actions, options that stand for overrides, and what is refused.
#include "app/command_line.hpp"

#include "trime/core/error.hpp"
#include "trime/formats/exchange.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

CommandLine parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "trime_mpi");
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

TEST(CommandLine, ReadsConfigOverridesAndOptionsInAnyOrder) {
  const CommandLine line = parse({"--threads", "3", "a.ini", "shape.hole.radius=0.2", "--quiet", "log.interval=5"});
  EXPECT_EQ(line.action, Action::mesh);
  EXPECT_EQ(line.config, "a.ini");
  EXPECT_EQ(line.overrides,
            (std::vector<std::string>{"shape.hole.radius=0.2", "log.interval=5", "parallel.setup_threads=3",
                                      "parallel.mesh_threads=3", "log.level=warning"}));
  EXPECT_EQ(line.as_given.rfind("trime_mpi --threads 3 a.ini", 0), 0u);
}

TEST(CommandLine, VerboseIsTheLevelOfDetails) {
  EXPECT_EQ(parse({"a.ini", "--verbose"}).overrides, std::vector<std::string>{"log.level=info"});
}

TEST(CommandLine, KnowsItsActions) {
  EXPECT_EQ(parse({"a.ini", "--validate"}).action, Action::validate);
  EXPECT_EQ(parse({"a.ini", "--dry-run"}).action, Action::dry_run);
  EXPECT_EQ(parse({"--print-config", "a.ini"}).action, Action::print_config);
  EXPECT_EQ(parse({"--version"}).action, Action::version);
  EXPECT_EQ(parse({"--help-config"}).action, Action::help_config);
  EXPECT_EQ(parse({"--help"}).action, Action::help);
}

TEST(CommandLine, HelpsWithWhatThereIsAlone) {
  const std::string help = parse({"--help"}).help;
  for (const char* told : {"--log-level", "Exit codes", "signal", "130", "143", "--restart", "--time-limit", "75"})
    EXPECT_NE(help.find(told), std::string::npos) << told;
  for (const formats::FormatInfo& format : formats::all_formats())
    if (format.plan) {
      EXPECT_NE(help.find(format.ending), std::string::npos) << format.ending;
    }
  EXPECT_EQ(help.find("not supported"), std::string::npos);
}

TEST(CommandLine, RestartAndTimeLimit) {
  const CommandLine line = parse({"a.ini", "--restart", "auto", "--time-limit", "01:02:03"});
  EXPECT_EQ(line.restart, "auto");
  EXPECT_EQ(line.time_limit, 3723);
  EXPECT_EQ(parse({"a.ini"}).time_limit, 0);
  EXPECT_EQ(parse({"a.ini"}).restart, "");
}

TEST(CommandLine, RefusesWhatItCannotDo) {
  EXPECT_THROW(parse({}), ConfigError);
  EXPECT_THROW(parse({"--validate"}), ConfigError);
  EXPECT_THROW(parse({"a.ini", "--no-such-option"}), ConfigError);
  EXPECT_THROW(parse({"a.ini", "--threads"}), ConfigError);
  EXPECT_THROW(parse({"a.ini", "--dry-run", "--restart", "f"}), ConfigError);
  for (const char* limit : {"", "10", "1:2", "00:00:00", "00:60:00", "00:00:60", "-1:00:00", "1:00:00x", "1:00:00.5"})
    EXPECT_THROW(parse({"a.ini", "--time-limit", limit}), ConfigError) << limit;
  EXPECT_THROW(parse({"a.ini", "--quiet", "--log-level", "debug"}), ConfigError);
  EXPECT_THROW(parse({"a.ini", "--verbose", "--log-level", "debug"}), ConfigError);
  EXPECT_THROW(parse({"a.ini", "--verbose", "--quiet"}), ConfigError);
}

} // namespace
} // namespace trime::app
