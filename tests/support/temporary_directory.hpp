// SPDX-License-Identifier: BSD-3-Clause
// A temporary directory for a test, which is removed together with its files. With a communicator, all ranks share one
// directory.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace trime::test {

class TemporaryDirectory {
public:
  TemporaryDirectory() : path_(make()) {}
  /// Makes one directory for all ranks. The constructor and the destructor are collective.
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
