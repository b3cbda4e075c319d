// SPDX-License-Identifier: BSD-3-Clause
// A file with the state of a run: named values, texts and columns, and arrays that are distributed over the ranks. This
// module knows nothing of their meaning.
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

/// An array over all ranks, in the group that its path begins with. The rows are made on demand, see SlabArray.
struct StateArray {
  std::string path; ///< "group/name"
  ValueKind kind;
  int columns; ///< 0: one-dimensional
  mesh::Slab slab;
  std::int64_t rows; ///< of this rank
  std::function<void(std::int64_t first, std::int64_t count, std::byte* out)> fill;
};

/// @brief Writes the file, reads every array back and compares it, and renames it; an older file of this name stays
/// until then. Writes the metadata of rank 0. Their groups may also hold arrays.
/// @param files notes the temporary file; may be null
/// @throws FileError on all ranks together; the temporary file is removed then
/// @note Collective. Ranks may hold nothing.
void write_state_file(const std::string& path, RunFiles* files, const Metadata& metadata,
                      const std::vector<StateArray>& arrays, const comm::Communicator& comm);

/// @brief The metadata of such a file, one-dimensional arrays of the groups named among their columns.
/// @param groups others have no columns in the result
/// @throws FileError on all ranks together if there is no such file
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
