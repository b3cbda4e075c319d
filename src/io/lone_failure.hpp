// SPDX-License-Identifier: BSD-3-Clause
// Handles an error that one rank has in a collective call of MPI-IO, while the others wait in it without end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trime::io {

/// @brief Ends the job if the other ranks do not learn of an error in time.
///
/// Open MPI and ROMIO leave a collective write on the rank whose disk fails, and keep the others in it. From there no
/// message reaches them: only the launcher can end them.
class LoneFailure {
public:
  /// More than a slow file system needs for one collective call, less than a user waits for an answer.
  static constexpr std::chrono::seconds usual_patience{20};

  /// @param path the temporary file, which is removed if the job ends
  explicit LoneFailure(std::string path, std::chrono::milliseconds patience = usual_patience)
      : path_(std::move(path)), patience_(patience) {}
  /// All ranks have come to where they agree on the error.
  ~LoneFailure();
  LoneFailure(const LoneFailure&) = delete;
  LoneFailure& operator=(const LoneFailure&) = delete;

  /// From now on the others have so much time. Then the message goes to stderr and this process ends with the exit code
  /// of a FileError. Without a thread to be had nothing happens.
  void begin(const std::string& message) noexcept;

private:
  void wait_for_the_end();

  const std::string path_;
  const std::chrono::milliseconds patience_;
  std::string message_;
  std::mutex mutex_; // for what follows
  std::condition_variable changed_;
  bool is_known_ = false;
  std::thread thread_;
};

} // namespace trime::io
