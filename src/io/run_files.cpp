// SPDX-License-Identifier: BSD-3-Clause
#include "trime/io/mesh_file.hpp"

#include <unistd.h>

#include <cstring>

namespace trime::io {

void RunFiles::start_writing(const std::string& temporary) noexcept {
  if (temporary.size() >= sizeof path_)
    return;
  std::memcpy(path_, temporary.c_str(), temporary.size() + 1);
  writing_ = true;
}

void RunFiles::remove_temporary() const noexcept {
  if (writing_)
    unlink(path_);
}

} // namespace trime::io
