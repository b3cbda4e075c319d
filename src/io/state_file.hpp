// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads a file with the state of a run: named values, texts and columns, and distributed arrays. The module
// io stores them without using them.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// The type of the elements of an array.
enum class ValueKind { float64, int64, int32, uint8 };

/// A distributed array. The path of an array begins with the name of its group. Rows are made on demand, see SlabArray.
struct StateArray {
  std::string path; ///< "group/name"
  ValueKind kind;
  int columns; ///< number of columns; 0 for a one-dimensional array
  mesh::Slab slab;
  std::int64_t rows; ///< number of rows on this rank
  std::function<void(std::int64_t first, std::int64_t count, std::byte* out)> fill;
};

/// @brief Writes the file, reads every array back, compares it, and renames the file; an older file of this name stays
/// until then. The metadata of rank 0 is written; its groups may also contain arrays.
/// @param files keeps the name of the temporary file for a signal handler; may be null
/// @throws FileError on all ranks together; the temporary file is removed
/// @note Collective. A rank may have no rows.
void write_state_file(const std::string& path, RunFiles* files, const Metadata& metadata,
                      const std::vector<StateArray>& arrays, const comm::Communicator& comm);

/// @brief Reads the metadata of a state file. One-dimensional arrays in the given groups are returned as columns.
/// @param groups groups whose columns are read
/// @throws FileError on all ranks together if the file cannot be read
/// @note Collective.
Metadata read_state_metadata(const std::string& path, const std::vector<std::string>& groups,
                             const comm::Communicator& comm);

/// Reads arrays of a state file on one rank.
class StateFileReader {
public:
  /// Opens the file.
  /// @throws FileError if it cannot be opened
  explicit StateFileReader(const std::string& path);
  ~StateFileReader();
  bool has(const std::string& path) const;
  /// Reads rows [first, first + count) of an array into `out`, which must have room for them.
  /// @throws FileError if the array cannot be read
  void read(const std::string& path, ValueKind kind, int columns, std::int64_t first, std::int64_t count,
            void* out) const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace trime::io
