// SPDX-License-Identifier: BSD-3-Clause
// The look at the output directory before a run, so that no hour of work ends at a file that may not be written.
#include "formats/output_files.hpp"

#include "comm/agree.hpp"
#include "core/quoted.hpp"
#include "core/read_file.hpp"
#include "io/temporary_file.hpp"
#include "trime/core/error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

namespace trime::formats {
namespace {

constexpr const auto& view_endings = io::mesh_file_endings;
constexpr const char *xdmf_collection_ending = "_series.xdmf", *vtkhdf_collection_ending = ".vtkhdf.series";
constexpr const char* step_infix = "_step_";

/// Files in it have a name, too.
void check_length(const std::string& directory) {
  if (const std::string problem = io::length_problem(directory + "/", io::longest_file_name); !problem.empty())
    throw FileError(
        fmt::format("cannot make the output directory {}: {}; set output.directory", shown(directory), problem));
}

void make_directory(const std::string& directory) {
  check_length(directory);
  std::error_code error, ignored;
  std::filesystem::create_directories(directory, error);
  if (!std::filesystem::is_directory(directory, ignored))
    throw FileError(fmt::format("cannot make the output directory {}: {}; set output.directory", directory,
                                error ? error.message() : "a file of this name is in the way"));
}

/// Really makes a file: permissions alone do not show read-only and full file systems.
void check_writable(const std::string& directory, const std::string& name) {
  const std::string probe = io::temporary_name(directory + "/" + name + ".h5");
  const int descriptor = open(probe.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw FileError(fmt::format("cannot write into the output directory {}: {}; set output.directory", directory,
                                io::system_error()));
  close(descriptor);
  unlink(probe.c_str());
}

/// @brief Could make_directory and check_writable do their work? By permissions alone, since nothing is made.
void check_could_be_made(const std::string& directory) {
  check_length(directory);
  std::error_code error;
  std::filesystem::path existing = std::filesystem::absolute(directory, error).lexically_normal();
  while (!std::filesystem::exists(std::filesystem::symlink_status(existing, error)) && existing.has_relative_path())
    existing = existing.parent_path();
  if (!std::filesystem::is_directory(existing, error))
    throw FileError(fmt::format("cannot make the output directory {}: {} is not a directory; set output.directory",
                                directory, existing.string()));
  if (access(existing.c_str(), W_OK | X_OK) != 0)
    throw FileError(fmt::format("cannot write into the output directory {}: {}: {}; set output.directory", directory,
                                existing.string(), io::system_error()));
}

/// A link to nothing, too.
bool is_there(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0;
}

void check_absent(const std::string& path, bool overwrite) {
  refuse_to_replace(path, overwrite, "set output.name or output.directory",
                    "set output.overwrite = true to replace it, or another output.name");
}

/// "NAME_step_000012.h5" and its views.
bool is_step_file(const std::string& file, const std::string& name) {
  const std::string start = step_name_start(name);
  if (!file.starts_with(start))
    return false;
  const std::size_t end = file.find_first_not_of("0123456789", start.size());
  return end != std::string::npos && end > start.size() &&
         std::find(view_endings.begin(), view_endings.end(), file.substr(end)) != view_endings.end();
}

/// Paths in a directory, which need not exist, whose file names are of a kind; sorted.
std::vector<std::string> files_in(const std::string& directory, const std::function<bool(const std::string&)>& is_of) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error))
    if (is_of(entry.path().filename().string()))
      found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> leftovers(const io::MeshFileOptions& options) {
  std::vector<std::string> told;
  const auto is_left = [&](const std::string& file) {
    return file.starts_with(options.name) && file.find(".tmp-") != std::string::npos &&
           (file[options.name.size()] == '.' || file.compare(options.name.size(), 6, step_infix) == 0);
  };
  for (const std::string& path : files_in(options.directory, is_left))
    told.push_back(fmt::format("{} was left by a run that was killed, or belongs to a run that still writes the same "
                               "output; remove it if there is no such run",
                               path));
  return told;
}

/// A word if the disk has less room than the run is known to need; how many steps there will be is not.
std::string space_warning(const SeriesOptions& options, double points) {
  constexpr double h5_bytes = 190, text_bytes = 700; // of a point with its two triangles
  const double bytes = points * (h5_bytes + (options.wants(Format::text) ? text_bytes : 0)) * (options.steps ? 2 : 1);
  struct statvfs space {};
  if (statvfs(options.file.directory.c_str(), &space) != 0 || space.f_blocks == 0) // some file systems do not know
    return "";
  const double available = static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize);
  return available >= bytes
             ? ""
             : fmt::format("the files of this run need {} {:.0f} MiB, but only {:.0f} MiB are free in {}; free some "
                           "space, or set output.directory",
                           options.steps ? "at least" : "about", bytes / 0x1p20, available / 0x1p20,
                           options.file.directory);
}

/// Nothing may be in the way of the files of this run.
void check_all_absent(const SeriesOptions& options) {
  const io::MeshFileOptions& file = options.file;
  for (const char* ending : view_endings)
    check_absent(file.path(ending), file.overwrite);
  for (const std::string& path : options.export_paths())
    check_absent(path, file.overwrite);
  if (options.steps || options.wants(Format::text))
    for (const std::string& path : files_of_series(options))
      check_absent(path, file.overwrite);
}

/// Returns warnings about files that an older run left, and about a disk that is too small.
std::vector<std::string> warnings_for(const SeriesOptions& options, double expected_points) {
  std::vector<std::string> warnings = leftovers(options.file);
  if (const std::string warning = space_warning(options, expected_points); !warning.empty())
    warnings.push_back(warning);
  return warnings;
}

} // namespace

void refuse_to_replace(const std::string& path, bool overwrite, const char* other_name, const char* advice) {
  if (const std::string problem = io::length_problem(path, io::longest_temporary_ending); !problem.empty())
    throw FileError(fmt::format("{} cannot be written: {}; choose a shorter one", shown(path), problem));
  if (!is_there(path))
    return;
  if (const std::string kind = irregular_kind(path); !kind.empty())
    throw FileError(fmt::format("{} is {}, which is not replaced; {}", path, kind, other_name));
  if (!overwrite)
    throw FileError(fmt::format("{} exists; {}", path, advice));
}

void refuse_to_replace(const std::vector<std::string>& paths, bool overwrite, const char* advice,
                       const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      for (const std::string& path : paths)
        refuse_to_replace(path, overwrite, "choose another name", advice);
  });
}

std::string step_name_start(const std::string& name) {
  return name + step_infix;
}

std::string step_name(const std::string& name, int retriangulation) {
  return fmt::format("{}{:06d}", step_name_start(name), retriangulation);
}

std::string xdmf_collection(const io::MeshFileOptions& options) {
  return options.path(xdmf_collection_ending);
}

std::string vtkhdf_collection(const io::MeshFileOptions& options) {
  return options.path(vtkhdf_collection_ending);
}

bool is_file_of_run(const std::string& file, const std::string& name) {
  const auto is = [&](const char* ending) { return file == name + ending; };
  return std::any_of(view_endings.begin(), view_endings.end(), is) || is(xdmf_collection_ending) ||
         is(vtkhdf_collection_ending) || is_step_file(file, name);
}

std::vector<std::string> files_of_series(const SeriesOptions& options) {
  const io::MeshFileOptions& file = options.file;
  std::vector<std::string> found =
      files_in(file.directory, [&](const std::string& name) { return is_step_file(name, file.name); });
  for (const std::string& path : {xdmf_collection(file), vtkhdf_collection(file)})
    if (is_there(path))
      found.push_back(path);
  const std::vector<std::string> texts =
      files_in(file.path(""), [&](const std::string& name) { return is_text_mesh_file(name, file.name); });
  found.insert(found.end(), texts.begin(), texts.end());
  return found;
}

std::vector<std::string> check_files(const SeriesOptions& options, double expected_points) {
  const io::MeshFileOptions& file = options.file;
  make_directory(file.directory);
  check_all_absent(options);
  if (options.wants(Format::text))
    make_directory(file.path(""));
  std::vector<std::string> warnings = warnings_for(options, expected_points);
  check_writable(file.directory, file.name);
  return warnings;
}

std::vector<std::string> look_at_files(const SeriesOptions& options, double expected_points) {
  check_could_be_made(options.file.directory);
  if (options.wants(Format::text))
    check_could_be_made(options.file.path(""));
  check_all_absent(options);
  return warnings_for(options, expected_points);
}

} // namespace trime::formats
