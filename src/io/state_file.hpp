// SPDX-License-Identifier: BSD-3-Clause
// A file with the state of a run: named values, texts and columns, and distributed arrays. This module does not know
// what they mean.
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

/// A distributed array in the group with which its path begins. The rows are made on demand, see SlabArray.
struct StateArray {
  std::string path; ///< "group/name"
  ValueKind kind;
  int columns; ///< 0 for a one-dimensional array
  mesh::Slab slab;
  std::int64_t rows; ///< rows of this rank
  std::function<void(std::int64_t first, std::int64_t count, std::byte* out)> fill;
};

/// @brief Writes the file, reads every array back, compares it, and renames the file; an older file of this name stays
/// until then. Writes the metadata of rank 0, whose groups may also hold arrays.
/// @param files keeps track of the temporary file; may be null
/// @throws FileError on all ranks together, after removing the temporary file
/// @note Collective. Ranks may hold nothing.
void write_state_file(const std::string& path, RunFiles* files, const Metadata& metadata,
                      const std::vector<StateArray>& arrays, const comm::Communicator& comm);

/// @brief Reads the metadata of such a file. One-dimensional arrays of the given groups are among their columns.
/// @param groups groups whose columns are read
/// @throws FileError on all ranks together if the file cannot be read
/// @note Collective.
Metadata read_state_metadata(const std::string& path, const std::vector<std::string>& groups,
                             const comm::Communicator& comm);

/// Reads arrays of such a file, for one rank alone.
class StateFileReader {
public:
  /// @throws FileError
  explicit StateFileReader(const std::string& path);
  ~StateFileReader();
  bool has(const std::string& path) const;
  /// Rows [first, first + count) into `out`, which has room for them. @throws FileError
  void read(const std::string& path, ValueKind kind, int columns, std::int64_t first, std::int64_t count,
            void* out) const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace trime::io
