// SPDX-License-Identifier: BSD-3-Clause
// Writes files that appear whole or not at all: under a temporary name, which is changed after synchronisation. Serial:
// rank 0 only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// @brief Makes an empty file with a new name. The destructor removes it unless it was renamed.
class TemporaryFile {
public:
  /// @param files keeps track of the file, so that a signal handler can remove it; may be null, otherwise it must
  /// outlive this object
  /// @throws FileError also if a file or link with this name exists: files of others are never overwritten
  TemporaryFile(std::string path, RunFiles* files);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  /// @brief Releases reserved space, brings the bytes to the disk, and renames the file. @param replaces if true,
  /// replaces a file with that name
  /// @throws FileError also if that is not a regular file, after following links: pipes and devices are not replaced
  /// @post synchronise_directory must follow
  void rename_to(const std::string& final_path, bool replaces = true);
  /// Renames the file as rename_to does, and writes the directory to the disk. @throws FileError
  void publish(const std::string& final_path);
  /// @brief Only renames the file, and replaces a file with that name. @throws FileError @post synchronise_file_system
  /// must follow
  void rename_before_disk(const std::string& final_path);

private:
  void has_its_name();

  std::string path_;
  RunFiles* files_;
  bool published_ = false;
};

/// Files that are useful only together. Unless complete() was called, the destructor removes all of them.
class FileSet {
public:
  FileSet() = default;
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Adds a file. Must be called before the file gets its final name.
  void add(const std::string& path) { paths_.push_back(path); }
  void complete() { paths_.clear(); }

private:
  std::vector<std::string> paths_;
};

/// [bytes] Longest name of a file or directory in Linux and almost all its file systems.
inline constexpr std::size_t longest_file_name = 255;
/// [bytes] Longest id of a job or process in a temporary name, which is a number of 64 bits.
inline constexpr std::size_t longest_job_id = 20;
/// [bytes] Longest ending that temporary_name adds: ".tmp-", the id, "-", 16 digits.
inline constexpr std::size_t longest_temporary_ending = 5 + longest_job_id + 1 + 16;

/// @brief Says what is wrong with a path that file systems cannot hold, as the end of a sentence; empty if they can.
/// @param added bytes by which its last name becomes longer
std::string length_problem(const std::string& path, std::size_t added);

/// Returns `final_path` + ".tmp-" + the id of the job under SLURM, otherwise of the process, + an unpredictable random
/// part.
std::string temporary_name(const std::string& final_path);

/// @brief Reserves `bytes` of disk space for an existing file without changing its size. If the file system cannot do
/// that, compares with the free space. @throws FileError if there is not enough space
void reserve_space(const std::string& path, std::int64_t bytes);

/// Writes the names of the files next to this one to the disk. @throws FileError
void synchronise_directory(const std::string& path);

/// @brief Brings all files of the file system of `path` to the disk. For many files this is faster than one by one.
/// @throws FileError
void synchronise_file_system(const std::string& path);

/// Writes a text to `final_path`, whole or not at all. @param files may be null @throws FileError
void write_text_file(const std::string& final_path, const std::string& text, RunFiles* files);
/// As write_text_file, for one of several files. @post synchronise_directory must follow
void write_one_text_file(const std::string& final_path, const std::string& text, RunFiles* files);
/// @brief As write_text_file, for one of thousands of files. The file is complete even if the run ends. But if the
/// machine fails before synchronise_file_system is called, the file may be cut off.
void write_text_file_of_many(const std::string& final_path, const std::string& text, RunFiles* files);

/// Makes or replaces the symbolic link `path` to `target` (relative to the directory of `path`). @throws FileError
void replace_link(const std::string& target, const std::string& path);

/// Returns the text of the system for errno.
std::string system_error();

} // namespace trime::io
