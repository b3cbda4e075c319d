// SPDX-License-Identifier: BSD-3-Clause
#include "app/command_line.hpp"

#include "core/quoted.hpp"
#include "trime/core/error.hpp"
#include "trime/formats/exchange.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <optional>
#include <utility>

namespace trime::app {
namespace {

struct Flags {
  bool help_config = false, version = false, validate = false, dry_run = false, print_config = false, quiet = false,
       verbose = false, overwrite = false, degrees = false, all = false;
  std::optional<std::string> threads, level, time_limit, cells;
};

void declare(CLI::App& app, CommandLine& line, Flags& flags) {
  app.add_option("CONFIG", line.config, "config file, for example configs/square.ini");
  app.add_option("overrides", line.overrides,
                 "section.key=value: replaces the value in the file; an empty value restores the default")
      ->expected(0, -1);
  app.add_flag("--help-config", flags.help_config, "list all keys of a config file");
  app.add_flag("--version", flags.version, "print the versions of the program and of its libraries");
  app.add_flag("--validate", flags.validate,
               "check config, shape and output files and estimate the memory, without making a mesh");
  app.add_flag("--dry-run", flags.dry_run,
               "like --validate, and also report how the work is divided, what will be simplified, and how many points "
               "would keep every feature of the shape");
  app.add_flag("--print-config", flags.print_config, "print the config with all defaults, as a complete file");
  app.add_flag("--overwrite", flags.overwrite, "with convert and refine: replace the file OUT if it exists");
  app.add_flag("--degrees", flags.degrees,
               "with convert: write longitude and latitude into .14, .gr3, _grd.dat and .2dm");
  app.add_option("--cells", flags.cells,
                 "with convert: voronoi, whole or triangles, the cells in _mpas.nc, .disv, .uge and .tough")
      ->check(CLI::IsMember({"voronoi", "whole", "triangles"}));
  app.add_flag("--all", flags.all, "with info: print whole lists of names, however long");
  app.add_option("--report", line.report, "write the report of the run to this file, as JSON");
  app.add_option("--record", line.report)->group(""); // its name in earlier versions; not in the help
  app.add_option("--threads", flags.threads, "threads per rank: sets parallel.setup_threads and parallel.mesh_threads");
  app.add_option("--log-level", flags.level, "debug, info, summary, warning, error or silent: sets log.level");
  app.add_flag("--verbose", flags.verbose, "also print what each phase does, some sweeps and the whole report");
  app.add_flag("--quiet", flags.quiet, "print only warnings and errors");
  app.add_option("--restart", line.restart,
                 "continue from a checkpoint: its file, or `auto` for the newest one of this config, if there is one");
  app.add_option("--time-limit", flags.time_limit,
                 "HH:MM:SS: write a checkpoint and stop before this much time has passed (exit code 75)");
  app.footer("Exit codes: 0 done, 1 internal error, 2 wrong usage or config (or too few points for the boundary),\n3 "
             "wrong geometry, 4 a file cannot be read or written.\nExit code 5: the mesh is written but marked as "
             "incomplete (too many sweeps, or a failed check).\nExit code 6: out of memory. Exit code 75: stopped at a "
             "checkpoint; continue with --restart auto.\nSignals: USR1 writes a checkpoint and stops the run, USR2 "
             "writes a checkpoint.\nA run that signal n ends has exit code 128 + n (130: Ctrl-C, 143: SIGTERM; mpirun "
             "returns 1), and\nsays whether it has written the final mesh.");
}

/// The words that stand in the place of a config and have files behind them. A config of such a name is ./convert.
Action action_of(const CommandLine& line, const Flags& flags) {
  return line.config == "convert"  ? Action::convert
         : line.config == "info"   ? Action::info
         : line.config == "refine" ? Action::refine
         : flags.version           ? Action::version
         : flags.help_config       ? Action::help_config
         : flags.print_config      ? Action::print_config
         : flags.validate          ? Action::validate
         : flags.dry_run           ? Action::dry_run
                                   : Action::mesh;
}

/// The words behind the program name for which files follow.
const char* usage_of(Action action) {
  return action == Action::convert  ? "convert IN.h5 OUT.ENDING [--overwrite] [--degrees] [--cells KIND]"
         : action == Action::refine ? "refine IN.h5 OUT.h5 [--overwrite]"
                                    : "info FILE.h5 [--all]";
}

/// The files of convert, info and refine are what a run takes for overrides.
void take_files(CommandLine& line, const Flags& flags) {
  const bool converts = line.action == Action::convert, refines = line.action == Action::refine;
  line.overwrite = flags.overwrite;
  if (flags.overwrite && !converts && !refines)
    throw ConfigError(
        "'--overwrite' belongs to 'trime_mpi convert' and 'trime_mpi refine'; for a run, set output.overwrite=true");
  line.in_degrees = flags.degrees;
  if (flags.degrees && !converts)
    throw ConfigError("'--degrees' belongs to 'trime_mpi convert'; for a run, set output.coordinates=degrees");
  if (flags.cells && !converts)
    throw ConfigError("'--cells' belongs to 'trime_mpi convert'; for a run, set output.cells");
  if (flags.cells)
    line.cells = *flags.cells;
  line.prints_all = flags.all;
  if (flags.all && line.action != Action::info)
    throw ConfigError("'--all' belongs to 'trime_mpi info', which prints whole lists with it");
  if (!converts && !refines && line.action != Action::info)
    return;
  line.files = std::exchange(line.overrides, {});
  if (line.files.size() != (line.action == Action::info ? 1U : 2U))
    throw ConfigError(fmt::format("'trime_mpi {}' needs {}, found {} file{}; usage: trime_mpi {}", line.config,
                                  line.action == Action::info ? "one file" : "two files", line.files.size(),
                                  line.files.size() == 1 ? "" : "s", usage_of(line.action)));
}

/// Returns the seconds of HH:MM:SS. @throws ConfigError
double seconds_of(const std::string& text) {
  int hours = 0, minutes = 0, seconds = 0, used = 0;
  const int found = std::sscanf(text.c_str(), "%4d:%2d:%2d%n", &hours, &minutes, &seconds, &used);
  if (found != 3 || static_cast<std::size_t>(used) != text.size() || hours < 0 || minutes < 0 || minutes > 59 ||
      seconds < 0 || seconds > 59 || hours + minutes + seconds == 0)
    throw ConfigError(fmt::format("'--time-limit {}': expected hours, minutes and seconds as HH:MM:SS, more than 0; "
                                  "for example 00:55:00",
                                  shown(text)));
  return 3600.0 * hours + 60 * minutes + seconds;
}

void refuse_what_is_missing(const CommandLine& line, const Flags& flags) {
  if ((!line.restart.empty() || flags.time_limit) && line.action != Action::mesh)
    throw ConfigError("'--restart' and '--time-limit' need a run that makes a mesh; leave them out here");
  const bool needs_config =
      line.action != Action::version && line.action != Action::help_config && line.action != Action::help;
  if (needs_config && line.config.empty())
    throw ConfigError("the config file is missing; usage: trime_mpi CONFIG [section.key=value ...], see --help");
  if (!line.report.empty() && line.action != Action::mesh)
    throw ConfigError("'--report' needs a run that makes a mesh; leave it out here");
  if (flags.quiet + flags.verbose + flags.level.has_value() > 1)
    throw ConfigError("'--quiet', '--verbose' and '--log-level' contradict each other; give one of them");
}

/// " .msh .msh2 ...", the formats into which meshes are converted.
std::string endings() {
  std::string text;
  for (const formats::FormatInfo& format : formats::all_formats())
    if (format.plan)
      text += std::string(" ") + format.ending;
  return text;
}

std::string description() {
  return "Distributed generator of large 2D triangle meshes.\n"
         "[mpirun -np RANKS] trime_mpi CONFIG [section.key=value ...] [OPTIONS]\n"
         "[mpirun -np RANKS] trime_mpi convert IN.h5 OUT.ENDING   a mesh in the format of another program:\n"
         "                  " +
         endings() +
         ", see configs/formats.md\n"
         "[mpirun -np RANKS] trime_mpi refine IN.h5 OUT.h5   the mesh with four triangles in place of each one\n"
         "trime_mpi info FILE.h5 [--all]   what is in a mesh file; --all prints whole lists";
}

} // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  Flags flags;
  CLI::App app(description(), "trime_mpi");
  declare(app, line, flags);
  for (int k = 0; k < argc; ++k)
    line.as_given += (k > 0 ? " " : "") + std::string(argv[k]);
  try {
    app.parse(argc, argv);
    line.action = action_of(line, flags);
  } catch (const CLI::CallForHelp&) {
    line.action = Action::help;
    line.help = app.help();
  } catch (const CLI::ParseError& error) {
    throw ConfigError(fmt::format("command line: {}; see --help", without_middle(error.what())));
  }
  take_files(line, flags);
  if (flags.time_limit)
    line.time_limit = seconds_of(*flags.time_limit);
  refuse_what_is_missing(line, flags);
  if (flags.threads)
    for (const char* key : {"parallel.setup_threads=", "parallel.mesh_threads="})
      line.overrides.push_back(key + *flags.threads);
  if (flags.level)
    line.overrides.push_back("log.level=" + *flags.level);
  if (flags.verbose)
    line.overrides.push_back("log.level=info");
  if (flags.quiet)
    line.overrides.push_back("log.level=warning");
  return line;
}

} // namespace trime::app
