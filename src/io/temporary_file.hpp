// SPDX-License-Identifier: BSD-3-Clause
// Writes files that appear complete or not at all: under a temporary name, then renamed after their bytes are on the
// disk. Serial: called on rank 0 only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// @brief An empty file with a new, temporary name. The destructor removes the file unless it was renamed.
class TemporaryFile {
public:
  /// @param files keeps the name of the file, so that a signal handler can remove the file; may be null, otherwise it
  /// must outlive this object
  /// @throws FileError if the file cannot be made, or if a file or link with this name exists, because files of others
  /// are never overwritten
  TemporaryFile(std::string path, RunFiles* files);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  /// @brief Releases reserved space, brings the bytes to the disk, and renames the file.
  /// @param replaces whether an existing file with the final name may be replaced
  /// @throws FileError if that fails, or if the final name belongs to a pipe, a device or another file that is not
  /// regular (links are followed)
  /// @post synchronise_directory must be called afterwards
  void rename_to(const std::string& final_path, bool replaces = true);
  /// Renames the file as rename_to does, and writes the directory to the disk.
  /// @throws FileError if that fails
  void publish(const std::string& final_path);
  /// @brief Only renames the file, and replaces an existing file with the final name.
  /// @throws FileError if that fails
  /// @post synchronise_file_system must be called afterwards
  void rename_before_disk(const std::string& final_path);

private:
  void has_its_name();

  std::string path_;
  RunFiles* files_;
  bool published_ = false;
};

/// Files that are useful only together. The destructor removes all of them, unless complete() was called.
class FileSet {
public:
  FileSet() = default;
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Adds the path of a file. Must be called before the file gets its final name.
  void add(const std::string& path) { paths_.push_back(path); }
  void complete() { paths_.clear(); }

private:
  std::vector<std::string> paths_;
};

/// [bytes] Longest name of a file or directory on Linux, with almost all its file systems.
inline constexpr std::size_t longest_file_name = 255;
/// [bytes] Longest job or process id in a temporary name: an id has at most 64 bits.
inline constexpr std::size_t longest_job_id = 20;
/// [bytes] Longest ending that temporary_name adds: ".tmp-", the id, "-", 16 digits.
inline constexpr std::size_t longest_temporary_ending = 5 + longest_job_id + 1 + 16;

/// @brief Returns the end of a sentence that says why file systems cannot hold a path of this length; empty if they
/// can.
/// @param added number of bytes by which the last name in the path will become longer
std::string length_problem(const std::string& path, std::size_t added);

/// Returns `final_path` + ".tmp-" + an id + an unpredictable random part. The id is that of the SLURM job, or of the
/// process if there is no SLURM job.
std::string temporary_name(const std::string& final_path);

/// @brief Reserves `bytes` of disk space for an existing file without changing its size. If the file system cannot
/// reserve space, the free space is compared instead.
/// @throws FileError if there is not enough space
void reserve_space(const std::string& path, std::int64_t bytes);

/// Writes the directory entries of the file's directory to the disk.
/// @throws FileError if that fails
void synchronise_directory(const std::string& path);

/// @brief Brings all files on the file system of `path` to the disk. For many files this is faster than for each file
/// alone.
/// @throws FileError if that fails
void synchronise_file_system(const std::string& path);

/// Writes a text to `final_path`; the file appears complete or not at all.
/// @param files may be null
/// @throws FileError if that fails
void write_text_file(const std::string& final_path, const std::string& text, RunFiles* files);
/// Writes a text as write_text_file does, for one of several files.
/// @post synchronise_directory must be called afterwards
void write_one_text_file(const std::string& final_path, const std::string& text, RunFiles* files);
/// @brief Writes a text as write_text_file does, for one of thousands of files. The file is complete even if the
/// program is killed. But if the machine fails before synchronise_file_system is called, the file may be cut off.
void write_text_file_of_many(const std::string& final_path, const std::string& text, RunFiles* files);

/// Makes or replaces the symbolic link `path`, which points to `target` (relative to the directory of `path`).
/// @throws FileError if that fails
void replace_link(const std::string& target, const std::string& path);

/// Returns the system's message for the value of errno.
std::string system_error();

} // namespace trime::io
