// SPDX-License-Identifier: BSD-3-Clause
// Writes a file from memory to the disk while more of it is being written.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trime::io {

/// @brief A thread that asks the system to bring written data to the disk, so that little is left for the
/// synchronisation at the end. Such a call takes 20 to 50 ms for 190 MB, because the system allocates disk blocks and
/// starts transfers; on the thread that writes the file, the whole run would pause. The thread uses the processors of
/// the thread that calls `request` first. The calls are hints, which cannot fail. Nothing happens if no thread can be
/// started.
///
/// The object keeps the file open until its end and should live longer than the writer of the file. Closing a
/// descriptor releases all locks of the process on the file, including those of MPI-IO.
class WriteBack {
public:
  explicit WriteBack(std::string path) : path_(std::move(path)) {}
  ~WriteBack();
  WriteBack(const WriteBack&) = delete;
  WriteBack& operator=(const WriteBack&) = delete;

  /// Starts to bring all data written so far to the disk. Returns at once.
  void request() noexcept;

private:
  void serve();

  const std::string path_;
  std::mutex mutex_; // guards the members below
  std::condition_variable changed_;
  bool requested_ = false, ends_ = false;
  std::thread thread_; // started by the first request
};

} // namespace trime::io
