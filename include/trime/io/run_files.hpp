// SPDX-License-Identifier: BSD-3-Clause
// Which files a run has on the disk at the moment, for a signal handler.
#pragma once

#include <atomic>
#include <climits>
#include <string>

namespace trime::io {

/// @brief Knows the temporary file that is being written, and whether the final mesh is written. A program that handles
/// signals makes one object, passes its address to MeshFileOptions, and asks it in the handler. There is one temporary
/// file at a time.
class RunFiles {
public:
  /// Notes that a file is being written under this temporary name. Names longer than PATH_MAX are not noted.
  void start_writing(const std::string& temporary) noexcept;
  /// Notes that this file has its final name, or has been removed.
  void stop_writing() noexcept { writing_ = false; }
  /// Notes that the final mesh has its name; other files of the run may follow.
  void set_final_mesh_written() noexcept { final_mesh_written_ = true; }

  /// Removes the temporary file that is being written, if any. Safe in a signal handler.
  void remove_temporary() const noexcept;
  /// Returns whether the final mesh is written. Only rank 0 knows. Safe in a signal handler.
  bool final_mesh_written() const noexcept { return final_mesh_written_; }

private:
  char path_[PATH_MAX]; // for a signal handler: a plain buffer, valid while writing_ is set
  std::atomic<bool> writing_{false}, final_mesh_written_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

} // namespace trime::io
