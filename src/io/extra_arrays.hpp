// SPDX-License-Identifier: BSD-3-Clause
// Arrays that other modules add to the mesh file, for example those of Voronoi cells. The modules need no HDF5 for
// that.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace trime::io {

enum class ValueType : std::uint8_t { float64, int64, int32 };
/// Returns the number of bytes of a value.
constexpr std::int64_t bytes_of(ValueType type) {
  return type == ValueType::int32 ? 4 : 8;
}

/// A contiguous range of rows of an array. Each rank has a contiguous part of it.
struct ExtraRows {
  std::int64_t first = 0; ///< number of this rank's first row in the whole array
  std::int64_t rows = 0;  ///< on this rank
  /// Writes rows [begin, begin + count) of this rank to `out`. Called concurrently, and must write the same bytes at
  /// each call.
  std::function<void(std::int64_t begin, std::int64_t count, std::byte* out)> fill;
};

/// An array of `total` rows over all ranks; the blocks follow each other and cover it.
struct ExtraArray {
  std::string name;
  ValueType type = ValueType::float64;
  int columns = 0; ///< number of columns; 0 for a one-dimensional array
  std::int64_t total = 0;
  std::vector<ExtraRows> blocks;
  std::vector<Attribute> attributes{};
};

/// A group of the mesh file with attributes and arrays.
struct ExtraGroup {
  std::string path;
  std::vector<Attribute> attributes;
  std::vector<ExtraArray> arrays;

  std::int64_t bytes() const {
    std::int64_t sum = 0;
    for (const ExtraArray& array : arrays)
      sum += bytes_of(array.type) * (array.columns == 0 ? 1 : array.columns) * array.total;
    return sum;
  }
};

/// The arrays that a caller adds to a mesh file, and the largest number that the file stores as int32.
struct ExtraContent {
  std::vector<ExtraGroup> groups;
  /// The largest offset for which vertices and offsets of triangles are stored as int32. Tests set a small one to write
  /// int64.
  std::int64_t largest_int32 = std::numeric_limits<std::int32_t>::max();
};

/// Does the same as write_mesh, and adds groups of arrays to the file.
/// @throws FileError on all ranks together
/// @note Collective.
WrittenFiles write_mesh_and(const ExtraContent& extra, const MeshFileOptions& options,
                            const mesh::DistributedMesh& mesh, const Metadata& metadata,
                            const comm::Communicator& comm);

} // namespace trime::io
