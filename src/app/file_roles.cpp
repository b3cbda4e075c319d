// SPDX-License-Identifier: BSD-3-Clause
#include "app/file_roles.hpp"

#include "app/checkpoint_names.hpp"
#include "comm/agree.hpp"
#include "core/read_file.hpp"
#include "formats/output_files.hpp"
#include "trime/core/error.hpp"

#include <filesystem>
#include <vector>

namespace trime::app {
namespace {

namespace fs = std::filesystem;

/// Without links, as far as the path exists.
fs::path place_of(const fs::path& path) {
  std::error_code error;
  const fs::path found = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path.lexically_normal() : found;
}

bool is_same(const std::string& a, const std::string& b) {
  std::error_code error; // files that are not there are not equivalent
  return !b.empty() && (place_of(a) == place_of(b) || fs::equivalent(a, b, error));
}

/// The files next to a shapefile are read with it.
bool is_beside_shapefile(const std::string& file, const std::string& contour) {
  return fs::path(contour).extension() == ".shp" &&
         place_of(file).replace_extension() == place_of(contour).replace_extension();
}

/// Files of the user, which no program can make again.
std::vector<std::string> inputs_of(const RunOptions& options) {
  std::vector<std::string> inputs{options.fixed_points.file};
  const auto add = [&](const auto& sections) {
    for (const auto& section : sections)
      inputs.push_back(section.file);
  };
  add(options.parts);
  add(options.regions);
  add(options.curves);
  add(options.fields);
  std::erase(inputs, "");
  return inputs;
}

bool is_input(const std::string& file, const RunOptions& options, const CommandLine& line) {
  for (const std::string& input : inputs_of(options))
    if (is_same(file, input) || is_beside_shapefile(file, input))
      return true;
  return is_same(file, options.start_file) || is_same(file, line.restart);
}

bool is_output(const std::string& file, const RunOptions& options, const CommandLine& line) {
  const io::MeshFileOptions& output = options.output.file;
  for (const std::string& path : options.output.export_paths())
    if (is_same(file, path))
      return true;
  const fs::path place = place_of(file), folder = place.parent_path();
  const std::string name = place.filename().string();
  return is_same(file, line.report) ||
         (folder == place_of(output.directory) &&
          (formats::is_file_of_run(name, output.name) || checkpoint_slot(name, output.name) > 0)) ||
         (folder == place_of(output.path("")) && formats::is_text_mesh_file(name, output.name));
}

void check_stop_file(const std::string& file, const RunOptions& options, const CommandLine& line) {
  if (const std::string kind = irregular_kind(file); !kind.empty())
    throw FileError(fmt::format("'stop_file = {}' in [checkpoint]: expected the name of a regular file, or of none "
                                "yet, found {}; choose another name",
                                file, kind));
  const char* role = is_same(file, line.config)       ? "the config"
                     : is_input(file, options, line)  ? "an input of the run"
                     : is_output(file, options, line) ? "an output of the run"
                                                      : nullptr;
  if (role)
    throw ConfigError(fmt::format("'stop_file = {}' in [checkpoint] is {}, and a run removes the stop file that it "
                                  "finds; choose a name that no other file has",
                                  file, role));
}

void check_inputs(const RunOptions& options, const CommandLine& line) {
  std::vector<std::string> files = inputs_of(options);
  files.push_back(line.config);
  CommandLine writing = line;
  if (std::error_code error; fs::is_symlink(line.report, error))
    writing.report.clear(); // a link is refused later
  for (const std::string& file : files)
    if (is_output(file, options, writing))
      throw ConfigError(fmt::format("{} is {}, and an output of the run has the same path; set output.name or "
                                    "output.directory, so that the run does not replace it",
                                    file, file == line.config ? "the config" : "an input of the run"));
}

/// The report replaces what stands at its path, also where the run writes no mesh.
void check_report(const RunOptions& options, const CommandLine& line) {
  if (std::error_code error; line.report.empty() || fs::is_symlink(line.report, error))
    return; // a link is refused later
  CommandLine others = line;
  others.report.clear();
  const char* role = is_same(line.report, line.config)                          ? "the config"
                     : is_input(line.report, options, line)                     ? "an input of the run"
                     : options.write && is_output(line.report, options, others) ? "another output of the run"
                                                                                : nullptr;
  if (role)
    throw ConfigError(fmt::format("'--report {}' is {}; choose a name that no other file has", line.report, role));
}

} // namespace

void check_file_roles(const RunOptions& options, const CommandLine& line, const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    if (const std::string& stop_file = options.checkpoint.stop_file; !stop_file.empty())
      check_stop_file(stop_file, options, line);
    check_report(options, line);
    if (options.write)
      check_inputs(options, line);
  });
}

} // namespace trime::app
