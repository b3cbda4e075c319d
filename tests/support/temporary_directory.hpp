// SPDX-License-Identifier: BSD-3-Clause
// A directory of its own for a test, removed with all that is in it. With a communicator: one for all ranks.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace trime::test {

class TemporaryDirectory {
public:
  TemporaryDirectory() : path_(make()) {}
  /// Collective, the destructor too.
  explicit TemporaryDirectory(const comm::Communicator& comm)
      : comm_(&comm), path_(comm.broadcast(comm.is_root() ? make() : std::string())) {}
  ~TemporaryDirectory() {
    if (comm_)
      comm_->barrier();
    std::error_code ignored;
    if (!comm_ || comm_->is_root())
      std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::string& path() const { return path_; }

private:
  static std::string make() {
    std::string name = (std::filesystem::temp_directory_path() / "trime-test-XXXXXX").string();
    return mkdtemp(name.data()) ? name : std::string(".");
  }
  const comm::Communicator* comm_ = nullptr;
  std::string path_;
};

} // namespace trime::test
