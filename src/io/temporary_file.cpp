// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporary_file.hpp"

#include "core/quoted.hpp"
#include "core/read_file.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace trime::io {
namespace {

/// Writes a file or directory to the disk, or with `syncfs` its whole file system. Ignores file systems that cannot do
/// it.
void synchronise(const std::string& path, int flags, int (*to_disk)(int descriptor)) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0)
    throw FileError(fmt::format("cannot open {}: {}", path, system_error()));
  const int result = to_disk(descriptor);
  const bool forgiven = errno == EINVAL || errno == ENOTSUP || errno == EROFS;
  const std::string reason = system_error();
  ::close(descriptor);
  if (result != 0 && !forgiven)
    throw FileError(fmt::format("cannot write {} to disk: {}", path, reason));
}

/// A pipe or a device is not for us to replace, nor is what a link to one stands for.
void refuse_irregular(const std::string& path) {
  if (const std::string kind = irregular_kind(path); !kind.empty())
    throw FileError(fmt::format("cannot write {}: it is {}, and only regular files are replaced; remove it, or choose "
                                "another name",
                                path, kind));
}

/// False if there is something of that name, which stays.
bool rename_to_absent(const std::string& path, const std::string& final_path) {
  if (renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, final_path.c_str(), RENAME_NOREPLACE) == 0)
    return true;
  if (errno == EEXIST)
    return false;
  struct stat status {}; // some file systems cannot do it in one step
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP)
    throw FileError(fmt::format("cannot rename {} to {}: {}", path, final_path, system_error()));
  if (lstat(final_path.c_str(), &status) == 0)
    return false;
  if (std::rename(path.c_str(), final_path.c_str()) != 0)
    throw FileError(fmt::format("cannot rename {} to {}: {}", path, final_path, system_error()));
  return true;
}

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

void write_text(const TemporaryFile& temporary, const std::string& text) {
  std::FILE* file = std::fopen(temporary.path().c_str(), "wb");
  if (!file)
    throw FileError(fmt::format("cannot create {}: {}", temporary.path(), system_error()));
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed)
    throw FileError(fmt::format("cannot write {}: {}", temporary.path(), system_error()));
}

} // namespace

std::string system_error() {
  return std::strerror(errno);
}

TemporaryFile::TemporaryFile(std::string path, RunFiles* files) : path_(std::move(path)), files_(files) {
  if (files_)
    files_->start_writing(path_);
  const int descriptor = open(path_.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    const std::string reason = system_error();
    if (files_)
      files_->stop_writing();
    throw FileError(fmt::format("cannot create {}: {}", path_, reason));
  }
  ::close(descriptor);
}

TemporaryFile::~TemporaryFile() {
  if (files_)
    files_->stop_writing();
  if (!published_)
    unlink(path_.c_str());
}

void TemporaryFile::publish(const std::string& final_path) {
  rename_to(final_path);
  synchronise_directory(final_path);
}

void TemporaryFile::rename_to(const std::string& final_path, bool replaces) {
  struct stat status {};
  if (stat(path_.c_str(), &status) == 0 && truncate(path_.c_str(), status.st_size) != 0)
    throw FileError(fmt::format("cannot write {}: {}", path_, system_error()));
  synchronise(path_, O_RDWR, fsync);
  if (!replaces && !rename_to_absent(path_, final_path))
    throw FileError(
        fmt::format("another program has written {} since this run began, and output.overwrite = false, so the new "
                    "mesh is not written; set output.overwrite = true to replace it, or another output.name",
                    final_path));
  if (replaces)
    rename_before_disk(final_path);
  has_its_name();
}

void TemporaryFile::rename_before_disk(const std::string& final_path) {
  refuse_irregular(final_path);
  if (std::rename(path_.c_str(), final_path.c_str()) != 0)
    throw FileError(fmt::format("cannot rename {} to {}: {}", path_, final_path, system_error()));
  has_its_name();
}

void TemporaryFile::has_its_name() {
  published_ = true;
  if (files_)
    files_->stop_writing();
}

FileSet::~FileSet() {
  for (const std::string& path : paths_)
    unlink(path.c_str());
}

void synchronise_directory(const std::string& path) {
  synchronise(directory_of(path), O_RDONLY | O_DIRECTORY, fsync);
}

void synchronise_file_system(const std::string& path) {
  synchronise(directory_of(path), O_RDONLY | O_DIRECTORY, syncfs);
}

std::string length_problem(const std::string& path, std::size_t added) {
  if (path.size() + added >= PATH_MAX)
    return fmt::format("its path has {} bytes, expected fewer than {}", path.size(), PATH_MAX - added);
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    const std::size_t most = longest_file_name - (end == path.size() ? added : 0);
    if (end - at > most)
      return fmt::format("expected names of at most {} bytes{}, found {} with {}", most,
                         added > 0 && end == path.size() ? ", since a file has a longer name while it is written" : "",
                         trime::quoted(path.substr(at, end - at)), end - at);
    at = end + 1;
  }
  return {};
}

std::string temporary_name(const std::string& final_path) {
  const char* job = std::getenv("SLURM_JOB_ID");
  std::uint64_t random = 0;
  if (getrandom(&random, sizeof random, GRND_NONBLOCK) != sizeof random) // a machine that has just started
    random = static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  return fmt::format("{}.tmp-{}-{:016x}", final_path,
                     job && *job ? std::string(job).substr(0, longest_job_id) : std::to_string(getpid()), random);
}

void reserve_space(const std::string& path, std::int64_t bytes) {
  const auto too_small = [&](const std::string& reason) {
    return FileError(fmt::format("{} needs {:.1f} MiB: {}; free some space, or set output.directory", path,
                                 static_cast<double>(bytes) / 0x1p20, reason));
  };
  const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0)
    throw FileError(fmt::format("cannot open {}: {}", path, system_error()));
  const int result = fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, bytes);
  const int code = errno;
  struct statvfs space {};
  const bool known = fstatvfs(descriptor, &space) == 0;
  ::close(descriptor);
  if (result == 0)
    return;
  if (code == ENOSPC || code == EDQUOT || code == EFBIG)
    throw too_small(std::strerror(code));
  const double available = static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize);
  if (known && space.f_blocks > 0 && available < static_cast<double>(bytes)) // some file systems do not know
    throw too_small(fmt::format("only {:.1f} MiB are free", available / 0x1p20));
}

void write_text_file(const std::string& final_path, const std::string& text, RunFiles* files) {
  write_one_text_file(final_path, text, files);
  synchronise_directory(final_path);
}

void write_one_text_file(const std::string& final_path, const std::string& text, RunFiles* files) {
  TemporaryFile temporary(temporary_name(final_path), files);
  write_text(temporary, text);
  temporary.rename_to(final_path);
}

void write_text_file_of_many(const std::string& final_path, const std::string& text, RunFiles* files) {
  TemporaryFile temporary(temporary_name(final_path), files);
  write_text(temporary, text);
  temporary.rename_before_disk(final_path);
}

void replace_link(const std::string& target, const std::string& path) {
  refuse_irregular(path);
  const std::string temporary = temporary_name(path);
  if (symlink(target.c_str(), temporary.c_str()) != 0 || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string reason = system_error();
    unlink(temporary.c_str());
    throw FileError(fmt::format("cannot make the link {} to {}: {}", path, target, reason));
  }
}

} // namespace trime::io
