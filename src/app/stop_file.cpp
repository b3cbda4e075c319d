// SPDX-License-Identifier: BSD-3-Clause
#include "app/stop_file.hpp"

#include "app/checkpoint_names.hpp"
#include "comm/agree.hpp"
#include "core/read_file.hpp"
#include "formats/output_files.hpp"
#include "trime/core/error.hpp"

#include <filesystem>

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

bool is_input(const std::string& file, const RunOptions& options, const CommandLine& line) {
  for (const PartOptions& part : options.parts)
    if (is_same(file, part.file) || is_beside_shapefile(file, part.file))
      return true;
  return is_same(file, options.fixed_points.file) || is_same(file, options.start_file) || is_same(file, line.restart);
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

void check(const std::string& file, const RunOptions& options, const CommandLine& line) {
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

} // namespace

void check_stop_file(const RunOptions& options, const CommandLine& line, const comm::Communicator& comm) {
  if (options.checkpoint.stop_file.empty())
    return;
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      check(options.checkpoint.stop_file, options, line);
  });
}

} // namespace trime::app
