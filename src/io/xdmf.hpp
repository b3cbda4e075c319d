// SPDX-License-Identifier: BSD-3-Clause
// The XDMF text that describes NAME.h5 to ParaView, meshio and dolfinx.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace trime::io {

/// Where the arrays lie in the HDF5 file, and how long they are.
struct XdmfContent {
  std::string file;       ///< name of the HDF5 file, without directory
  std::string cell_data;  ///< group with alpha, beta and region
  std::string point_data; ///< group with boundary, size and fixed
  std::int64_t points = 0, triangles = 0, facets = 0;
  int time = 0; ///< only for a series
};

/// Returns the text of one mesh.
std::string xdmf_text(const XdmfContent& content);
/// Returns the text of the facets of one mesh with their labels, which dolfinx reads as mesh tags and meshio as lines.
std::string xdmf_facets_text(const XdmfContent& content);
/// Returns the text of meshes in several files as a temporal collection.
std::string xdmf_series_text(std::span<const XdmfContent> meshes);

} // namespace trime::io
