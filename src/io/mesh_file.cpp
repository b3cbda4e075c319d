// SPDX-License-Identifier: BSD-3-Clause
#include "trime/io/mesh_file.hpp"

#include "comm/agree.hpp"
#include "io/extra_arrays.hpp"
#include "io/extra_group.hpp"
#include "io/id_bytes.hpp"
#include "io/labelled_lines.hpp"
#include "io/mesh_file_start.hpp"
#include "io/slab_file.hpp"
#include "io/temporary_file.hpp"
#include "io/xdmf.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace trime::io {
namespace {

template <class T>
hid_t value_type();
template <>
hid_t value_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t value_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t value_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t value_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t value_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

/// Values of type T in a buffer of slices, which is aligned for all of them.
template <class T>
T* values_of(std::byte* out) {
  return reinterpret_cast<T*>(out);
}

/// An array whose rows are Row values in memory, each made of `columns` (0: one) values of type T.
template <class T, class Row, class Allocator>
SlabArray stored(const std::string& path, const mesh::Slab& slab, hsize_t columns,
                 const std::vector<Row, Allocator>& rows) {
  static_assert(std::is_trivially_copyable_v<Row> && sizeof(Row) % sizeof(T) == 0);
  const auto fill = [&rows](std::int64_t first, std::int64_t count, std::byte* out) {
    std::memcpy(out, rows.data() + first, static_cast<std::size_t>(count) * sizeof(Row));
  };
  return {path, value_type<T>(), sizeof(T), columns, slab, static_cast<std::int64_t>(rows.size()), fill};
}

/// An array whose row i (global) is computed.
template <class T, class Value>
SlabArray computed(const std::string& path, const mesh::Slab& slab, std::int64_t rows, const Value& value) {
  const auto fill = [first_here = slab.first, value](std::int64_t first, std::int64_t count, std::byte* out) {
    T* values = values_of<T>(out);
    for (std::int64_t k = 0; k < count; ++k)
      values[k] = value(first_here + first + k);
  };
  return {path, value_type<T>(), sizeof(T), 0, slab, rows, fill};
}

/// Global ids, as T, of the vertices of triangles: three columns, or (0) one long one.
template <class T>
SlabArray vertex_ids_as(const std::string& path, const mesh::DistributedMesh& mesh, hsize_t columns) {
  const std::int64_t ids_per_row = columns == 0 ? 1 : 3, rows_per_triangle = 3 / ids_per_row;
  const auto fill = [&mesh, ids_per_row](std::int64_t first, std::int64_t count, std::byte* out) {
    const LocalIndex* vertices = mesh.triangles.data()->data() + ids_per_row * first;
    T* ids = values_of<T>(out);
    if (mesh.foreign.empty())
      std::transform(
          vertices, vertices + ids_per_row * count, ids,
          [begin = static_cast<T>(mesh.point_slab.first)](LocalIndex vertex) -> T { return begin + vertex; });
    else
      std::transform(vertices, vertices + ids_per_row * count, ids,
                     [&mesh](LocalIndex vertex) { return static_cast<T>(mesh.global_id(vertex)); });
  };
  const mesh::Slab& slab = mesh.triangle_slab;
  return {path,
          value_type<T>(),
          sizeof(T),
          columns,
          {rows_per_triangle * slab.first, rows_per_triangle * slab.total},
          rows_per_triangle * static_cast<std::int64_t>(mesh.triangles.size()),
          fill};
}
SlabArray vertex_ids(const std::string& path, const mesh::DistributedMesh& mesh, hsize_t columns, int bytes_per_id) {
  return bytes_per_id == 4 ? vertex_ids_as<std::int32_t>(path, mesh, columns)
                           : vertex_ids_as<std::int64_t>(path, mesh, columns);
}

/// Points with z = 0, as VTK wants them.
SlabArray points_in_space(const std::string& path, const mesh::DistributedMesh& mesh) {
  const auto fill = [&points = mesh.points](std::int64_t first, std::int64_t count, std::byte* out) {
    double* xyz = values_of<double>(out);
    for (std::int64_t k = 0; k < count; ++k, xyz += 3) {
      const geometry::Vec2 p = points[static_cast<std::size_t>(first + k)];
      xyz[0] = p.x;
      xyz[1] = p.y;
      xyz[2] = 0;
    }
  };
  return {path, H5T_NATIVE_DOUBLE, sizeof(double), 3, mesh.point_slab, static_cast<std::int64_t>(mesh.points.size()),
          fill};
}

/// Offsets 0, 3, 6, ..., 3M: one more than triangles; the rank that holds the last triangle writes the last one.
SlabArray offsets(const std::string& path, const mesh::DistributedMesh& mesh, int bytes_per_id) {
  mesh::Slab slab = mesh.triangle_slab;
  auto rows = static_cast<std::int64_t>(mesh.triangles.size());
  if (rows > 0 && slab.first + rows == slab.total)
    ++rows;
  slab.total += 1;
  if (bytes_per_id == 4)
    return computed<std::int32_t>(path, slab, rows,
                                  [](std::int64_t row) { return static_cast<std::int32_t>(3 * row); });
  return computed<std::int64_t>(path, slab, rows, [](std::int64_t row) { return 3 * row; });
}

void write_fields(SlabFile& file, const std::string& cells, const std::string& points,
                  const mesh::DistributedMesh& mesh) {
  file.slab(stored<float>(cells + "/alpha", mesh.triangle_slab, 0, mesh.alpha));
  file.slab(stored<float>(cells + "/beta", mesh.triangle_slab, 0, mesh.beta));
  file.slab(mesh.region.empty()
                ? computed<std::int32_t>(cells + "/region", mesh.triangle_slab, std::ssize(mesh.triangles),
                                         [](std::int64_t) { return std::int32_t{1}; })
                : stored<std::int32_t>(cells + "/region", mesh.triangle_slab, 0, mesh.region));
  file.slab(stored<std::int32_t>(points + "/boundary", mesh.point_slab, 0, mesh.boundary));
  file.slab(stored<float>(points + "/size", mesh.point_slab, 0, mesh.size));
  file.slab(stored<std::uint8_t>(points + "/fixed", mesh.point_slab, 0, mesh.fixed));
  if (mesh.depth)
    file.slab(stored<double>(points + "/depth", mesh.point_slab, 0, *mesh.depth));
}

/// @param with_elements false: points and triangles show those of the plain mesh
void write_vtkhdf(SlabFile& file, const mesh::DistributedMesh& mesh, bool with_elements, int bytes_per_id) {
  if (with_elements) {
    file.slab(points_in_space("/VTKHDF/Points", mesh));
    file.slab(vertex_ids("/VTKHDF/Connectivity", mesh, 0, bytes_per_id));
  }
  file.slab(offsets("/VTKHDF/Offsets", mesh, bytes_per_id));
  constexpr std::uint8_t vtk_triangle = 5;
  file.slab(computed<std::uint8_t>("/VTKHDF/Types", mesh.triangle_slab, std::ssize(mesh.triangles),
                                   [](std::int64_t) { return vtk_triangle; }));
}

/// The 2D view of FEniCS, with hard links at the places where PETSc looks.
void write_plain_mesh(SlabFile& file, const mesh::DistributedMesh& mesh, int bytes_per_id) {
  file.group("/Mesh/mesh");
  file.slab(stored<double>("/Mesh/mesh/geometry", mesh.point_slab, 2, mesh.points));
  file.slab(vertex_ids("/Mesh/mesh/topology", mesh, 3, bytes_per_id));
  file.attribute("/Mesh/mesh/topology", {"cell_dim", std::int64_t{2}});
  file.attribute("/Mesh/mesh/topology", {"cell_corners", std::int64_t{3}});
  file.group("/geometry");
  file.hard_link("/Mesh/mesh/geometry", "/geometry/vertices");
  file.group("/viz");
  file.group("/viz/topology");
  file.hard_link("/Mesh/mesh/topology", "/viz/topology/cells");
}

/// Returns the marker of each facet; empty if no part has one. All ranks decide the same, since they have the same
/// parts.
std::optional<std::vector<std::int32_t>> facet_markers(const MeshFileOptions& options,
                                                       const mesh::DistributedMesh& mesh) {
  const std::vector<std::int32_t>& of_part = options.part_markers;
  if (std::all_of(of_part.begin(), of_part.end(), [](std::int32_t marker) { return marker == 0; }))
    return std::nullopt;
  std::vector<std::int32_t> markers;
  markers.reserve(mesh.facet_parts.size());
  for (const std::int32_t part : mesh.facet_parts)
    markers.push_back(static_cast<std::size_t>(part) < of_part.size() ? of_part[static_cast<std::size_t>(part)]
                                                                      : 0); // a side of a curve
  return markers;
}

/// Tags of boundary edges: `values` by loop, `parts` by part of the shape and `labels` as the formats of other programs
/// count them, `markers` by segment of the user's file where a shape has any. @param markers outlive the file
void write_facets(SlabFile& file, const mesh::DistributedMesh& mesh,
                  const std::optional<std::vector<std::int32_t>>& markers) {
  file.group("/Mesh/facets");
  file.slab(stored<std::int64_t>("/Mesh/facets/topology", mesh.facet_slab, 2, mesh.facets));
  file.slab(stored<std::int32_t>("/Mesh/facets/values", mesh.facet_slab, 0, mesh.facet_tags));
  file.slab(stored<std::int32_t>("/Mesh/facets/parts", mesh.facet_slab, 0, mesh.facet_parts));
  file.slab(computed<std::int32_t>("/Mesh/facets/labels", mesh.facet_slab, std::ssize(mesh.facets),
                                   [&mesh](std::int64_t row) {
                                     return mesh.facet_parts[static_cast<std::size_t>(row - mesh.facet_slab.first)] + 1;
                                   }));
  file.slab(stored<float>("/Mesh/facets/asked_size", mesh.facet_slab, 0, mesh.facet_sizes));
  if (markers)
    file.slab(stored<std::int32_t>("/Mesh/facets/markers", mesh.facet_slab, 0, *markers));
}

/// Edges on curves inside; `labels` as the formats of other programs count them, after those of the parts.
void write_curves(SlabFile& file, const mesh::DistributedMesh& mesh, std::size_t parts) {
  if (mesh.curve_slab.total == 0)
    return;
  file.group("/Mesh/curves");
  file.slab(stored<std::int64_t>("/Mesh/curves/topology", mesh.curve_slab, 2, mesh.curve_edges));
  file.slab(stored<std::int32_t>("/Mesh/curves/values", mesh.curve_slab, 0, mesh.curve_numbers));
  file.slab(computed<std::int32_t>("/Mesh/curves/labels", mesh.curve_slab, std::ssize(mesh.curve_edges),
                                   [&mesh, parts](std::int64_t row) {
                                     const auto k = static_cast<std::size_t>(row - mesh.curve_slab.first);
                                     return static_cast<std::int32_t>(parts) + mesh.curve_numbers[k] + 1;
                                   }));
}

/// Edges between regions; `labels` as the formats of other programs count them, after those of the curves.
void write_interfaces(SlabFile& file, const mesh::DistributedMesh& mesh, std::size_t parts_and_curves) {
  const mesh::Slab& slab = mesh.interface_slab;
  if (slab.total == 0)
    return;
  file.group("/Mesh/interfaces");
  file.slab(stored<std::int64_t>("/Mesh/interfaces/topology", slab, 2, mesh.interfaces));
  file.slab(stored<std::int32_t>("/Mesh/interfaces/regions", slab, 2, mesh.interface_regions));
  file.slab(stored<std::int32_t>("/Mesh/interfaces/values", slab, 0, mesh.interface_pairs));
  file.slab(stored<std::int32_t>("/Mesh/interfaces/curves", slab, 0, mesh.interface_curves));
  file.slab(computed<std::int32_t>("/Mesh/interfaces/labels", slab, std::ssize(mesh.interfaces),
                                   [&mesh, parts_and_curves](std::int64_t row) {
                                     const auto k = static_cast<std::size_t>(row - mesh.interface_slab.first);
                                     return static_cast<std::int32_t>(parts_and_curves) + mesh.interface_pairs[k] + 1;
                                   }));
}

/// Pairs of points on both sides of curves that are split.
void write_splits(SlabFile& file, const mesh::DistributedMesh& mesh) {
  if (mesh.split_slab.total == 0)
    return;
  file.group("/Mesh/splits");
  file.slab(stored<std::int64_t>("/Mesh/splits/pairs", mesh.split_slab, 2, mesh.split_pairs));
  file.slab(stored<std::int32_t>("/Mesh/splits/curves", mesh.split_slab, 0, mesh.split_curves));
  file.slab(stored<std::int32_t>("/Mesh/splits/paths", mesh.split_slab, 0, mesh.split_paths));
}

/// Returns whether there are labelled edges that are not facets.
bool has_inner_edges(const mesh::DistributedMesh& mesh) {
  return mesh.curve_slab.total > 0 || mesh.interface_slab.total > 0;
}

/// All labelled edges, each once, since a program may read only one list of them. @param lines outlive the file
void write_lines(SlabFile& file, const LabelledLines& lines) {
  file.group("/Mesh/lines");
  file.slab(stored<std::int64_t>("/Mesh/lines/topology", lines.slab, 2, lines.ends));
  file.slab(stored<std::int32_t>("/Mesh/lines/labels", lines.slab, 0, lines.labels));
}

/// Points are numbered along the ranks: those of rank r begin at first_point[r]. Every rank writes its own row.
void write_ranks(SlabFile& file, const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  file.group("/trime_mpi/ranks");
  file.slab(computed<std::int64_t>("/trime_mpi/ranks/first_point", {comm.rank(), comm.size()}, 1,
                                   [&mesh](std::int64_t) { return mesh.point_slab.first; }));
}

/// Size of the file, a little too large.
std::int64_t file_bytes(const MeshFileOptions& options, const mesh::DistributedMesh& mesh, const Metadata& metadata,
                        int per_id) {
  const std::int64_t vtkhdf = options.vtkhdf ? 1 : 0, only_vtkhdf = has_plain_mesh(options) ? 0 : 1;
  const std::int64_t per_point = 9 + 16 + 8 * only_vtkhdf + (mesh.depth ? 8 : 0),
                     per_triangle = 12 + 3 * per_id + (1 + per_id) * vtkhdf;
  constexpr std::int64_t headers = 64 << 10, per_facet = 36, per_line = 20, per_inner_edge = 56, per_pair = 24;
  std::int64_t bytes =
      headers + per_point * mesh.point_slab.total + per_triangle * mesh.triangle_slab.total +
      per_facet * mesh.facet_slab.total + per_inner_edge * (mesh.curve_slab.total + mesh.interface_slab.total) +
      per_pair * mesh.split_slab.total + (has_inner_edges(mesh) ? per_line * mesh.facet_slab.total : 0);
  for (const Text& text : metadata.texts)
    bytes += static_cast<std::int64_t>(text.text.size());
  for (const MetadataGroup& group : metadata.groups)
    for (const Column& column : group.columns)
      bytes +=
          std::visit([](const auto& values) { return static_cast<std::int64_t>(64 * values.size()); }, column.values);
  return bytes + bytes / 16; // alignment of large arrays
}

/// Keeps references to all that the file holds.
struct FileContent {
  const MeshFileOptions& options;
  const mesh::DistributedMesh& mesh;
  const Metadata& metadata;
  const std::vector<ExtraGroup>& groups;
  int bytes_per_id = 0; // of a vertex of a triangle

  std::int64_t bytes() const {
    std::int64_t sum = file_bytes(options, mesh, metadata, bytes_per_id);
    for (const ExtraGroup& group : groups)
      sum += group.bytes() + group.bytes() / 16;
    return sum;
  }
};

/// Sets the value `complete` to 0, as long as the file is being written. Returns what it was, if there is one.
std::optional<Attribute> withdraw_completeness(Metadata& metadata) {
  for (Attribute& attribute : metadata.attributes)
    if (attribute.name == "complete")
      return std::exchange(attribute, {attribute.name, std::int64_t{0}});
  return std::nullopt;
}

/// @param completeness the last thing that is written, after all has been read back
/// @return number of labelled edges
std::int64_t write_hdf5(const std::string& path, const FileContent& content,
                        const std::optional<Attribute>& completeness, const comm::Communicator& comm) {
  const auto& [options, mesh, metadata, groups, bytes_per_id] = content;
  const auto markers = facet_markers(options, mesh);
  const std::size_t parts = options.part_markers.size(), curves = curve_names(metadata).size();
  const LabelledLines lines = has_inner_edges(mesh) ? labelled_lines(mesh, parts, curves, comm) : LabelledLines{};
  SlabFile file(comm, path, content.bytes(), [&content](const FileStart& start) {
    start_mesh_file(start, content.options, content.mesh, content.metadata, content.bytes_per_id);
  });
  if (options.vtkhdf)
    write_vtkhdf(file, mesh, !has_plain_mesh(options), bytes_per_id);
  write_fields(file, field_group(options, "CellData"), field_group(options, "PointData"), mesh);
  if (has_plain_mesh(options))
    write_plain_mesh(file, mesh, bytes_per_id);
  write_facets(file, mesh, markers);
  write_curves(file, mesh, parts);
  write_interfaces(file, mesh, parts + curves);
  if (has_inner_edges(mesh))
    write_lines(file, lines);
  write_splits(file, mesh);
  for (const ExtraGroup& group : groups)
    write_group(file, group);
  write_ranks(file, mesh, comm);
  file.verify();
  if (completeness)
    file.change_attribute("/trime_mpi", *completeness);
  file.close();
  return has_inner_edges(mesh) ? lines.slab.total : mesh.facet_slab.total;
}

void check_shapes(const mesh::DistributedMesh& mesh) {
  const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size(), facets = mesh.facets.size();
  TRIME_ASSERT(mesh.boundary.size() == points && mesh.size.size() == points && mesh.fixed.size() == points,
               "the arrays of points have different lengths: {} points, {} boundary, {} size, {} fixed", points,
               mesh.boundary.size(), mesh.size.size(), mesh.fixed.size());
  TRIME_ASSERT(!mesh.depth || mesh.depth->size() == points, "expected a depth for each of {} points, found {}", points,
               mesh.depth->size());
  TRIME_ASSERT(mesh.alpha.size() == triangles && mesh.beta.size() == triangles &&
                   (mesh.region.empty() || mesh.region.size() == triangles),
               "the arrays of triangles have different lengths: {} triangles, {} alpha, {} beta, {} region", triangles,
               mesh.alpha.size(), mesh.beta.size(), mesh.region.size());
  TRIME_ASSERT(mesh.facet_tags.size() == facets && mesh.facet_parts.size() == facets &&
                   mesh.facet_sizes.size() == facets,
               "the arrays of facets have different lengths: {} facets, {} tags, {} parts, {} sizes", facets,
               mesh.facet_tags.size(), mesh.facet_parts.size(), mesh.facet_sizes.size());
  TRIME_ASSERT(mesh.split_curves.size() == mesh.split_pairs.size() &&
                   mesh.split_paths.size() == mesh.split_pairs.size(),
               "the arrays of pairs have different lengths: {} pairs, {} curves, {} paths", mesh.split_pairs.size(),
               mesh.split_curves.size(), mesh.split_paths.size());
  const std::size_t interfaces = mesh.interfaces.size();
  TRIME_ASSERT(mesh.curve_numbers.size() == mesh.curve_edges.size() && mesh.interface_regions.size() == interfaces &&
                   mesh.interface_pairs.size() == interfaces && mesh.interface_curves.size() == interfaces,
               "the arrays of inner edges have different lengths: {} edges on curves, {} curves, {} interfaces, {} "
               "regions, {} pairs, {} curves",
               mesh.curve_edges.size(), mesh.curve_numbers.size(), interfaces, mesh.interface_regions.size(),
               mesh.interface_pairs.size(), mesh.interface_curves.size());
}

/// Rank 0: final names, and the views that belong to them.
WrittenFiles publish(TemporaryFile& temporary, const MeshFileOptions& options, const XdmfContent& content) {
  const std::string h5 = options.path(".h5"), xdmf = options.path(".xdmf"), vtkhdf = options.path(".vtkhdf"),
                    lines = options.path(".xmf");
  temporary.rename_to(h5, options.overwrite);
  if (options.is_final && options.run_files)
    options.run_files->set_final_mesh_written();
  WrittenFiles written{{h5}, 0};
  struct stat status {};
  if (stat(h5.c_str(), &status) == 0)
    written.bytes = status.st_size;
  // Views of an older mesh of this name would lie about the new one.
  for (const std::string& path : {xdmf, vtkhdf, lines})
    unlink(path.c_str());
  if (options.xdmf) {
    write_one_text_file(xdmf, xdmf_text(content), options.run_files);
    written.paths.push_back(xdmf);
    if (content.lines > 0) { // a torus may have none
      write_one_text_file(lines, xdmf_facets_text(content), options.run_files);
      written.paths.push_back(lines);
    }
  }
  if (options.vtkhdf) {
    replace_link(options.name + ".h5", vtkhdf);
    written.paths.push_back(vtkhdf);
  }
  synchronise_directory(h5);
  return written;
}

} // namespace

std::string field_group(const MeshFileOptions& options, const char* name) {
  return std::string(options.vtkhdf ? "/VTKHDF/" : "/Mesh/") + name;
}

WrittenFiles write_mesh(const MeshFileOptions& options, const mesh::DistributedMesh& mesh, const Metadata& metadata,
                        const comm::Communicator& comm) {
  return write_mesh_and({}, options, mesh, metadata, comm);
}

WrittenFiles write_mesh_and(const ExtraContent& extra, const MeshFileOptions& options,
                            const mesh::DistributedMesh& mesh, const Metadata& metadata,
                            const comm::Communicator& comm) {
  check_shapes(mesh);
  Metadata of_root = broadcast(metadata, comm);
  const std::optional<Attribute> completeness = withdraw_completeness(of_root);
  const int bytes_per_id = id_bytes(mesh.triangle_slab.total, extra.largest_int32);
  const std::string path = comm.broadcast(temporary_name(options.path(".h5")));
  std::optional<TemporaryFile> temporary; // rank 0 removes it if anything fails
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      temporary.emplace(path, options.run_files);
  });
  const std::int64_t lines = write_hdf5(path, {options, mesh, of_root, extra.groups, bytes_per_id}, completeness, comm);
  const XdmfContent content{options.name + ".h5",
                            field_group(options, "CellData"),
                            field_group(options, "PointData"),
                            mesh.point_slab.total,
                            mesh.triangle_slab.total,
                            lines,
                            bytes_per_id,
                            0,
                            has_inner_edges(mesh),
                            has_regions(of_root),
                            mesh.depth.has_value()};
  WrittenFiles written;
  comm::run_agreed(comm, [&] {
    if (temporary)
      written = publish(*temporary, options, content);
  });
  return written;
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

} // namespace trime::io
