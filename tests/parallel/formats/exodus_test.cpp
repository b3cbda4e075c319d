// SPDX-License-Identifier: BSD-3-Clause
// Exodus II in both netCDF formats: blocks, maps, side sets and node sets, compared with the mesh.
#include "formats/exodus.hpp"

#include "support/mesh_slabs.hpp"
#include "support/netcdf_reading.hpp"
#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace trime::formats {
namespace {

using Ends = std::array<GlobalId, 2>;

Names names_of_square() {
  Names names{{"hole", "rim"}, test::three_regions().names};
  names.regions.push_back("a region without triangles, whose name has more than 32 characters");
  names.curves = {"fault", "a wall with a name of more than 32 characters", "a curve without edges"};
  for (std::size_t pair = 0; pair < 3; ++pair)
    names.interfaces.push_back(test::three_regions().pair_name(pair));
  return names;
}

/// The names of a table, without the zeros behind them.
std::vector<std::string> texts_of(const test::NetcdfVariable& table) {
  std::vector<std::string> texts;
  for (std::int64_t row = 0; row < table.shape.at(0); ++row)
    texts.emplace_back(table.text.substr(static_cast<std::size_t>(row * table.shape.at(1))).c_str());
  return texts;
}

/// The directed edges of each label, as the mesh has them.
std::map<std::int64_t, std::multiset<Ends>> edges_by_label(const mesh::DistributedMesh& mesh) {
  std::map<std::int64_t, std::multiset<Ends>> edges;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    edges[1 + mesh.facet_parts[k]].insert(mesh.facets[k]);
  for (std::size_t k = 0; k < mesh.curve_edges.size(); ++k)
    edges[3 + mesh.curve_numbers[k]].insert(mesh.curve_edges[k]);
  for (std::size_t k = 0; k < mesh.interfaces.size(); ++k)
    if (mesh.interface_curves[k] < 0)
      edges[6 + mesh.interface_pairs[k]].insert(mesh.interfaces[k]);
  return edges;
}

/// The elements of all blocks, and their places in the mesh.
struct Elements {
  std::vector<std::array<GlobalId, 3>> corners;
  std::vector<GlobalId> triangles;
};

Elements elements_of(const test::NetcdfReader& file, const mesh::DistributedMesh& mesh) {
  Elements elements;
  const std::vector<double>& ids = file.variables.at("eb_prop1").numbers;
  EXPECT_EQ(ids, (std::vector<double>{1, 2, 3}));
  const std::vector<double>& map = file.variables.at("elem_num_map").numbers;
  for (std::size_t block = 0; block < ids.size(); ++block) {
    const test::NetcdfVariable& connect = file.variables.at("connect" + std::to_string(block + 1));
    EXPECT_EQ(connect.texts.at("elem_type"), "TRI3");
    EXPECT_EQ(connect.shape.at(1), 3);
    for (std::size_t k = 0; k < connect.numbers.size(); k += 3) {
      const auto triangle = static_cast<std::size_t>(map.at(elements.corners.size())) - 1;
      std::array<GlobalId, 3> corners{};
      for (std::size_t corner = 0; corner < 3; ++corner)
        corners[corner] = static_cast<GlobalId>(connect.numbers[k + corner]) - 1;
      EXPECT_EQ(corners, mesh.triangle_ids(triangle));
      EXPECT_EQ(mesh.region[triangle], ids[block]);
      EXPECT_TRUE(k == 0 || static_cast<GlobalId>(triangle) > elements.triangles.back());
      elements.corners.push_back(corners);
      elements.triangles.push_back(static_cast<GlobalId>(triangle));
    }
  }
  EXPECT_EQ(elements.corners.size(), mesh.triangles.size());
  return elements;
}

void check_sets(const test::NetcdfReader& file, const mesh::DistributedMesh& mesh) {
  const Elements elements = elements_of(file, mesh);
  std::map<std::int64_t, std::multiset<Ends>> found;
  const std::vector<double>& labels = file.variables.at("ss_prop1").numbers;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const std::vector<double>& element = file.variables.at("elem_ss" + std::to_string(k + 1)).numbers;
    const std::vector<double>& side = file.variables.at("side_ss" + std::to_string(k + 1)).numbers;
    std::set<GlobalId> ends;
    for (std::size_t row = 0; row < element.size(); ++row) {
      const std::array<GlobalId, 3>& corners = elements.corners.at(static_cast<std::size_t>(element[row]) - 1);
      const auto first = static_cast<std::size_t>(side.at(row)) - 1;
      found[static_cast<std::int64_t>(labels[k])].insert({corners.at(first), corners.at((first + 1) % 3)});
      ends.insert({corners.at(first), corners.at((first + 1) % 3)});
    }
    std::vector<double> points;
    for (const GlobalId end : ends)
      points.push_back(static_cast<double>(end + 1));
    EXPECT_EQ(file.variables.at("node_ns" + std::to_string(k + 1)).numbers, points);
  }
  EXPECT_EQ(found, edges_by_label(mesh));
}

void check_file(const std::string& bytes, const mesh::DistributedMesh& mesh, bool is_wide) {
  const test::NetcdfReader file(bytes);
  EXPECT_EQ(file.variables.at("connect1").type, is_wide ? 10 : 4);
  EXPECT_EQ(file.variables.at("side_ss1").type, is_wide ? 10 : 4);
  EXPECT_EQ(file.attributes.at("int64_status"), is_wide ? 0x1400 : 0);
  EXPECT_EQ(file.attributes.at("floating_point_word_size"), 8);
  for (const char* name : {"num_dim", "num_nodes", "num_elem", "num_el_blk", "num_side_sets", "len_line", "four"})
    EXPECT_GT(file.dimensions.at(name), 0) << name;
  EXPECT_EQ(texts_of(file.variables.at("eb_names")), test::three_regions().names);
  EXPECT_EQ(texts_of(file.variables.at("ss_names")), texts_of(file.variables.at("ns_names")));
  EXPECT_EQ(texts_of(file.variables.at("ss_names"))[3], "a wall with a name of more than 32 characters");
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    EXPECT_EQ(file.variables.at("coordx").numbers.at(k), mesh.points[k].x);
    EXPECT_EQ(file.variables.at("coordy").numbers.at(k), mesh.points[k].y);
  }
  check_sets(file, mesh);
}

TEST(Exodus, BothNetcdfFormatsHoldTheMesh) {
  const comm::Communicator comm = comm::Communicator::world();
  const mesh::DistributedMesh whole = test::divided_square(11);
  const Names names = names_of_square();
  for (const NetcdfFormat format : {NetcdfFormat::offset_64, NetcdfFormat::data_64})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const test::TemporaryDirectory directory(comm);
      const mesh::DistributedMesh part = test::slabs_of(whole, comm, seed);
      const ExchangeMesh mesh(part, names, comm);
      const FilePlan plan = exodus_file(mesh, directory.path() + "/a.exo", format);
      io::write_text_rows(plan.path, plan.rows, nullptr, comm);
      if (!comm.is_root())
        continue;
      std::stringstream bytes;
      bytes << std::ifstream(plan.path, std::ios::binary).rdbuf();
      check_file(bytes.str(), whole, format == NetcdfFormat::data_64);
    }
}

TEST(Exodus, LargeMeshesNeedTheFormatWithoutLimits) {
  EXPECT_EQ(exodus_format(500'000'000, 350'000'000), NetcdfFormat::offset_64);
  EXPECT_EQ(exodus_format(180'000'000, 360'000'000), NetcdfFormat::data_64);
  EXPECT_EQ(exodus_format(540'000'000, 350'000'000), NetcdfFormat::data_64);
}

TEST(Exodus, AnEdgeWithoutATriangleIsAnErrorOnAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  mesh::DistributedMesh whole = test::divided_square(5);
  std::swap(whole.facets[3][0], whole.facets[3][1]); // now the mesh lies on its right
  const Names names = names_of_square();
  const mesh::DistributedMesh part = test::slabs_of(whole, comm, 3);
  const ExchangeMesh mesh(part, names, comm);
  EXPECT_THROW(exodus_file(mesh, "a.exo", NetcdfFormat::offset_64), FileError);
}

} // namespace
} // namespace trime::formats
