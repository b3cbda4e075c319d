// SPDX-License-Identifier: BSD-3-Clause
// The XDMF text that describes NAME.h5 to ParaView, meshio and dolfinx.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace trime::io {

/// Where the arrays lie in the HDF5 file, and how long they are.
struct XdmfContent {
  std::string file;       ///< name of the HDF5 file, no directory
  std::string cell_data;  ///< group of alpha, beta, region
  std::string point_data; ///< group of boundary, size, fixed
  std::int64_t points = 0, triangles = 0, facets = 0;
  int time = 0; ///< of a series only
};

/// One mesh.
std::string xdmf_text(const XdmfContent& content);
/// The facets of one mesh with their labels, as dolfinx reads mesh tags and meshio lines.
std::string xdmf_facets_text(const XdmfContent& content);
/// Meshes of several files as a temporal collection.
std::string xdmf_series_text(std::span<const XdmfContent> meshes);

} // namespace trime::io
