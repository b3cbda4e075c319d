// SPDX-License-Identifier: BSD-3-Clause
// The table of all output formats, and the writers of those of other programs, which keep the names of boundaries and
// regions.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trime::formats {

class ExchangeMesh;
struct FilePlan;

/// The formats. vtkhdf and xdmf are views of NAME.h5, text has the files of TriMe++, gmsh is MSH 4.1, gmsh2 MSH 2.2,
/// sms is .2dm.
enum class Format { vtkhdf, xdmf, text, gmsh, gmsh2, medit, freefem, triangle, vtu, sms, adcirc, geojson };

/// One row of the table of formats. Config, help, conversion and the files of a run read nothing else about a format.
struct FormatInfo {
  Format format;
  const char* word;            ///< word in a config
  const char* ending;          ///< ending of the (first) file, with the dot; text: none, but a directory
  bool holds_periodic = false; ///< can hold the mesh of a periodic container
  bool has_long_ids = false;   ///< counts with 64 bits
  /// Plans the files of a mesh whose first is the path; null for those that a run writes along with NAME.h5.
  /// Collective.
  std::vector<FilePlan> (*plan)(const ExchangeMesh& mesh, const std::string& path) = nullptr;
};
std::span<const FormatInfo> all_formats();
const FormatInfo& info_of(Format format);
std::optional<Format> format_of_word(const std::string& word);
/// Returns the format of another program with the ending of the path.
std::optional<Format> format_of_path(const std::string& path);
/// Returns the words of all formats with a property, such as "vtkhdf, xdmf and text"; `last` is the word before the
/// last one.
std::string words_of(bool FormatInfo::*property, const char* last);

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

/// @brief Creates the directory if it is missing, and checks that the mesh file and its views can be written. Call it
/// before long work whose result would be lost.
/// @return warnings, for example about files that a killed run has left; on rank 0 only
/// @throws FileError on all ranks if the directory cannot be made or written, or a file exists and may not be
/// overwritten
/// @note Collective.
std::vector<std::string> check_output(const io::MeshFileOptions& options, const comm::Communicator& comm);

} // namespace trime::formats
