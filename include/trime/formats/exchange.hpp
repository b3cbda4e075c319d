// SPDX-License-Identifier: BSD-3-Clause
// The mesh in the files of other programs, with the names of its boundary and regions.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trime::io {
class RunFiles;
}

namespace trime::formats {

enum class Format { gmsh, gmsh2, medit, freefem, triangle, vtu, sms, adcirc, geojson };

/// A format as users name it.
struct FormatName {
  Format format;
  const char* word;   ///< in a config
  const char* ending; ///< of its file
};
std::span<const FormatName> all_formats();
std::optional<Format> format_of_word(const std::string& word);
/// By the ending of the path.
std::optional<Format> format_of_path(const std::string& path);

/// What the numbers of a mesh mean. In all formats a boundary edge that follows part k of the shape has the label k +
/// 1, since 0 means inside; a point has the lowest label of its edges. Regions keep their numbers, 1 and up.
struct Names {
  std::vector<std::string> parts;   ///< by DistributedMesh::facet_parts
  std::vector<std::string> regions; ///< of region 1, 2, ...
  /// Sides of a periodic container, 0 where it is not.
  geometry::Vec2 period{0, 0};
  /// Reference system of the coordinates, as PROJ names it; empty: none is known.
  std::string crs{};
};

/// The paths of a format whose first file is `path`: Triangle has three.
std::vector<std::string> paths_of(Format format, const std::string& path);

/// @brief Writes the mesh. Each file appears whole or not at all; files of the same name are replaced. Text is made in
/// slices, so no rank holds much of it; but sms and adcirc gather the boundary edges on rank 0.
/// @param files told of temporary files, for a signal handler; may be null
/// @throws ConfigError for what the format cannot hold (periodic containers; too many points); FileError; on all ranks
/// together
/// @return the paths
/// @note Collective.
std::vector<std::string> write(Format format, const std::string& path, const mesh::DistributedMesh& mesh,
                               const Names& names, io::RunFiles* files, const comm::Communicator& comm);

} // namespace trime::formats
