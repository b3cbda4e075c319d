// SPDX-License-Identifier: BSD-3-Clause
// Parses the command line of trime_mpi.
#pragma once

#include <string>
#include <vector>

namespace trime::app {

/// The task that the command line gives to the program.
enum class Action { mesh, validate, dry_run, print_config, help, help_config, version, convert, info, refine };

struct CommandLine {
  Action action = Action::mesh;
  std::string config;                 ///< path of the config; empty if the action needs no config
  std::vector<std::string> overrides; ///< section.key=value, including those that follow from options such as --points
  std::vector<std::string> files;     ///< paths given to `convert`, `info` and `refine`
  bool overwrite = false;             ///< for `convert` and `refine`: an existing file may be replaced
  std::string cells = "voronoi";      ///< for `convert`: word of output.cells
  bool in_degrees = false;            ///< for `convert`: longitude and latitude in fort14 and 2dm
  bool prints_all = false;            ///< for `info`: whole lists, however long
  std::string report;                 ///< path of the JSON file for the numbers of the run; empty: no such file
  std::string restart;   ///< path of the checkpoint from which the run continues, or `auto`; empty: the run starts from
                         ///< the beginning
  double time_limit = 0; ///< seconds; 0: no limit
  std::string help;      ///< text of --help
  std::string as_given;  ///< the whole command line as given, for the metadata of the mesh
};

/// Parses the command line.
/// @throws ConfigError for unknown options, missing arguments and wrong values
CommandLine parse_command_line(int argc, const char* const* argv);

} // namespace trime::app
