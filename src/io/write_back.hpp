// SPDX-License-Identifier: BSD-3-Clause
// Brings a file to the disk while more of it is written.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trime::io {

/// @brief A thread that asks the system to bring what has been written to the disk, so that little is left for the
/// synchronisation at the end. The system finds places on the disk and starts transfers before it answers (20 to 50 ms
/// for 190 MB): by the thread that writes the file it would be a pause of the whole run. It shares the processors of
/// the thread that asks first. A hint, which cannot fail; without a thread to be had nothing happens.
///
/// It keeps the file open until its end, which should come after the file is closed: closing a descriptor gives up all
/// locks of the process on the file, those of MPI-IO, too.
class WriteBack {
public:
  explicit WriteBack(std::string path) : path_(std::move(path)) {}
  ~WriteBack();
  WriteBack(const WriteBack&) = delete;
  WriteBack& operator=(const WriteBack&) = delete;

  /// Starts writing to the disk what has been written until now. Returns at once.
  void request() noexcept;

private:
  void serve();

  const std::string path_;
  std::mutex mutex_; // for what follows
  std::condition_variable changed_;
  bool requested_ = false, ends_ = false;
  std::thread thread_; // from the first request on
};

} // namespace trime::io
