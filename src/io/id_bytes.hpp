// SPDX-License-Identifier: BSD-3-Clause
// The width of the numbers of points in the mesh file.
#pragma once

#include <cstdint>
#include <limits>

namespace trime::io {

/// Returns the size in bytes of the vertices of triangles and of the offsets 0, 3, 6, ... in a mesh file. Both have the
/// same type, because readers of VTK's format expect that: int32 unless the last offset is too large for it.
/// @param largest_int32 the largest offset that is stored as int32
constexpr int id_bytes(std::int64_t triangles, std::int64_t largest_int32 = std::numeric_limits<std::int32_t>::max()) {
  return triangles <= largest_int32 / 3 ? 4 : 8;
}

} // namespace trime::io
