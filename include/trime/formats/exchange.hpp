// SPDX-License-Identifier: BSD-3-Clause
// Writes the mesh in the file formats of other programs, with the names of its boundaries and regions.
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

/// The formats. gmsh is MSH 4.1, gmsh2 MSH 2.2, sms is .2dm.
enum class Format { gmsh, gmsh2, medit, freefem, triangle, vtu, sms, adcirc, geojson };

/// The names of a format.
struct FormatName {
  Format format;
  const char* word;   ///< word in a config
  const char* ending; ///< file ending, with the dot
};
std::span<const FormatName> all_formats();
std::optional<Format> format_of_word(const std::string& word);
/// Returns the format with the ending of the path.
std::optional<Format> format_of_path(const std::string& path);

/// The meaning of the numbers of a mesh. In all formats a boundary edge that follows part k of the shape has the label
/// k + 1, since 0 means inside. A point has the lowest label of its edges. Regions keep their numbers, from 1.
struct Names {
  std::vector<std::string> parts;   ///< names, indexed by DistributedMesh::facet_parts
  std::vector<std::string> regions; ///< names of the regions 1, 2, ...
  /// Periods of the container; 0 in a direction in which it is not periodic.
  geometry::Vec2 period{0, 0};
  /// Reference system of the coordinates, as PROJ names it; empty: unknown.
  std::string crs{};
};

/// Returns the paths of all files of a format whose first file is `path`: Triangle has three.
std::vector<std::string> paths_of(Format format, const std::string& path);

/// @brief Writes the mesh. Each file appears complete or not at all; files of the same name are replaced. The ranks
/// make the text in slices, so no rank holds much of it; for sms and adcirc, however, rank 0 gathers the boundary
/// edges.
/// @param files notes the temporary files, for a signal handler; may be null
/// @throws ConfigError for what the format cannot hold (periodic containers, too many points), FileError; both on all
/// ranks together
/// @return the paths
/// @note Collective.
std::vector<std::string> write(Format format, const std::string& path, const mesh::DistributedMesh& mesh,
                               const Names& names, io::RunFiles* files, const comm::Communicator& comm);

} // namespace trime::formats
