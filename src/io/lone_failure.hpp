// SPDX-License-Identifier: BSD-3-Clause
// Ends the job if only one rank has an error in a collective call of MPI-IO, because the other ranks would wait without
// end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trime::io {

/// @brief Ends the job if the other ranks do not learn about an error within some time.
///
/// In Open MPI and ROMIO, a rank whose disk fails leaves a collective write, while the other ranks stay in it. There
/// they receive no message, so only the launcher can end them.
class LoneFailure {
public:
  /// Time for the other ranks to learn about the error. This time is longer than one collective call takes on a slow
  /// file system, and short enough for users to wait.
  static constexpr std::chrono::seconds usual_patience{20};

  /// @param path path of the temporary file, which is removed when the job ends
  explicit LoneFailure(std::string path, std::chrono::milliseconds patience = usual_patience)
      : path_(std::move(path)), patience_(patience) {}
  /// Must run when all ranks have reached the place where they agree on the error.
  ~LoneFailure();
  LoneFailure(const LoneFailure&) = delete;
  LoneFailure& operator=(const LoneFailure&) = delete;

  /// Begins to wait for the other ranks. When the time is over, prints the message on stderr and ends this process with
  /// the exit code of a FileError. Does nothing if no thread can be started.
  void begin(const std::string& message) noexcept;

private:
  void wait_for_the_end();

  const std::string path_;
  const std::chrono::milliseconds patience_;
  std::string message_;
  std::mutex mutex_; // guards the members below
  std::condition_variable changed_;
  bool is_known_ = false;
  std::thread thread_;
};

} // namespace trime::io
