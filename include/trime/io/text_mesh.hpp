// SPDX-License-Identifier: BSD-3-Clause
// The mesh as the text files of TriMe++: the same names and line formats, numbers with 17 significant digits, complete,
// never appended to. For tools that read those files, and for comparisons; large meshes belong into NAME.h5.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <span>
#include <string>
#include <vector>

namespace trime::io {

class RunFiles;

/// Where the files of one mesh go: FOLDER/NAME_LABEL_xy_id.txt and so on.
struct TextPlace {
  std::string folder; ///< exists
  std::string name;   ///< TriMe++'s prefix
  std::string label;  ///< "final", or the number of the retriangulation
  /// Sides of a periodic container, 0 where it is not: triangles across it are written whole.
  geometry::Vec2 period{0, 0};
  RunFiles* run_files = nullptr; ///< as MeshFileOptions::run_files
};

/// One line of NAME_tria_quality_stat_overall.txt.
struct TextQuality {
  int retriangulation = 0;
  GlobalId points = 0, triangles = 0;
  mesh::QualitySummary quality;
};

/// @brief Writes all files of one mesh but that of the overall quality. Each appears whole or not at all; files of the
/// same name are replaced. At the return all are on the disk. The machine that fails before may leave loops cut off.
/// Points, triangles and edges pass through rank 0 in slices, the boundary as a whole.
/// @throws FileError on all ranks together
/// @note Collective.
void write_text_mesh(const TextPlace& place, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// The text of NAME_tria_quality_stat_overall.txt: 13 columns for each mesh written so far.
std::string overall_quality_text(std::span<const TextQuality> meshes);

/// @brief True for names that write_text_mesh() gives to files, with any label; `file` has no directory.
bool is_text_mesh_file(const std::string& file, const std::string& name);

} // namespace trime::io
