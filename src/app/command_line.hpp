// SPDX-License-Identifier: BSD-3-Clause
// The command line of trime_mpi.
#pragma once

#include <string>
#include <vector>

namespace trime::app {

/// The task of the program.
enum class Action { mesh, validate, dry_run, print_config, help, help_config, version, convert, info };

struct CommandLine {
  Action action = Action::mesh;
  std::string config;                 ///< path; empty only where none is needed
  std::vector<std::string> overrides; ///< section.key=value, those that options stand for included
  std::vector<std::string> files;     ///< files of convert and info
  bool overwrite = false;             ///< convert: the file may be there
  std::string report;                 ///< where the numbers of the run go as JSON; empty: nowhere
  std::string restart;                ///< a checkpoint to go on from, or `auto`; empty: from the start
  double time_limit = 0;              ///< seconds; 0: none
  std::string help;                   ///< text of --help
  std::string as_given;               ///< the whole line, for the records
};

/// @throws ConfigError for a line that cannot be obeyed
CommandLine parse_command_line(int argc, const char* const* argv);

} // namespace trime::app
