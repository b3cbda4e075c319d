// SPDX-License-Identifier: BSD-3-Clause
// HDF5 files of the program, damaged as the bytes of the fuzzer say. Whole files as input would be refused for their
// first bytes nearly always; here each input is a list of changes to a good file.
#pragma once

#include "support/temporary_directory.hpp"
#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::fuzz {

/// MPI for the whole process, once; Open MPI leaves the signals to libFuzzer.
void start_mpi();

/// @brief A file that a run of the program leaves, made at the start of the fuzzer, so that it is never out of date.
class DamagedFile {
public:
  /// @param is_checkpoint the run is stopped at its first checkpoint, and that is the file; else the mesh file
  explicit DamagedFile(bool is_checkpoint);

  /// @brief Writes a copy with the changes that `data` describes: datasets and attributes that are replaced by ones of
  /// another type, shape or layout, values that are overwritten, objects that are moved or gone, a file that is cut
  /// off, and bytes outside of what HDF5 needs to find its way.
  /// @return its path, the same each time
  const std::string& damage(const std::uint8_t* data, std::size_t size);
  const comm::Communicator& comm() const { return comm_; }
  /// For files that are written; the fuzzer removes it at its end.
  const std::string& directory() const { return directory_.path(); }

private:
  void list_objects();

  comm::Communicator comm_;
  test::TemporaryDirectory directory_;
  std::string path_, bytes_; // of the damaged file; of the good one
  std::vector<std::string> datasets_, groups_;
};

/// What a target damages: it says so itself.
extern const bool damages_checkpoints;

/// @brief The one of this process. A target with it has LLVMFuzzerInitialize from here: the run is made before the
/// clock of the first input begins, since MPI takes long to start on a busy machine.
DamagedFile& good_file();

} // namespace trime::fuzz
