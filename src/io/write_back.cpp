// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_back.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <exception>

namespace trime::io {

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
  } catch (const std::exception&) { // the synchronisation at the end does all of it then
  }
}

void WriteBack::serve() {
  const int descriptor = open(path_.c_str(), O_RDWR | O_CLOEXEC);
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return requested_ || ends_; });
    if (ends_)
      break;
    requested_ = false;
    lock.unlock();
    if (descriptor >= 0)
      sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
    lock.lock();
  }
  if (descriptor >= 0)
    ::close(descriptor);
}

} // namespace trime::io
