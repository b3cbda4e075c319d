// SPDX-License-Identifier: BSD-3-Clause
#include "io/lone_failure.hpp"

#include "trime/core/error.hpp"

#include <unistd.h>

#include <cstdio>
#include <exception>

namespace trime::io {

LoneFailure::~LoneFailure() {
  if (!thread_.joinable())
    return;
  {
    const std::lock_guard lock(mutex_);
    is_known_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void LoneFailure::begin(const std::string& message) noexcept {
  try {
    message_ = message;
    thread_ = std::thread([this] { wait_for_the_end(); });
  } catch (const std::exception&) { // the others may still come
  }
}

void LoneFailure::wait_for_the_end() {
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, patience_, [this] { return is_known_; }))
    return;
  std::fprintf(stderr,
               "trime_mpi: error: %s (on one rank alone; the other ranks do not return from the same MPI-IO call, so "
               "the job ends)\n",
               message_.c_str());
  unlink(path_.c_str());
  _exit(static_cast<int>(ExitCode::file)); // the launcher ends the others
}

} // namespace trime::io
