// SPDX-License-Identifier: BSD-3-Clause
// The look at the output directory before a run, so that no hour of work ends at a file that may not be written.
#include "io/temporary_file.hpp"
#include "trime/comm/agree.hpp"
#include "trime/io/mesh_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace trime::io {
namespace {

void make_directory(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!std::filesystem::is_directory(directory))
    throw FileError(fmt::format("cannot make the output directory {}: {}; set output.directory", directory,
                                error ? error.message() : "a file of this name is in the way"));
}

/// By really making a file: permissions alone do not tell of read-only and full file systems.
void check_writable(const MeshFileOptions& options) {
  const std::string probe = temporary_name(options.path(".h5"));
  const int descriptor = open(probe.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0)
    throw FileError(fmt::format("cannot write into the output directory {}: {}; set output.directory",
                                options.directory, system_error()));
  close(descriptor);
  unlink(probe.c_str());
}

void check_absent(const MeshFileOptions& options) {
  for (const char* ending : {".h5", ".xdmf", ".vtkhdf"}) {
    const std::string path = options.path(ending);
    struct stat status {};
    if (lstat(path.c_str(), &status) != 0)
      continue;
    if (S_ISDIR(status.st_mode))
      throw FileError(fmt::format("{} is a directory; set output.name or output.directory", path));
    if (!options.overwrite)
      throw FileError(
          fmt::format("{} exists; set output.overwrite = true to replace it, or another output.name", path));
  }
}

std::vector<std::string> leftovers(const MeshFileOptions& options) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(options.directory, error))
    if (entry.path().filename().string().rfind(options.name + ".h5.tmp-", 0) == 0)
      found.push_back(
          fmt::format("{} was left by a run that was killed, or belongs to one that still works on the same "
                      "output; remove it if there is none",
                      entry.path().string()));
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace

std::vector<std::string> check_output(const MeshFileOptions& options, const comm::Communicator& comm) {
  std::vector<std::string> warnings;
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    make_directory(options.directory);
    check_absent(options);
    warnings = leftovers(options);
    check_writable(options);
  });
  return warnings;
}

} // namespace trime::io
