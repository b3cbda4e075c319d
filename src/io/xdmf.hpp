// SPDX-License-Identifier: BSD-3-Clause
// The XDMF text that describes NAME.h5 to ParaView, meshio and dolfinx.
#pragma once

#include <cstdint>
#include <string>

namespace trime::io {

/// Where the arrays lie in the HDF5 file, and how long they are.
struct XdmfContent {
  std::string file;       ///< name of the HDF5 file, no directory
  std::string cell_data;  ///< group of alpha, beta, region
  std::string point_data; ///< group of boundary, size, fixed
  std::int64_t points = 0, triangles = 0;
};

std::string xdmf_text(const XdmfContent& content);

} // namespace trime::io
