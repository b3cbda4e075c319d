// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_back.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <system_error>

namespace trime::io {
namespace {

void start_writing_back(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
    return;
  sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
  ::close(descriptor);
}

} // namespace

WriteBack::~WriteBack() {
  if (!thread_.joinable())
    return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void WriteBack::request() noexcept {
  {
    const std::lock_guard lock(mutex_);
    requested_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable())
    return;
  try {
    thread_ = std::thread(&WriteBack::serve, this);
  } catch (const std::system_error&) { // the synchronisation at the end does all of it then
  }
}

void WriteBack::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return requested_ || ends_; });
    if (ends_)
      return;
    requested_ = false;
    lock.unlock();
    start_writing_back(path_);
    lock.lock();
  }
}

} // namespace trime::io
