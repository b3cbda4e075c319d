// SPDX-License-Identifier: BSD-3-Clause
// Writes the mesh as the text files of TriMe++: the same names and line formats, numbers with 17 significant digits.
// Files are complete and never appended to. They are for tools that read them, and for comparisons; use NAME.h5 for
// large meshes.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <span>
#include <string>
#include <vector>

namespace trime::io {
class RunFiles;
}

namespace trime::formats {

/// Where the files of one mesh go: FOLDER/NAME_LABEL_xy_id.txt etc.
struct TextPlace {
  std::string folder; ///< an existing folder
  std::string name;   ///< the prefix of TriMe++
  std::string label;  ///< "final", or the number of the retriangulation
  /// Periods of the container, 0 in a direction in which it is not periodic. Triangles across the border are written
  /// whole.
  geometry::Vec2 period{0, 0};
  io::RunFiles* run_files = nullptr; ///< as MeshFileOptions::run_files
};

/// One line of NAME_tria_quality_stat_overall.txt.
struct TextQuality {
  int retriangulation = 0;
  GlobalId points = 0, triangles = 0;
  mesh::QualitySummary quality;
};

/// @brief Writes all files of one mesh except the file of the overall quality. Each file appears complete or not at
/// all; files of the same name are replaced. All are on the disk when the function returns; if the machine fails
/// before, files of loops may be cut off. Points, triangles and edges pass through rank 0 in slices, the boundary as a
/// whole.
/// @throws FileError on all ranks together
/// @note Collective.
void write_text_mesh(const TextPlace& place, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// Returns the text of NAME_tria_quality_stat_overall.txt: 13 columns for each mesh written so far.
std::string overall_quality_text(std::span<const TextQuality> meshes);

/// @brief Returns true for names that write_text_mesh() gives to files, with any label. `file` has no directory.
bool is_text_mesh_file(const std::string& file, const std::string& name);

} // namespace trime::formats
