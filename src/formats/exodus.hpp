// SPDX-License-Identifier: BSD-3-Clause
// Writes Exodus II in either of two netCDF formats; tests write small meshes in the one for large meshes, too.
#pragma once

#include "formats/exchange_mesh.hpp"
#include "formats/netcdf_header.hpp"

namespace trime::formats {

/// Returns the format that the mesh needs: CDF-2 as long as all its numbers and arrays fit.
NetcdfFormat exodus_format(GlobalId points, GlobalId triangles);

/// Plans a file in the given netCDF format. Collective.
FilePlan exodus_file(const ExchangeMesh& mesh, const std::string& path, NetcdfFormat format);

} // namespace trime::formats
