// SPDX-License-Identifier: BSD-3-Clause
// Files that appear whole or not at all: written under a temporary name, synchronised, renamed. Serial: rank 0 only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// @brief Makes an empty file of a name that nothing has, and removes it at the end of its life unless it was renamed.
/// One object at a time.
class TemporaryFile {
public:
  /// @param files notes the file, so that a signal handler can remove it; may be null, else must outlive this object
  /// @throws FileError also if there is anything of this name, a link too: what others put there is never written to
  TemporaryFile(std::string path, RunFiles* files);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  /// @brief Gives back reserved space, brings the bytes to the disk, then renames. @param replaces what has that name
  /// @throws FileError also where that is no regular file, seen through links: a pipe or a device stays
  /// @post synchronise_directory will do the rest
  void rename_to(const std::string& final_path, bool replaces = true);
  /// Does the same, then writes the directory to the disk. @throws FileError
  void publish(const std::string& final_path);
  /// @brief The rename alone, which replaces what has that name. @throws FileError
  /// @post synchronise_file_system will do the rest
  void rename_before_disk(const std::string& final_path);

private:
  void has_its_name();

  std::string path_;
  RunFiles* files_;
  bool published_ = false;
};

/// Files that are of use only together. Unless complete() was called, the destructor removes all of them.
class FileSet {
public:
  FileSet() = default;
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Call it before the file gets its final name.
  void add(const std::string& path) { paths_.push_back(path); }
  void complete() { paths_.clear(); }

private:
  std::vector<std::string> paths_;
};

/// Bytes of the name of a file or directory, by the limit of Linux and of nearly all its file systems.
inline constexpr std::size_t longest_file_name = 255;
/// Bytes of the id of a job or process in a temporary name: a number of 64 bits.
inline constexpr std::size_t longest_job_id = 20;
/// Bytes that temporary_name adds at most: ".tmp-", the id, "-", 16 digits.
inline constexpr std::size_t longest_temporary_ending = 5 + longest_job_id + 1 + 16;

/// @brief Says what is wrong with a path that file systems cannot hold, as the end of a sentence; empty if they can.
/// @param added bytes by which its last name becomes longer
std::string length_problem(const std::string& path, std::size_t added);

/// `final_path` + ".tmp-" + the job's id under SLURM, else the process id + a random part that nobody can foresee.
std::string temporary_name(const std::string& final_path);

/// @brief Takes `bytes` of disk space for a file that exists, without changing its size; where the file system cannot
/// do that, compares with the free space. @throws FileError if there is not enough
void reserve_space(const std::string& path, std::int64_t bytes);

/// Writes the names of the files next to this one to the disk. @throws FileError
void synchronise_directory(const std::string& path);

/// @brief Brings all files of the file system on which this one lies to the disk: sooner done than one by one where
/// they are many. @throws FileError
void synchronise_file_system(const std::string& path);

/// Writes a text to `final_path`, whole or not at all. @param files may be null @throws FileError
void write_text_file(const std::string& final_path, const std::string& text, RunFiles* files);
/// Does the same for one of several files. @post synchronise_directory must follow
void write_one_text_file(const std::string& final_path, const std::string& text, RunFiles* files);
/// @brief Does the same for one of thousands of files. The file appears complete even if the run ends. But if the
/// machine fails before synchronise_file_system was called, it may be cut off.
void write_text_file_of_many(const std::string& final_path, const std::string& text, RunFiles* files);

/// Makes or replaces the symbolic link `path` to `target` (relative to the directory of `path`). @throws FileError
void replace_link(const std::string& target, const std::string& path);

/// The system's words for errno.
std::string system_error();

} // namespace trime::io
