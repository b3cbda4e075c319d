// SPDX-License-Identifier: BSD-3-Clause
// Writes the mesh as the text files of TriMe++, with the same names and line formats, and numbers with 17 significant
// digits. Unlike TriMe++, it replaces files instead of appending to them. Use these files for tools that read them and
// for comparisons; use NAME.h5 for large meshes.
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

/// The folder and the names of the files of one mesh: FOLDER/NAME_LABEL_xy_id.txt and others.
struct TextPlace {
  std::string folder; ///< an existing folder
  std::string name;   ///< NAME in the file names
  std::string label;  ///< LABEL in the file names: "final", or the number of the triangulation
  /// Periods of the container; 0 in a direction that is not periodic. A triangle across the border is written with the
  /// coordinates of one side.
  geometry::Vec2 period{0, 0};
  io::RunFiles* run_files =
      nullptr; ///< keeps the names of temporary files for a signal handler, as MeshFileOptions::run_files
};

/// One line of the file NAME_tria_quality_stat_overall.txt.
struct TextQuality {
  int retriangulation = 0;
  GlobalId points = 0, triangles = 0;
  mesh::QualitySummary quality;
};

/// @brief Writes all files of one mesh except the file of the overall quality. Each file appears complete or not at
/// all; files of the same name are replaced. All files are on the disk when the function returns; if the machine fails
/// earlier, files of loops may be cut off. Points, triangles and edges pass through rank 0 in slices, the boundary as a
/// whole.
/// @throws FileError on all ranks together
/// @note Collective.
void write_text_mesh(const TextPlace& place, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// Returns the text of NAME_tria_quality_stat_overall.txt, which has 13 columns and one line for each mesh written so
/// far.
std::string overall_quality_text(std::span<const TextQuality> meshes);

/// @brief Returns true for file names that write_text_mesh() uses, with any LABEL. `file` must not contain a directory.
bool is_text_mesh_file(const std::string& file, const std::string& name);

} // namespace trime::formats
