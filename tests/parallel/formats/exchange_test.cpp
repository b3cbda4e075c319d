// SPDX-License-Identifier: BSD-3-Clause
// Files for other programs of a mesh with regions, curves and interfaces: the same bytes for any distribution over
// ranks, and the labels that the names promise.
#include "trime/formats/exchange.hpp"

#include "formats/exchange_mesh.hpp"
#include "support/mesh_slabs.hpp"
#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace trime::formats {
namespace {

Names names_of_square() {
  const geometry::Regions regions = test::three_regions();
  Names names{{"hole", "rim"}, regions.names};
  names.curves = {"fault", "wall"};
  for (std::size_t pair = 0; pair < regions.pairs.size(); ++pair)
    names.interfaces.push_back(regions.pair_name(pair));
  return names;
}

std::string content(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The rows of a section of a Medit file: numbers behind a word and their count.
std::vector<std::vector<std::int64_t>> medit_rows(const std::string& text, const std::string& word, int columns) {
  std::istringstream stream(text.substr(text.find("\n" + word + "\n") + word.size() + 2));
  std::size_t count = 0;
  stream >> count;
  std::vector<std::vector<std::int64_t>> rows(count);
  for (std::vector<std::int64_t>& row : rows)
    for (int k = 0; k < columns; ++k) {
      std::int64_t value = 0;
      stream >> value;
      row.push_back(value);
    }
  return rows;
}

TEST(Exchange, FilesDoNotDependOnTheDistribution) {
  const comm::Communicator comm = comm::Communicator::world();
  Names names = names_of_square();
  names.open_boundary = names.parts; // so that lists of open boundaries have rows
  const mesh::DistributedMesh whole = test::divided_square(11);
  for (const FormatInfo& info : all_formats()) {
    if (!info.plan)
      continue;
    SCOPED_TRACE(info.word);
    const test::TemporaryDirectory directory(comm);
    const std::string one = directory.path() + "/a" + info.ending, all = directory.path() + "/b" + info.ending;
    if (comm.is_root())
      write(info.format, one, whole, names, nullptr, comm::Communicator::self());
    for (const std::uint64_t seed : {1, 2, 3}) {
      write(info.format, all, test::slabs_of(whole, comm, seed), names, nullptr, comm);
      comm.barrier();
      for (std::size_t k = 0; comm.is_root() && k < paths_of(info.format, one, names).size(); ++k) {
        const std::string expected = content(paths_of(info.format, one, names)[k]);
        EXPECT_GT(expected.size(), 100u);
        if (info.format != Format::adcirc && info.format != Format::schism) { // the title is the path
          EXPECT_EQ(content(paths_of(info.format, all, names)[k]), expected);
        }
      }
      comm.barrier();
    }
  }
}

TEST(Exchange, EachLabelledEdgeIsListedOnceWithItsLabel) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const mesh::DistributedMesh whole = test::divided_square(11);
  const std::string path = directory.path() + "/a.mesh";
  write(Format::medit, path, test::slabs_of(whole, comm, 4), names_of_square(), nullptr, comm);
  if (!comm.is_root())
    return;
  const std::string text = content(path);
  for (const char* line : {"# edges 1: hole\n", "# edges 3: fault\n", "# edges 5: rest|rock\n",
                           "# edges 7: rock|soil\n", "# triangles 1: rest\n", "# triangles 3: soil\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
  std::map<std::vector<std::int64_t>, std::int64_t> expected; // label by ends
  const auto add = [&](const std::array<GlobalId, 2>& ends, std::int64_t label) {
    EXPECT_TRUE((expected.insert({{ends[0] + 1, ends[1] + 1}, label}).second));
  };
  for (std::size_t k = 0; k < whole.facets.size(); ++k)
    add(whole.facets[k], 1 + whole.facet_parts[k]);
  for (std::size_t k = 0; k < whole.curve_edges.size(); ++k)
    add(whole.curve_edges[k], 3 + whole.curve_numbers[k]);
  for (std::size_t k = 0; k < whole.interfaces.size(); ++k)
    if (whole.interface_curves[k] < 0)
      add(whole.interfaces[k], 5 + whole.interface_pairs[k]);
  std::map<std::vector<std::int64_t>, std::int64_t> found;
  for (const std::vector<std::int64_t>& row : medit_rows(text, "Edges", 3))
    EXPECT_TRUE((found.insert({{row[0], row[1]}, row[2]}).second));
  EXPECT_EQ(found, expected);
  const auto triangles = medit_rows(text, "Triangles", 4);
  ASSERT_EQ(triangles.size(), whole.region.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    EXPECT_EQ(triangles[t][3], whole.region[t]);
}

TEST(Exchange, RegionsWithoutTrianglesAreNoGroupsOfGmsh) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  mesh::DistributedMesh whole = test::divided_square(5);
  for (std::int32_t& region : whole.region)
    region = std::max(region, 2); // the rest is covered
  const std::string path = directory.path() + "/a.msh";
  write(Format::gmsh, path, test::slabs_of(whole, comm, 2), names_of_square(), nullptr, comm);
  if (!comm.is_root())
    return;
  const std::string text = content(path);
  EXPECT_EQ(text.find("2 1 \"rest\""), std::string::npos);
  EXPECT_NE(text.find("2 2 \"rock\"\n2 3 \"soil\"\n$EndPhysicalNames"), std::string::npos);
}

TEST(Exchange, AnInterfaceWithoutANameIsAnErrorOnAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  Names names = names_of_square();
  names.interfaces.pop_back();
  const mesh::DistributedMesh part = test::slabs_of(test::divided_square(11), comm, 3);
  EXPECT_THROW(write(Format::medit, directory.path() + "/a.mesh", part, names, nullptr, comm), FileError);
}

} // namespace
} // namespace trime::formats
