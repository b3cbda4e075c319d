// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_file_start.hpp"

namespace trime::io {
namespace {

void start_vtkhdf(const FileStart& start, std::int64_t points, std::int64_t triangles) {
  start.group("/VTKHDF");
  const std::int64_t version[2] = {1, 0};
  start.attribute("/VTKHDF", "Version", version);
  start.ascii_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  start.column("/VTKHDF", {"NumberOfPoints", std::vector<std::int64_t>{points}});
  start.column("/VTKHDF", {"NumberOfCells", std::vector<std::int64_t>{triangles}});
  start.column("/VTKHDF", {"NumberOfConnectivityIds", std::vector<std::int64_t>{3 * triangles}});
}

/// Points with z = 0, and the vertices of all triangles in one row, as VTK wants them.
void show_plain_mesh_to_vtk(const FileStart& start, hsize_t points, hsize_t triangles, int bytes_per_id) {
  const hid_t id_type = bytes_per_id == 4 ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
  start.show({"/VTKHDF/Points", H5T_NATIVE_DOUBLE, {points, 3}, "/Mesh/mesh/geometry", {points, 2}});
  start.show({"/VTKHDF/Connectivity", id_type, {3 * triangles, 0}, "/Mesh/mesh/topology", {triangles, 3}});
}

} // namespace

bool has_plain_mesh(const MeshFileOptions& options) {
  return options.xdmf || !options.vtkhdf;
}

void start_mesh_file(const FileStart& start, const MeshFileOptions& options, const mesh::DistributedMesh& mesh,
                     const Metadata& metadata, int bytes_per_id) {
  const std::int64_t points = mesh.point_slab.total, triangles = mesh.triangle_slab.total;
  start.group("/Mesh");
  if (options.vtkhdf)
    start_vtkhdf(start, points, triangles);
  if (options.vtkhdf && has_plain_mesh(options))
    show_plain_mesh_to_vtk(start, static_cast<hsize_t>(points), static_cast<hsize_t>(triangles), bytes_per_id);
  start.group(field_group(options, "CellData"));
  start.group(field_group(options, "PointData"));
  start.metadata("/trime_mpi", metadata);
}

} // namespace trime::io
