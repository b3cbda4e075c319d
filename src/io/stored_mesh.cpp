// SPDX-License-Identifier: BSD-3-Clause
#include "trime/io/mesh_file.hpp"

#include "comm/agree.hpp"
#include "io/hdf5_input.hpp"

#include <algorithm>

namespace trime::io {
namespace {

const std::string root_group = "/trime_mpi";

/// Equal shares of all rows.
mesh::Slab share(std::int64_t total, const comm::Communicator& comm) {
  return {total * comm.rank() / comm.size(), total};
}
std::int64_t rows_of(const mesh::Slab& slab, const comm::Communicator& comm) {
  return slab.total * (comm.rank() + 1) / comm.size() - slab.first;
}

/// One rank's part of a file.
class MeshReader {
public:
  MeshReader(const std::string& path, const comm::Communicator& comm)
      : path_(path), file_(path), comm_(comm), is_plain_(file_.has("/Mesh/mesh/geometry")) {}

  void read(mesh::DistributedMesh& mesh, std::vector<std::array<GlobalId, 3>>& triangles) const {
    const std::string points = is_plain_ ? "/Mesh/mesh/geometry" : "/VTKHDF/Points";
    mesh.point_slab = share(file_.rows(points), comm_);
    read_points(points, mesh);
    read_triangles(mesh, triangles);
    mesh.facet_slab = share(file_.rows("/Mesh/facets/topology"), comm_);
    read_rows("/Mesh/facets/topology", H5T_NATIVE_INT64, 2, mesh.facet_slab, mesh.facets);
    read_rows("/Mesh/facets/values", H5T_NATIVE_INT32, 0, mesh.facet_slab, mesh.facet_tags);
    read_rows("/Mesh/facets/parts", H5T_NATIVE_INT32, 0, mesh.facet_slab, mesh.facet_parts);
    read_rows("/Mesh/facets/asked_size", H5T_NATIVE_FLOAT, 0, mesh.facet_slab, mesh.facet_sizes);
    check_ids(triangles, mesh);
    check_ids(mesh.facets, mesh);
    read_curves(mesh);
    read_interfaces(mesh);
    read_splits(mesh);
  }

private:
  template <class Rows>
  void read_rows(const std::string& dataset, hid_t type, hsize_t columns, const mesh::Slab& slab, Rows& rows) const {
    const std::int64_t count = rows_of(slab, comm_);
    rows.resize(static_cast<std::size_t>(count));
    file_.read(dataset, type, columns, slab.first, count, rows.data());
  }

  void read_curves(mesh::DistributedMesh& mesh) const {
    if (!file_.has("/Mesh/curves/topology"))
      return;
    mesh.curve_slab = share(file_.rows("/Mesh/curves/topology"), comm_);
    read_rows("/Mesh/curves/topology", H5T_NATIVE_INT64, 2, mesh.curve_slab, mesh.curve_edges);
    read_rows("/Mesh/curves/values", H5T_NATIVE_INT32, 0, mesh.curve_slab, mesh.curve_numbers);
    check_ids(mesh.curve_edges, mesh);
  }

  void read_interfaces(mesh::DistributedMesh& mesh) const {
    if (!file_.has("/Mesh/interfaces/topology"))
      return;
    mesh::Slab& slab = mesh.interface_slab;
    slab = share(file_.rows("/Mesh/interfaces/topology"), comm_);
    read_rows("/Mesh/interfaces/topology", H5T_NATIVE_INT64, 2, slab, mesh.interfaces);
    read_rows("/Mesh/interfaces/regions", H5T_NATIVE_INT32, 2, slab, mesh.interface_regions);
    read_rows("/Mesh/interfaces/values", H5T_NATIVE_INT32, 0, slab, mesh.interface_pairs);
    read_rows("/Mesh/interfaces/curves", H5T_NATIVE_INT32, 0, slab, mesh.interface_curves);
    check_ids(mesh.interfaces, mesh);
  }

  void read_splits(mesh::DistributedMesh& mesh) const {
    if (!file_.has("/Mesh/splits/pairs"))
      return;
    mesh.split_slab = share(file_.rows("/Mesh/splits/pairs"), comm_);
    read_rows("/Mesh/splits/pairs", H5T_NATIVE_INT64, 2, mesh.split_slab, mesh.split_pairs);
    read_rows("/Mesh/splits/curves", H5T_NATIVE_INT32, 0, mesh.split_slab, mesh.split_curves);
    read_rows("/Mesh/splits/paths", H5T_NATIVE_INT32, 0, mesh.split_slab, mesh.split_paths);
    check_ids(mesh.split_pairs, mesh);
  }

  std::string field(const char* group, const char* name) const {
    const std::string inside = fmt::format("/VTKHDF/{}/{}", group, name);
    return file_.has(inside) ? inside : fmt::format("/Mesh/{}/{}", group, name);
  }

  void read_points(const std::string& dataset, mesh::DistributedMesh& mesh) const {
    if (is_plain_)
      read_rows(dataset, H5T_NATIVE_DOUBLE, 2, mesh.point_slab, mesh.points);
    else {
      std::vector<std::array<double, 3>> places;
      read_rows(dataset, H5T_NATIVE_DOUBLE, 3, mesh.point_slab, places);
      mesh.points.resize(places.size());
      std::transform(places.begin(), places.end(), mesh.points.begin(), [](const std::array<double, 3>& p) {
        return geometry::Vec2{p[0], p[1]};
      });
    }
    read_rows(field("PointData", "boundary"), H5T_NATIVE_INT32, 0, mesh.point_slab, mesh.boundary);
    read_rows(field("PointData", "size"), H5T_NATIVE_FLOAT, 0, mesh.point_slab, mesh.size);
    read_rows(field("PointData", "fixed"), H5T_NATIVE_UINT8, 0, mesh.point_slab, mesh.fixed);
    if (const std::string depth = field("PointData", "depth"); file_.has(depth))
      read_rows(depth, H5T_NATIVE_DOUBLE, 0, mesh.point_slab, mesh.depth.emplace());
  }

  void read_triangles(mesh::DistributedMesh& mesh, std::vector<std::array<GlobalId, 3>>& triangles) const {
    const std::string ids = is_plain_ ? "/Mesh/mesh/topology" : "/VTKHDF/Connectivity";
    mesh.triangle_slab = share(file_.rows(ids) / (is_plain_ ? 1 : 3), comm_);
    const std::int64_t count = rows_of(mesh.triangle_slab, comm_);
    triangles.resize(static_cast<std::size_t>(count));
    if (is_plain_)
      file_.read(ids, H5T_NATIVE_INT64, 3, mesh.triangle_slab.first, count, triangles.data());
    else
      file_.read(ids, H5T_NATIVE_INT64, 0, 3 * mesh.triangle_slab.first, 3 * count, triangles.data());
    read_rows(field("CellData", "alpha"), H5T_NATIVE_FLOAT, 0, mesh.triangle_slab, mesh.alpha);
    read_rows(field("CellData", "beta"), H5T_NATIVE_FLOAT, 0, mesh.triangle_slab, mesh.beta);
    read_rows(field("CellData", "region"), H5T_NATIVE_INT32, 0, mesh.triangle_slab, mesh.region);
  }

  template <class Cells>
  void check_ids(const Cells& cells, const mesh::DistributedMesh& mesh) const {
    for (const auto& cell : cells)
      for (const GlobalId id : cell)
        if (id < 0 || id >= mesh.point_slab.total)
          throw FileError(fmt::format("{} is damaged: it names point {}, expected one from 0 to {}", path_, id,
                                      mesh.point_slab.total - 1));
  }

  std::string path_;
  Hdf5Input file_;
  const comm::Communicator& comm_;
  bool is_plain_;
};

} // namespace

Metadata read_metadata(const std::string& path, const std::vector<std::string>& groups,
                       const comm::Communicator& comm) {
  Metadata metadata;
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    const Hdf5Input file(path);
    if (!file.has(root_group))
      throw FileError(
          fmt::format("{} is not a mesh file of trime_mpi: expected the group {}, found none", path, root_group));
    metadata.attributes = file.attributes(root_group);
    metadata.texts = file.texts(root_group);
    for (const std::string& group : groups)
      if (const std::string inside = root_group + "/" + group; file.has(inside))
        metadata.groups.push_back({group, file.attributes(inside), file.columns(inside)});
  });
  return broadcast(metadata, comm);
}

mesh::DistributedMesh read_mesh(const std::string& path, const Metadata& metadata, const comm::Communicator& comm) {
  mesh::DistributedMesh mesh;
  std::uint64_t hash = 0;
  comm::run_agreed(comm, [&] {
    std::vector<std::array<GlobalId, 3>> triangles;
    MeshReader(path, comm).read(mesh, triangles);
    mesh::assign_triangles(mesh, triangles);
    hash = attribute_of<std::uint64_t>(metadata, "mesh_hash");
  });
  mesh.hash = static_cast<std::uint64_t>(comm.sum(static_cast<std::int64_t>(mesh::partial_hash(mesh))));
  if (mesh.hash != hash) // the same on all ranks
    throw FileError(fmt::format("{} was changed after it was written: expected a mesh with hash {:016x}, found {:016x}",
                                path, hash, mesh.hash));
  return mesh;
}

} // namespace trime::io
