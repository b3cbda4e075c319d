// SPDX-License-Identifier: BSD-3-Clause
#include "core/read_file.hpp"

#include "trime/core/error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

namespace trime {

std::string irregular_kind(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode))
    return {};
  return S_ISDIR(status.st_mode)    ? "a directory"
         : S_ISFIFO(status.st_mode) ? "a named pipe"
         : S_ISSOCK(status.st_mode) ? "a socket"
                                    : "a device";
}

namespace {

/// Closes a file of the system.
class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0)
      ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

private:
  int number_;
};

FileError cannot_read(const std::string& path, int code) {
  return FileError(fmt::format("cannot read {}: {}", path, std::strerror(code)));
}

FileError too_large(const std::string& path, std::int64_t bytes, std::int64_t most) {
  return FileError(
      fmt::format("{} has {} bytes or more; at most {} are read: is it the right file?", path, bytes, most));
}

} // namespace

std::string read_file(const std::string& path, const std::string& hint, std::int64_t most) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)); // a pipe would wait for its writer
  struct stat status {};
  if (file < 0 || fstat(file, &status) != 0)
    throw FileError(
        fmt::format("cannot open {}: {}; check the path and the permissions{}", path, std::strerror(errno), hint));
  if (S_ISDIR(status.st_mode))
    throw cannot_read(path, EISDIR);
  if (!S_ISREG(status.st_mode))
    throw FileError(fmt::format("cannot read {}: expected a regular file, found a pipe or a device", path));
  if (status.st_size > most)
    throw too_large(path, status.st_size, most);
  std::string text;
  std::vector<char> buffer(std::size_t{1} << 16);
  for (;;) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      throw cannot_read(path, errno);
    if (count == 0)
      return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (std::ssize(text) > most) // files of /proc say that they are empty
      throw too_large(path, std::ssize(text), most);
  }
}

} // namespace trime
