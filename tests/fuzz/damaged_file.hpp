// SPDX-License-Identifier: BSD-3-Clause
// Makes damaged HDF5 files of the program for fuzzing. Random bytes in place of a whole file would nearly always be
// refused because of their first bytes; so each input of the fuzzer is a list of changes to a good file.
#pragma once

#include "support/temporary_directory.hpp"
#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::fuzz {

/// Starts MPI once for the whole process. Open MPI must leave the signals to libFuzzer.
void start_mpi();

/// @brief A file written by a run of the program. The run is made at the start of the fuzzer, so that the file has the
/// present format.
class DamagedFile {
public:
  /// @param is_checkpoint true for a checkpoint, at which the run is stopped; false for a mesh file
  explicit DamagedFile(bool is_checkpoint);

  /// @brief Writes a damaged copy of the file; `data` describes the changes. Datasets and attributes are replaced by
  /// others with another type, shape or layout, values are overwritten, objects are moved or removed, the file is cut
  /// off, and bytes are changed that HDF5 does not need to open the file.
  /// @return the path of the copy, which is the same in each call
  const std::string& damage(const std::uint8_t* data, std::size_t size);
  const comm::Communicator& comm() const { return comm_; }
  /// Returns a directory for files that a target writes; it is removed at the end of the process.
  const std::string& directory() const { return directory_.path(); }

private:
  void list_objects();

  comm::Communicator comm_;
  test::TemporaryDirectory directory_;
  std::string path_, bytes_; // path of the damaged file; bytes of the good file
  std::vector<std::string> datasets_, groups_;
};

/// Each fuzz target defines this constant: true if it damages checkpoints, false if it damages mesh files.
extern const bool damages_checkpoints;

/// @brief Returns the good file of this process. LLVMFuzzerInitialize makes it before the time of the first input is
/// measured, because MPI takes long to start on a busy machine.
DamagedFile& good_file();

} // namespace trime::fuzz
