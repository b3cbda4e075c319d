// SPDX-License-Identifier: BSD-3-Clause
// The files of a whole run: text files with the same bytes for any distribution over ranks, steps, collections, and
// what happens to the files of an older run.
#include "formats/mesh_series.hpp"

#include "io/text_rows.hpp"
#include "support/mesh_slabs.hpp"
#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace trime::formats {
namespace {

namespace fs = std::filesystem;

constexpr int cells = 9;

/// Name and content of every regular file below a directory, on rank 0.
std::map<std::string, std::string> texts_in(const std::string& directory) {
  std::map<std::string, std::string> texts;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) {
      std::stringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      texts[entry.path().filename().string()] = text.str();
    }
  return texts;
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

SeriesOptions options_in(const std::string& directory) {
  SeriesOptions options;
  options.file.directory = directory;
  options.file.name = "mesh";
  options.steps = true;
  options.formats = {Format::vtkhdf, Format::xdmf, Format::text};
  return options;
}

TEST(TextRows, ComeInOrderOverManySlices) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  constexpr std::int64_t total = 700000; // more than one slice for any number of ranks
  std::int64_t rows = 0;
  const mesh::Slab slab = test::share(comm, total, 3, rows);
  const io::TextRows array{rows, [&](std::int64_t row, std::string& text) {
                             io::append_number(text, slab.first + row);
                             text += '\n';
                           }};
  io::write_text_rows(directory.path() + "/rows.txt", {&array, 1}, nullptr, comm);
  if (!comm.is_root())
    return;
  std::string expected;
  for (std::int64_t row = 0; row < total; ++row)
    expected += std::to_string(row) + "\n";
  EXPECT_TRUE(texts_in(directory.path())["rows.txt"] == expected);
}

TEST(TextRows, OfShortAndLongArraysStandInTheOrderOfTheArrays) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  std::vector<io::TextRows> arrays;
  std::string expected;
  for (std::int64_t number = 0; number < 300; ++number) {
    const std::int64_t total = number % 100 == 42 ? 200000 : number % 7 == 3 ? 0 : number * 13 % 997;
    std::int64_t rows = 0;
    const mesh::Slab slab = test::share(comm, total, static_cast<std::uint64_t>(number), rows);
    const auto append = [number](std::int64_t row, std::string& text) {
      if (row % 5 == 2) // a row without a line
        return;
      io::append_number(text, number);
      text += ' ';
      io::append_number(text, row);
      text += '\n';
    };
    arrays.push_back(
        {rows, [first = slab.first, append](std::int64_t row, std::string& text) { append(first + row, text); }});
    for (std::int64_t row = 0; row < total; ++row)
      append(row, expected);
  }
  io::write_text_rows(directory.path() + "/rows.txt", arrays, nullptr, comm);
  io::write_text_rows(directory.path() + "/empty.txt", {}, nullptr, comm);
  if (!comm.is_root())
    return;
  EXPECT_TRUE(texts_in(directory.path())["rows.txt"] == expected);
  EXPECT_EQ(texts_in(directory.path())["empty.txt"], "");
}

TEST(TextMesh, HasTheSameBytesOnAnyDistribution) {
  const comm::Communicator comm = comm::Communicator::world(), self = comm::Communicator::self();
  const mesh::DistributedMesh whole = test::holed_square(cells);
  const test::TemporaryDirectory directory(comm);
  std::map<std::string, std::string> expected;
  if (comm.is_root()) {
    fs::create_directories(directory.path() + "/whole");
    write_text_mesh({directory.path() + "/whole", "mesh", "final", {}}, whole, self);
    expected = texts_in(directory.path() + "/whole");
    EXPECT_EQ(expected.size(), 13u);
  }
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::string folder = directory.path() + "/" + std::to_string(seed);
    if (comm.is_root())
      fs::create_directories(folder);
    comm.barrier();
    write_text_mesh({folder, "mesh", "final", {}}, test::slabs_of(whole, comm, seed), comm);
    if (comm.is_root()) {
      EXPECT_EQ(texts_in(folder), expected) << "seed " << seed;
    }
  }
}

TEST(TextMesh, TellsTheWholeMesh) {
  const comm::Communicator comm = comm::Communicator::world();
  const mesh::DistributedMesh whole = test::holed_square(cells);
  const test::TemporaryDirectory directory(comm);
  write_text_mesh({directory.path(), "mesh", "12", {}}, test::slabs_of(whole, comm, 5), comm);
  if (!comm.is_root())
    return;
  auto texts = texts_in(directory.path());
  const std::size_t points = whole.points.size(), triangles = whole.triangles.size();
  const std::size_t edges = points + triangles; // a disc with one hole: V - E + F = 0
  EXPECT_EQ(lines(texts["mesh_12_xy_id.txt"]), points);
  EXPECT_EQ(lines(texts["mesh_12_tria_vertex_ids.txt"]), triangles);
  EXPECT_EQ(lines(texts["mesh_12_tria_bar_ids.txt"]), edges);
  EXPECT_EQ(lines(texts["mesh_12_tria_bar_coords.txt"]), 3 * edges);
  EXPECT_EQ(lines(texts["fixed_pt_id.txt"]), 4u);
  EXPECT_EQ(lines(texts["mesh_12_bdry_vertices_ids_CCW_0.txt"]), 4u * cells);
  EXPECT_EQ(texts["mesh_12_bdry_vertices_ids_CCW_1.txt"], "44 \n45 \n55 \n54 \n");
  EXPECT_EQ(texts["mesh_12_tria_vertex_ids.txt"].substr(0, 22), "0 0 1 11 \n1 0 11 10 \n2");
  std::istringstream ids(texts["mesh_12_tria_bar_ids.txt"]), places(texts["mesh_12_tria_bar_coords.txt"]);
  std::map<std::pair<GlobalId, GlobalId>, int> seen;
  for (GlobalId i, j; ids >> i >> j;) {
    geometry::Vec2 p, q;
    places >> p.x >> p.y >> q.x >> q.y;
    EXPECT_LT(i, j);
    EXPECT_EQ((++seen[{i, j}]), 1);
    EXPECT_EQ(p, whole.points[static_cast<std::size_t>(i)]);
    EXPECT_EQ(q, whole.points[static_cast<std::size_t>(j)]);
  }
  EXPECT_EQ(seen.size(), edges);
  std::istringstream ratios(texts["mesh_12_tria_quality_stat_ar.txt"]),
      corners(texts["mesh_12_tria_vertex_coords.txt"]);
  for (std::size_t t = 0; t < triangles; ++t) {
    std::size_t number = 0;
    double alpha = 0;
    geometry::Vec2 p, q, r;
    corners >> number >> p.x >> p.y >> q.x >> q.y >> r.x >> r.y;
    ratios >> alpha;
    EXPECT_EQ(number, t);
    EXPECT_EQ(alpha, mesh::aspect_ratio(p, q, r));
  }
}

TEST(TextMesh, WritesTrianglesAcrossAPeriodicBorderWhole) {
  const comm::Communicator comm = comm::Communicator::self();
  const test::TemporaryDirectory directory;
  mesh::DistributedMesh mesh;
  mesh.points = {{0.9, 0.1}, {0.1, 0.1}, {0.1, 0.9}};
  mesh.boundary.assign(3, 0);
  mesh.size.assign(3, 0.2F);
  mesh.fixed.assign(3, 0);
  mesh.triangles = {{0, 1, 2}};
  mesh.point_slab.total = 3;
  mesh.triangle_slab.total = 1;
  write_text_mesh({directory.path(), "m", "final", {1, 1}}, mesh, comm);
  std::istringstream corners(texts_in(directory.path())["m_final_tria_vertex_coords.txt"]);
  double t = 0, x[6] = {};
  corners >> t >> x[0] >> x[1] >> x[2] >> x[3] >> x[4] >> x[5];
  EXPECT_DOUBLE_EQ(x[2], 1.1);
  EXPECT_DOUBLE_EQ(x[4], 1.1);
  EXPECT_NEAR(x[5], -0.1, 1e-15);
}

TEST(MeshSeries, WritesStepsFinalMeshAndCollections) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  MeshSeries series(options_in(directory.path()), comm);
  EXPECT_TRUE(series.check(1000).empty());
  const mesh::DistributedMesh small = test::slabs_of(test::holed_square(3), comm, 1),
                              large = test::slabs_of(test::holed_square(cells), comm, 2);
  const mesh::QualitySummary quality;
  const io::Metadata metadata;
  series.write_step({1, small, quality, metadata});
  series.write_step({12, large, quality, metadata});
  const io::WrittenFiles written = series.write_final({17, large, quality, metadata});
  if (!comm.is_root())
    return;
  const std::string stem = directory.path() + "/mesh";
  EXPECT_EQ(written.paths, (std::vector<std::string>{stem + ".h5", stem + ".xdmf", stem + ".xmf", stem + ".vtkhdf",
                                                     stem + "_step_*.h5 (2 of them)", stem + "/mesh_*.txt",
                                                     stem + "_series.xdmf", stem + ".vtkhdf.series"}));
  auto texts = texts_in(directory.path());
  for (const char* name :
       {"mesh_step_000001.h5", "mesh_step_000012.h5", "mesh.h5", "mesh_step_000012.xdmf", "mesh_series.xdmf",
        "mesh.vtkhdf.series", "mesh_1_xy_id.txt", "mesh_12_xy_id.txt", "mesh_final_xy_id.txt", "fixed_pt_id.txt"})
    EXPECT_TRUE(texts.contains(name)) << name;
  EXPECT_EQ(lines(texts["mesh_tria_quality_stat_overall.txt"]), 3u);
  EXPECT_NE(texts["mesh.vtkhdf.series"].find("\"name\": \"mesh_step_000012.vtkhdf\",\n      \"time\": 12\n    },"),
            std::string::npos);
  EXPECT_NE(texts["mesh.vtkhdf.series"].find("\"name\": \"mesh.vtkhdf\",\n      \"time\": 17\n    }\n  ]\n}\n"),
            std::string::npos);
  const std::string& xdmf = texts["mesh_series.xdmf"];
  EXPECT_NE(xdmf.find("CollectionType=\"Temporal\""), std::string::npos);
  EXPECT_NE(xdmf.find("<Time Value=\"12\"/>"), std::string::npos);
  EXPECT_NE(xdmf.find("mesh_step_000001.h5:/Mesh/mesh/topology"), std::string::npos);
  for (const auto& [name, text] : texts)
    EXPECT_EQ(name.find(".tmp-"), std::string::npos) << name;
}

void touch(const std::string& path) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path) << "x";
}

TEST(MeshSeries, RefusesWhatLiesInTheWay) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const char* file : {"mesh_step_000005.h5", "mesh_step_000005.vtkhdf", "mesh_series.xdmf", "mesh.vtkhdf.series",
                           "mesh/mesh_3_xy_id.txt", "mesh/fixed_pt_id.txt", "mesh.h5"}) {
    const test::TemporaryDirectory directory(comm);
    if (comm.is_root())
      touch(directory.path() + "/" + file);
    comm.barrier();
    SeriesOptions options = options_in(directory.path());
    EXPECT_THROW(MeshSeries(options, comm).check(1000), Error) << file;
    EXPECT_THROW(MeshSeries(options, comm).look(1000), Error) << file;
    options.file.overwrite = true;
    EXPECT_NO_THROW(MeshSeries(options, comm).check(1000)) << file;
  }
}

TEST(MeshSeries, WarnsOfADiskThatIsTooSmall) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const std::vector<std::string> warnings = MeshSeries(options_in(directory.path()), comm).check(1e15);
  ASSERT_EQ(warnings.size(), comm.is_root() ? 1u : 0u);
  if (comm.is_root()) {
    EXPECT_NE(warnings[0].find("need at least"), std::string::npos) << warnings[0];
  }
}

TEST(MeshSeries, LeavesNoTextFilesOfAMeshThatLacksOne) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const char* late : {"mesh_final_tria_bar_ids.txt", "mesh_final_bdry_vertices_coords_CCW_1.txt"}) {
    const test::TemporaryDirectory directory(comm);
    MeshSeries series(options_in(directory.path()), comm);
    series.check(1000);
    series.write_step({1, test::slabs_of(test::holed_square(cells), comm, 1), {}, {}});
    if (comm.is_root())
      fs::create_directories(directory.path() + "/mesh/" + late); // no file can take this name
    comm.barrier();
    EXPECT_THROW(series.write_final({17, test::slabs_of(test::holed_square(cells), comm, 1), {}, {}}), FileError);
    if (comm.is_root()) {
      EXPECT_TRUE(fs::exists(directory.path() + "/mesh.h5"));
      for (const auto& [name, text] : texts_in(directory.path() + "/mesh"))
        EXPECT_FALSE(name.starts_with("mesh_final_")) << name << " stays";
      EXPECT_TRUE(fs::exists(directory.path() + "/mesh/mesh_1_xy_id.txt")) << "an earlier mesh is whole";
      EXPECT_TRUE(fs::exists(directory.path() + "/mesh/fixed_pt_id.txt")) << "and has its fixed points";
    }
  }
}

TEST(MeshSeries, ReplacesAllOfAnOlderRunAndNothingElse) {
  const comm::Communicator comm = comm::Communicator::world();
  const test::TemporaryDirectory directory(comm);
  const std::vector<std::string> stale{"/mesh_step_000005.h5", "/mesh_series.xdmf", "/mesh.vtkhdf.series",
                                       "/mesh/mesh_3_xy_id.txt", "/mesh/mesh_final_bdry_vertices_ids_CCW_7.txt"};
  const std::vector<std::string> others{"/mesh_step_two.h5", "/mesh2_step_000001.h5", "/mesh/notes.txt"};
  if (comm.is_root())
    for (const auto* files : {&stale, &others})
      for (const std::string& file : *files)
        touch(directory.path() + file);
  comm.barrier();
  SeriesOptions options = options_in(directory.path());
  options.file.overwrite = true;
  options.steps = false;
  options.formats = {Format::vtkhdf, Format::xdmf};
  MeshSeries series(options, comm);
  EXPECT_TRUE(series.check(1000).empty());
  for (const std::string& file : stale)
    EXPECT_TRUE(fs::exists(directory.path() + file)) << file << " may go only when a new mesh is there";
  comm.barrier();
  series.write_final({17, test::slabs_of(test::holed_square(3), comm, 1), {}, {}});
  if (!comm.is_root())
    return;
  EXPECT_TRUE(fs::exists(directory.path() + "/mesh.h5"));
  for (const std::string& file : stale)
    EXPECT_FALSE(fs::exists(directory.path() + file)) << file;
  for (const std::string& file : others)
    EXPECT_TRUE(fs::exists(directory.path() + file)) << file;
}

} // namespace
} // namespace trime::formats
