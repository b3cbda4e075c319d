// SPDX-License-Identifier: BSD-3-Clause
// Makes the XDMF text that describes the arrays of NAME.h5 to ParaView, meshio and dolfinx.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace trime::io {

/// The positions of the arrays in the HDF5 file, and their lengths.
struct XdmfContent {
  std::string file;       ///< name of the HDF5 file, without directory
  std::string cell_data;  ///< HDF5 group with alpha, beta and region of the triangles
  std::string point_data; ///< HDF5 group with boundary, size and fixed of the points
  std::int64_t points = 0, triangles = 0, lines = 0;
  int bytes_per_id = 0;         ///< bytes of a vertex of a triangle, 4 or 8
  int time = 0;                 ///< time step; used only in a series
  bool has_inner_lines = false; ///< whether `lines` counts all labelled edges, which are listed in /Mesh/lines;
                                ///< otherwise they are those of /Mesh/facets
  bool has_regions = false;     ///< whether the mesh has more than one region
  bool has_depth = false;       ///< whether the points have depths
};

/// Returns the text for one mesh.
std::string xdmf_text(const XdmfContent& content);
/// Returns the text for the labelled edges of one mesh, which dolfinx reads as mesh tags and meshio as lines.
std::string xdmf_facets_text(const XdmfContent& content);
/// Returns the text for a series of meshes in several files, as a temporal collection.
std::string xdmf_series_text(std::span<const XdmfContent> meshes);

} // namespace trime::io
