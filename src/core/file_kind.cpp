// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_kind.hpp"

#include <sys/stat.h>

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

} // namespace trime
