// SPDX-License-Identifier: BSD-3-Clause
// The mesh file against its contract, by plain HDF5 calls of its own: paths, types, shapes, attributes and values, the
// same for any distribution over ranks, empty ranks included.
#include "trime/io/mesh_file.hpp"

#include "core/random.hpp"
#include "io/extra_arrays.hpp"
#include "support/hdf5_reading.hpp"
#include "support/mesh_slabs.hpp"
#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"
#include "trime/formats/exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace trime::io {
namespace {

using formats::check_output;

namespace fs = std::filesystem;

// A mesh whose values are functions of the global index: not geometric, but every slip of a row shows.
constexpr std::int64_t n_points = 1000, n_triangles = 1900, n_facets = 101;

double coordinate(std::int64_t i, int axis) {
  return random_unit(1, RandomPurpose::test, i, axis);
}
std::int64_t vertex(std::int64_t i, int k) {
  return (3 * i + k) % n_points;
}

using test::expect_values;
using test::read;
using test::share;

mesh::DistributedMesh make_mesh(const comm::Communicator& comm, std::uint64_t seed) {
  mesh::DistributedMesh mesh;
  std::int64_t points = 0, triangles = 0, facets = 0;
  mesh.point_slab = share(comm, n_points, seed, points);
  mesh.triangle_slab = share(comm, n_triangles, seed + 10, triangles);
  mesh.facet_slab = share(comm, n_facets, seed + 20, facets);
  for (std::int64_t k = 0, i = mesh.point_slab.first; k < points; ++k, ++i) {
    mesh.points.push_back({coordinate(i, 0), coordinate(i, 1)});
    mesh.boundary.push_back(static_cast<std::int32_t>(i % 4));
    mesh.size.push_back(static_cast<float>(i) / 7);
    mesh.fixed.push_back(i % 5 == 0);
  }
  std::vector<std::array<GlobalId, 3>> ids;
  for (std::int64_t k = 0, i = mesh.triangle_slab.first; k < triangles; ++k, ++i) {
    ids.push_back({vertex(i, 0), vertex(i, 1), vertex(i, 2)});
    mesh.alpha.push_back(1 + static_cast<float>(i) / 3);
    mesh.beta.push_back(1 + static_cast<float>(i) / 5);
    mesh.region.push_back(static_cast<std::int32_t>(i % 2));
  }
  assign_triangles(mesh, ids);
  for (std::int64_t k = 0, i = mesh.facet_slab.first; k < facets; ++k, ++i) {
    mesh.facets.push_back({i, (i + 1) % n_facets});
    mesh.facet_tags.push_back(static_cast<std::int32_t>(1 + i % 3));
    mesh.facet_parts.push_back(static_cast<std::int32_t>(i % 5));
    mesh.facet_sizes.push_back(0.25F * static_cast<float>(i));
  }
  return mesh;
}

Metadata make_metadata(const comm::Communicator& comm) {
  // What other ranks say must not matter, not even its length.
  const std::string host = comm.is_root() ? "node1" : "some-other-node";
  Metadata metadata;
  metadata.attributes = {{"host", host},
                         {"empty", std::string()},
                         {"mesh_hash", std::uint64_t{0xfedcba9876543210}},
                         {"seconds", 0.5 + comm.rank()}};
  metadata.texts = {{"config_text", "[domain]\n; \xC3\xA4\n"}, {"nothing", ""}};
  metadata.groups = {{"history",
                      {{"sweeps", std::int64_t{2}}},
                      {{"sweep", std::vector<std::int64_t>{1, 2}}, {"mean_alpha", std::vector<double>{1.5, 1.25}}}},
                     {"tags",
                      {},
                      {{"edge_id", std::vector<std::int32_t>{1, 2}},
                       {"edge_name", std::vector<std::string>{"outer", "h"}},
                       {"none", std::vector<double>{}}}}};
  return metadata;
}

std::string read_text(hid_t object, const char* attribute) {
  const Hdf5Attribute opened(H5Aopen(object, attribute, H5P_DEFAULT), attribute);
  const Hdf5Type type(H5Aget_type(opened), "type");
  EXPECT_EQ(H5Tis_variable_str(type), 0);
  std::string text(H5Tget_size(type), 'x');
  H5Aread(opened, type, text.data());
  return text;
}

/// Reads ids that the file holds as T, and compares row i with expected(i).
template <class T, class F>
void expect_ids(hid_t file, const char* path, const std::vector<hsize_t>& shape, const F& expected,
                H5D_layout_t layout = H5D_CONTIGUOUS) {
  const hid_t type = sizeof(T) == 4 ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
  const hsize_t values = shape[0] * (shape.size() > 1 ? shape[1] : 1);
  expect_values(read<T>(file, path, type, shape, layout), static_cast<std::int64_t>(values), expected);
}

template <class T>
void expect_connectivity(hid_t file, H5D_layout_t layout) {
  expect_ids<T>(
      file, "/VTKHDF/Connectivity", {3 * n_triangles},
      [](std::int64_t i) { return vertex(i / 3, static_cast<int>(i % 3)); }, layout);
  expect_ids<T>(file, "/VTKHDF/Offsets", {n_triangles + 1}, [](std::int64_t i) { return 3 * i; });
}

template <class T>
void expect_topology(hid_t file) {
  for (const char* path : {"/Mesh/mesh/topology", "/viz/topology/cells"})
    expect_ids<T>(file, path, {n_triangles, 3}, [](std::int64_t i) { return vertex(i / 3, static_cast<int>(i % 3)); });
}

void expect_vtkhdf(hid_t file) {
  const Hdf5Group group(H5Gopen2(file, "/VTKHDF", H5P_DEFAULT), "VTKHDF");
  EXPECT_EQ(read_text(group, "Type"), "UnstructuredGrid");
  const Hdf5Attribute type_attribute(H5Aopen(group, "Type", H5P_DEFAULT), "Type");
  const Hdf5Type type(H5Aget_type(type_attribute), "type");
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII);
  const Hdf5Attribute version(H5Aopen(group, "Version", H5P_DEFAULT), "Version");
  std::int64_t numbers[2] = {-1, -1};
  H5Aread(version, H5T_NATIVE_INT64, numbers);
  EXPECT_EQ(numbers[0], 1);
  EXPECT_EQ(numbers[1], 0);
  const hid_t i64 = H5T_NATIVE_INT64, f32 = H5T_NATIVE_FLOAT, i32 = H5T_NATIVE_INT32;
  EXPECT_EQ(read<std::int64_t>(file, "/VTKHDF/NumberOfPoints", i64, {1})[0], n_points);
  EXPECT_EQ(read<std::int64_t>(file, "/VTKHDF/NumberOfCells", i64, {1})[0], n_triangles);
  EXPECT_EQ(read<std::int64_t>(file, "/VTKHDF/NumberOfConnectivityIds", i64, {1})[0], 3 * n_triangles);
  expect_values(read<double>(file, "/VTKHDF/Points", H5T_NATIVE_DOUBLE, {n_points, 3}, H5D_VIRTUAL), 3 * n_points,
                [](std::int64_t i) { return i % 3 == 2 ? 0 : coordinate(i / 3, static_cast<int>(i % 3)); });
  expect_connectivity<std::int32_t>(file, H5D_VIRTUAL);
  expect_values(read<std::uint8_t>(file, "/VTKHDF/Types", H5T_NATIVE_UINT8, {n_triangles}), n_triangles,
                [](std::int64_t) { return 5; });
  expect_values(read<float>(file, "/VTKHDF/CellData/alpha", f32, {n_triangles}), n_triangles,
                [](std::int64_t i) { return 1 + static_cast<float>(i) / 3; });
  expect_values(read<float>(file, "/VTKHDF/CellData/beta", f32, {n_triangles}), n_triangles,
                [](std::int64_t i) { return 1 + static_cast<float>(i) / 5; });
  expect_values(read<std::int32_t>(file, "/VTKHDF/CellData/region", i32, {n_triangles}), n_triangles,
                [](std::int64_t i) { return i % 2; });
  expect_values(read<std::int32_t>(file, "/VTKHDF/PointData/boundary", i32, {n_points}), n_points,
                [](std::int64_t i) { return i % 4; });
  expect_values(read<float>(file, "/VTKHDF/PointData/size", f32, {n_points}), n_points,
                [](std::int64_t i) { return static_cast<float>(i) / 7; });
  expect_values(read<std::uint8_t>(file, "/VTKHDF/PointData/fixed", H5T_NATIVE_UINT8, {n_points}), n_points,
                [](std::int64_t i) { return i % 5 == 0; });
}

void expect_plain_mesh(hid_t file) {
  const hid_t i64 = H5T_NATIVE_INT64;
  for (const char* path : {"/Mesh/mesh/geometry", "/geometry/vertices"})
    expect_values(read<double>(file, path, H5T_NATIVE_DOUBLE, {n_points, 2}), 2 * n_points,
                  [](std::int64_t i) { return coordinate(i / 2, static_cast<int>(i % 2)); });
  expect_topology<std::int32_t>(file);
  for (const char* path : {"/Mesh/mesh/topology", "/viz/topology/cells"}) {
    for (const auto& [name, expected] : {std::pair("cell_dim", 2), std::pair("cell_corners", 3)}) {
      const Hdf5Attribute attribute(H5Aopen_by_name(file, path, name, H5P_DEFAULT, H5P_DEFAULT), name);
      std::int64_t value = 0;
      H5Aread(attribute, i64, &value);
      EXPECT_EQ(value, expected);
    }
  }
  expect_values(read<std::int64_t>(file, "/Mesh/facets/topology", i64, {n_facets, 2}), 2 * n_facets,
                [](std::int64_t i) { return (i / 2 + i % 2) % n_facets; });
  expect_values(read<std::int32_t>(file, "/Mesh/facets/values", H5T_NATIVE_INT32, {n_facets}), n_facets,
                [](std::int64_t i) { return 1 + i % 3; });
  expect_values(read<std::int32_t>(file, "/Mesh/facets/parts", H5T_NATIVE_INT32, {n_facets}), n_facets,
                [](std::int64_t i) { return i % 5; });
}

void expect_metadata(hid_t file) {
  const Hdf5Group group(H5Gopen2(file, "/trime_mpi", H5P_DEFAULT), "trime_mpi");
  EXPECT_EQ(read_text(group, "host"), "node1");
  std::uint64_t hash = 0;
  const Hdf5Attribute attribute(H5Aopen(group, "mesh_hash", H5P_DEFAULT), "mesh_hash");
  H5Aread(attribute, H5T_NATIVE_UINT64, &hash);
  EXPECT_EQ(hash, 0xfedcba9876543210u);
  EXPECT_EQ(read<double>(file, "/trime_mpi/history/mean_alpha", H5T_NATIVE_DOUBLE, {2})[1], 1.25);
  EXPECT_EQ(read<std::int64_t>(file, "/trime_mpi/history/sweep", H5T_NATIVE_INT64, {2})[1], 2);
  EXPECT_EQ(read<std::int32_t>(file, "/trime_mpi/tags/edge_id", H5T_NATIVE_INT32, {2})[1], 2);
  EXPECT_EQ(read<double>(file, "/trime_mpi/tags/none", H5T_NATIVE_DOUBLE, {0}).size(), 0u);
  const Hdf5Dataset text(H5Dopen2(file, "/trime_mpi/config_text", H5P_DEFAULT), "config_text");
  const Hdf5Type type(H5Dget_type(text), "type");
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_UTF8);
  std::string config(H5Tget_size(type), 'x');
  H5Dread(text, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, config.data());
  EXPECT_EQ(config, "[domain]\n; \xC3\xA4\n");
}

std::string content(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

MeshFileOptions options_in(const std::string& directory) {
  MeshFileOptions options;
  options.directory = directory + "/deep/er";
  options.name = "a&b";
  return options;
}

TEST(MeshFile, KeepsItsContractOnAnyDistribution) {
  const comm::Communicator comm = comm::Communicator::world();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const test::TemporaryDirectory directory(comm);
    const MeshFileOptions options = options_in(directory.path());
    EXPECT_TRUE(check_output(options, comm).empty());
    const WrittenFiles written = write_mesh(options, make_mesh(comm, seed), make_metadata(comm), comm);
    if (!comm.is_root())
      continue;
    EXPECT_EQ(written.paths.size(), 4u);
    EXPECT_EQ(std::distance(fs::directory_iterator(options.directory), {}), 4) << "something was left behind";
    EXPECT_EQ(fs::read_symlink(options.path(".vtkhdf")), "a&b.h5");
    const Hdf5File file(H5Fopen(options.path(".vtkhdf").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
    expect_vtkhdf(file);
    expect_plain_mesh(file);
    expect_metadata(file);
    for (const char* shown : {"/VTKHDF/Points", "/VTKHDF/Connectivity"})
      EXPECT_EQ(test::stored_bytes(file, shown), 0) << shown;
    for (const char* absent : {"/Mesh/curves", "/Mesh/interfaces", "/Mesh/lines", "/Mesh/splits"})
      EXPECT_FALSE(H5Lexists(file, absent, H5P_DEFAULT) > 0) << absent;
    EXPECT_NE(content(options.path(".xmf")).find("/Mesh/facets/topology<"), std::string::npos);
    const std::string xdmf = content(options.path(".xdmf"));
    EXPECT_NE(xdmf.find("Dimensions=\"1900 3\""), std::string::npos);
    EXPECT_NE(xdmf.find("a&amp;b.h5:/VTKHDF/CellData/alpha<"), std::string::npos);
  }
}

Metadata metadata_of_regions(const mesh::DistributedMesh& whole) {
  return {{{"mesh_hash", mesh::partial_hash(whole)}},
          {},
          {{"curves", {}, {{"curve_name", std::vector<std::string>{"fault", "wall"}}}},
           {"interfaces", {}, {{"pair_name", std::vector<std::string>{"rest|rock", "rest|soil", "rock|soil"}}}}}};
}

/// Compares an array of numbers, or of fixed numbers of them, with a dataset.
template <class Row>
void expect_rows(hid_t file, const char* path, hid_t type, const std::vector<Row>& rows) {
  using T = std::conditional_t<std::is_same_v<Row, std::array<GlobalId, 2>>, GlobalId, std::int32_t>;
  constexpr std::size_t columns = sizeof(Row) / sizeof(T);
  std::vector<hsize_t> shape{rows.size()};
  if (columns > 1)
    shape.push_back(columns);
  const std::vector<T> values = read<T>(file, path, type, shape);
  ASSERT_EQ(values.size(), columns * rows.size());
  EXPECT_EQ(std::memcmp(values.data(), rows.data(), rows.size() * sizeof(Row)), 0) << path;
}

/// Compares a file with the whole mesh.
void expect_inner_edges(hid_t file, const mesh::DistributedMesh& whole) {
  const hid_t i64 = H5T_NATIVE_INT64, i32 = H5T_NATIVE_INT32;
  std::vector<std::array<GlobalId, 2>> lines = whole.facets;
  std::vector<std::int32_t> labels, curve_labels, interface_labels;
  for (const std::int32_t part : whole.facet_parts)
    labels.push_back(part + 1);
  for (std::size_t k = 0; k < whole.curve_edges.size(); ++k) {
    curve_labels.push_back(3 + whole.curve_numbers[k]);
    lines.push_back(whole.curve_edges[k]);
    labels.push_back(curve_labels.back());
  }
  for (std::size_t k = 0; k < whole.interfaces.size(); ++k) {
    interface_labels.push_back(5 + whole.interface_pairs[k]);
    if (whole.interface_curves[k] >= 0)
      continue;
    lines.push_back(whole.interfaces[k]);
    labels.push_back(interface_labels.back());
  }
  expect_rows(file, "/Mesh/curves/topology", i64, whole.curve_edges);
  expect_rows(file, "/Mesh/curves/labels", i32, curve_labels);
  expect_rows(file, "/Mesh/interfaces/topology", i64, whole.interfaces);
  expect_rows(file, "/Mesh/interfaces/regions", i32, whole.interface_regions);
  expect_rows(file, "/Mesh/interfaces/values", i32, whole.interface_pairs);
  expect_rows(file, "/Mesh/interfaces/curves", i32, whole.interface_curves);
  expect_rows(file, "/Mesh/interfaces/labels", i32, interface_labels);
  expect_rows(file, "/Mesh/lines/topology", i64, lines);
  expect_rows(file, "/Mesh/lines/labels", i32, labels);
}

TEST(MeshFile, HoldsInterfacesAndAllLabelledEdgesInOneOrder) {
  const comm::Communicator comm = comm::Communicator::world();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const test::TemporaryDirectory directory(comm);
    MeshFileOptions options = options_in(directory.path());
    options.part_markers = {0, 0};
    check_output(options, comm);
    const mesh::DistributedMesh whole = test::divided_square(seed == 1 ? 3 : 11);
    write_mesh(options, test::slabs_of(whole, comm, seed), metadata_of_regions(whole), comm);
    if (!comm.is_root())
      continue;
    const Hdf5File file(H5Fopen(options.path(".h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
    expect_inner_edges(file, whole);
    const std::string xdmf = content(options.path(".xdmf")), lines = content(options.path(".xmf"));
    EXPECT_EQ(xdmf.find("<Attribute Name=\"region\""), xdmf.find("<Attribute")) << "dolfinx reads the first attribute";
    EXPECT_NE(lines.find("<Grid Name=\"facets\""), std::string::npos);
    EXPECT_NE(lines.find("/Mesh/lines/topology<"), std::string::npos);
    EXPECT_NE(lines.find("/Mesh/lines/labels<"), std::string::npos);
  }
}

TEST(MeshFile, ReadsWhatItWroteOfInterfacesAndPairs) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const MeshFileOptions options = options_in(directory.path());
  check_output(options, comm);
  mesh::DistributedMesh whole = test::divided_square(11);
  for (std::int32_t k = 0; k < 23; ++k) {
    whole.split_pairs.push_back({k, 100 - k});
    whole.split_curves.push_back(k / 10);
    whole.split_paths.push_back(k / 3);
  }
  whole.split_slab.total = std::ssize(whole.split_pairs);
  const Metadata metadata = metadata_of_regions(whole);
  write_mesh(options, test::slabs_of(whole, comm, 2), metadata, comm);
  const mesh::DistributedMesh part = read_mesh(options.path(".h5"), metadata, comm);
  const auto same = [](const auto& mine, const auto& all, const mesh::Slab& slab) {
    return slab.total == std::ssize(all) && mine == test::cut(all, slab, std::ssize(mine));
  };
  EXPECT_TRUE(same(part.curve_edges, whole.curve_edges, part.curve_slab));
  EXPECT_TRUE(same(part.curve_numbers, whole.curve_numbers, part.curve_slab));
  EXPECT_TRUE(same(part.interfaces, whole.interfaces, part.interface_slab));
  EXPECT_TRUE(same(part.interface_regions, whole.interface_regions, part.interface_slab));
  EXPECT_TRUE(same(part.interface_pairs, whole.interface_pairs, part.interface_slab));
  EXPECT_TRUE(same(part.interface_curves, whole.interface_curves, part.interface_slab));
  EXPECT_TRUE(same(part.split_pairs, whole.split_pairs, part.split_slab));
  EXPECT_TRUE(same(part.split_curves, whole.split_curves, part.split_slab));
  EXPECT_TRUE(same(part.split_paths, whole.split_paths, part.split_slab));
  EXPECT_TRUE(same(part.region, whole.region, part.triangle_slab));
  EXPECT_EQ(comm.sum(std::ssize(part.interfaces)), whole.interface_slab.total);
}

TEST(MeshFile, WritesOnlyTheViewsThatAreWanted) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  MeshFileOptions options = options_in(directory.path());
  check_output(options, comm);
  write_mesh(options, make_mesh(comm, 4), {}, comm);
  options.overwrite = true;
  for (const bool vtkhdf : {true, false}) {
    options.vtkhdf = vtkhdf;
    options.xdmf = !vtkhdf;
    check_output(options, comm);
    write_mesh(options, make_mesh(comm, 5), {}, comm);
    if (!comm.is_root())
      continue;
    EXPECT_EQ(fs::is_symlink(options.path(".vtkhdf")), vtkhdf);
    EXPECT_EQ(fs::exists(options.path(".xdmf")), !vtkhdf);
    const Hdf5File file(H5Fopen(options.path(".h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
    EXPECT_EQ(H5Lexists(file, "/VTKHDF", H5P_DEFAULT) > 0, vtkhdf);
    EXPECT_EQ(H5Lexists(file, "/Mesh/mesh", H5P_DEFAULT) > 0, !vtkhdf);
    EXPECT_GT(H5Lexists(file, "/Mesh/facets", H5P_DEFAULT), 0);
    EXPECT_EQ(H5Lexists(file, "/Mesh/CellData", H5P_DEFAULT) > 0, !vtkhdf);
    if (!vtkhdf)
      continue;
    for (const auto& [path, bytes] :
         {std::pair("/VTKHDF/Points", 24 * n_points), {"/VTKHDF/Connectivity", 12 * n_triangles}})
      EXPECT_EQ(test::stored_bytes(file, path), bytes) << path << " has no array that it could show";
  }
}

TEST(MeshFile, IdsAreWiderWhereTheLastOffsetNeedsIt) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const bool xdmf : {true, false})
    for (const bool is_wide : {true, false}) {
      const test::TemporaryDirectory directory(comm);
      MeshFileOptions options = options_in(directory.path());
      options.xdmf = xdmf;
      check_output(options, comm);
      mesh::DistributedMesh mesh = make_mesh(comm, 8);
      const Metadata metadata{{{"mesh_hash", mesh::partial_hash(mesh)}}, {}, {}};
      write_mesh_and({{}, 3 * n_triangles - (is_wide ? 1 : 0)}, options, mesh, metadata, comm);
      if (!comm.is_root())
        continue;
      const Hdf5File file(H5Fopen(options.path(".h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
      const H5D_layout_t layout = xdmf ? H5D_VIRTUAL : H5D_CONTIGUOUS;
      is_wide ? expect_connectivity<std::int64_t>(file, layout) : expect_connectivity<std::int32_t>(file, layout);
      if (!xdmf)
        continue;
      is_wide ? expect_topology<std::int64_t>(file) : expect_topology<std::int32_t>(file);
      const std::string text = content(options.path(".xdmf")),
                        wanted = std::string("Dimensions=\"1900 3\" NumberType=\"Int\" Precision=\"") +
                                 (is_wide ? "8" : "4") + "\"";
      EXPECT_NE(text.find(wanted), std::string::npos) << text;
    }
}

std::int64_t completeness(const std::string& path) {
  const Hdf5File file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
  const Hdf5Attribute attribute(H5Aopen_by_name(file, "/trime_mpi", "complete", H5P_DEFAULT, H5P_DEFAULT), "complete");
  std::int64_t value = -1;
  H5Aread(attribute, H5T_NATIVE_INT64, &value);
  return value;
}

/// Replaces `copy` by a copy of the temporary file in the directory.
void copy_temporary(const std::string& directory, const std::string& copy) {
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    if (entry.path().filename().string().find(".tmp-") != std::string::npos)
      fs::copy_file(entry.path(), copy, fs::copy_options::overwrite_existing);
}

// The temporary file of a killed run must not look like a whole mesh. Arrays are compared after the file has been
// flushed, so rank 0 sees then what another program would see.
TEST(MeshFile, SaysThatItIsCompleteOnlyAfterItIsVerified) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  MeshFileOptions options = options_in(directory.path());
  for (const std::int64_t complete : {1, 0}) {
    options.overwrite = true;
    check_output(options, comm);
    const std::string copy = directory.path() + "/copy.h5";
    int fills = 0;
    const auto fill = [&](std::int64_t, std::int64_t, std::byte* out) {
      const std::int32_t value = 7;
      std::memcpy(out, &value, sizeof value);
      ++fills;
      if (comm.is_root())
        copy_temporary(options.directory, copy);
    };
    const ExtraGroup group{"/extra", {}, {{"row", ValueType::int32, 0, comm.size(), {{comm.rank(), 1, fill}}}}};
    write_mesh_and({{group}}, options, make_mesh(comm, 9), {{{"complete", complete}}, {}, {}}, comm);
    EXPECT_GE(fills, 2) << "written and verified";
    if (!comm.is_root())
      continue;
    EXPECT_EQ(completeness(copy), 0);
    EXPECT_EQ(completeness(options.path(".h5")), complete);
  }
}

TEST(MeshFile, RefusesToOverwriteAndTellsWhatWasLeft) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  MeshFileOptions options = options_in(directory.path());
  check_output(options, comm);
  if (comm.is_root()) {
    std::ofstream(options.path(".h5.tmp-1")) << "x";
    std::ofstream(options.path(".xdmf")) << "x";
  }
  comm.barrier();
  try {
    check_output(options, comm);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::file);
    EXPECT_NE(std::string(error.what()).find("output.overwrite = true"), std::string::npos);
  }
  options.overwrite = true;
  EXPECT_EQ(check_output(options, comm).size(), comm.is_root() ? 1u : 0u);
  options.directory = options.path(".xdmf"); // a file, not a directory
  EXPECT_THROW(check_output(options, comm), Error);
}

TEST(Shortened, KeepsShortTextsAndWholeCharacters) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc...");
  EXPECT_EQ(shortened("a\xC3\xA4\xC3\xA4 and more", 6), "a\xC3\xA4...");
  EXPECT_EQ(shortened("ab\xC3\xA4 and more", 6), "ab...");
  EXPECT_EQ(shortened("\xE2\x82\xAC\xE2\x82\xAC", 5), "...");
  EXPECT_EQ(shortened("", 3), "");
}

TEST(MeshFile, LongTextsAreShortenedAsAttributesAndWholeAsDatasets) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const MeshFileOptions options = options_in(directory.path());
  check_output(options, comm);
  const std::string fits(longest_attribute, 'f'), text(300000, 't');
  Metadata metadata;
  for (int k = 0; k < 4; ++k) // together more than 64 KiB
    metadata.attributes.push_back({"fits" + std::to_string(k), fits});
  metadata.attributes.push_back({"text", text});
  metadata.texts = {{"text", text}};
  metadata.groups = {{"group", {{"text", text}}, {}}};
  write_mesh(options, make_mesh(comm, 7), metadata, comm);
  if (!comm.is_root())
    return;
  const Hdf5File file(H5Fopen(options.path(".h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open");
  const Hdf5Group root(H5Gopen2(file, "/trime_mpi", H5P_DEFAULT), "trime_mpi");
  const Hdf5Group group(H5Gopen2(file, "/trime_mpi/group", H5P_DEFAULT), "group");
  EXPECT_EQ(read_text(root, "fits3"), fits);
  EXPECT_EQ(read_text(root, "text"), shortened(text, longest_attribute));
  EXPECT_EQ(read_text(group, "text"), shortened(text, longest_attribute));
  const Hdf5Dataset dataset(H5Dopen2(file, "/trime_mpi/text", H5P_DEFAULT), "text");
  const Hdf5Type type(H5Dget_type(dataset), "type");
  EXPECT_EQ(H5Tget_size(type), text.size());
}

TEST(MeshFile, AFailureLeavesNothingAndIsThrownByAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  MeshFileOptions options = options_in(directory.path());
  EXPECT_THROW(write_mesh(options, make_mesh(comm, 6), {}, comm), Error) << "the directory does not exist";
  check_output(options, comm);
  if (comm.is_root())
    fs::create_directory(options.path(".h5")); // in the way of the last rename
  comm.barrier();
  EXPECT_THROW(write_mesh(options, make_mesh(comm, 6), {}, comm), Error);
  comm.barrier();
  EXPECT_EQ(std::distance(fs::directory_iterator(options.directory), {}), 1);
}

} // namespace
} // namespace trime::io
