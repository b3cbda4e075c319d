// SPDX-License-Identifier: BSD-3-Clause
#include "core/read_file.hpp"

#include "trime/core/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace trime {

std::string read_file(const std::string& path, const std::string& hint) {
  const auto close = [](std::FILE* f) { std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file)
    throw FileError(
        fmt::format("cannot open {}: {}; check the path and the permissions{}", path, std::strerror(errno), hint));
  std::string text;
  char buffer[1 << 16];
  std::size_t count = 0;
  while ((count = std::fread(buffer, 1, sizeof buffer, file.get())) > 0)
    text.append(buffer, count);
  if (std::ferror(file.get()) != 0)
    throw FileError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  return text;
}

} // namespace trime
