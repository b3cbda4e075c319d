// SPDX-License-Identifier: BSD-3-Clause
// The report and what the file says of the run: a mesh that failed is never told as if it were good.
#include "app/run_report.hpp"

#include "app/provenance.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

meshing::MeshResult good_result() {
  meshing::MeshResult result;
  result.mesh.point_slab.total = 1000;
  result.mesh.triangle_slab.total = 1900;
  result.mesh.hash = 0x1234;
  result.checks = {{"not_delaunay", 0, 0, true, "edges"}};
  result.stop_reason = sweep::StopReason::converged;
  return result;
}

/// Value of an attribute of the file.
std::int64_t number(const io::Metadata& metadata, const std::string& name) {
  for (const io::Attribute& attribute : metadata.attributes)
    if (attribute.name == name)
      return std::get<std::int64_t>(attribute.value);
  ADD_FAILURE() << "no attribute " << name;
  return -1;
}

template <class T>
std::vector<T> column(const io::Metadata& metadata, const std::string& group, const std::string& name) {
  for (const io::MetadataGroup& g : metadata.groups)
    for (const io::Column& c : g.columns)
      if (g.name == group && c.name == name)
        return std::get<std::vector<T>>(c.values);
  ADD_FAILURE() << "no column " << group << "/" << name;
  return {};
}

TEST(RunReport, TellsWhatWasCounted) {
  Measurements measured;
  measured.phases = {{"sweeps", 7, 1, 2, 3}};
  measured.total = 2;
  measured.counters[Counter::sites_swept] = {1200, 500, 700};
  measured.counters[Counter::messages] = {10, 5, 5};
  const std::string alone = run_report(good_result(), {}, measured, {});
  EXPECT_NE(alone.find("  sites_swept               1200\n"), std::string::npos) << alone;
  EXPECT_EQ(alone.find("Traffic"), std::string::npos) << alone;
  EXPECT_EQ(alone.find("patches  "), std::string::npos) << "nothing is said of what did not happen: " << alone;
  measured.ranks = 2;
  measured.phases[0].counters = measured.counters;
  const std::string together = run_report(good_result(), {}, measured, {});
  EXPECT_NE(together.find("  sites_swept               1200       500         600.0       700\n"), std::string::npos)
      << together;
  EXPECT_NE(together.find("Traffic"), std::string::npos) << together;
  EXPECT_NE(together.find("  sweeps                           5.0 "), std::string::npos) << together;
  EXPECT_NE(together.find("Limit: imbalance 1.17"), std::string::npos) << together;
}

TEST(RunReport, TheFileHasARowForEachCounterOfAPhase) {
  const CommandLine line;
  const RunOptions options;
  const std::string text;
  const Placement placement;
  const geometry::Boundary boundary;
  const Provenance provenance{line, options, text, placement, boundary, {}, {}, {}, true, {}};
  Measurements measured;
  measured.ranks = 2;
  measured.phases = {{"stars"}, {"sweeps"}};
  measured.phases[0].counters[Counter::ghosts] = {10, 4, 6};
  measured.phases[1].counters[Counter::ghosts] = {7, 3, 4};
  measured.phases[1].counters[Counter::messages] = {20, 10, 10};
  measured.counters[Counter::ghosts] = {10, 4, 6};
  const io::Metadata metadata = describe_run(provenance, good_result(), {}, measured);
  using Names = std::vector<std::string>;
  using Numbers = std::vector<std::int64_t>;
  EXPECT_EQ(column<std::string>(metadata, "counters", "phase"), (Names{"stars", "sweeps", "sweeps", "run"}));
  EXPECT_EQ(column<std::string>(metadata, "counters", "name"), (Names{"ghosts", "messages", "ghosts", "ghosts"}));
  EXPECT_EQ(column<std::string>(metadata, "counters", "unit"), (Names{"sites", "messages", "sites", "sites"}));
  EXPECT_EQ(column<std::int64_t>(metadata, "counters", "sum"), (Numbers{10, 20, 7, 10}));
  EXPECT_EQ(column<std::int64_t>(metadata, "counters", "min"), (Numbers{4, 10, 3, 4}));
  EXPECT_EQ(column<double>(metadata, "counters", "mean"), (std::vector<double>{5, 10, 3.5, 5}));
  EXPECT_EQ(column<std::int64_t>(metadata, "counters", "max"), (Numbers{6, 10, 4, 6}));
  EXPECT_EQ(column<std::int64_t>(metadata, "timers", "messages"), (Numbers{0, 20}));
}

TEST(RunReport, MarksWhatIsNotComplete) {
  meshing::MeshResult result = good_result();
  EXPECT_TRUE(is_complete(result));
  const std::string good = run_report(result, {}, {}, {});
  EXPECT_NE(good.find("0000000000001234"), std::string::npos);
  EXPECT_EQ(good.find("FAILED"), std::string::npos);
  EXPECT_EQ(good.find("FAILED"), std::string::npos);
  result.checks[0] = {"not_delaunay", 0, 3, false, "edges"};
  EXPECT_FALSE(is_complete(result));
  EXPECT_NE(run_report(result, {}, {}, {}).find("FAILED not_delaunay"), std::string::npos);
  EXPECT_NE(incompleteness(result, true).find("failed checks: not_delaunay"), std::string::npos);
  EXPECT_EQ(incompleteness(result, false).find("in the file"), std::string::npos);
  result = good_result();
  result.stop_reason = sweep::StopReason::sweep_cap;
  EXPECT_FALSE(is_complete(result));
  EXPECT_NE(incompleteness(result, true).find("sweep cap"), std::string::npos);
}

TEST(RunReport, AFailedCheckMarksTheFile) {
  const CommandLine line;
  const RunOptions options;
  const std::string text;
  const Placement placement;
  const geometry::Boundary boundary;
  const Provenance provenance{line, options, text, placement, boundary, {}, {}, {}, true, {}};
  meshing::MeshResult result = good_result();
  EXPECT_EQ(number(describe_run(provenance, result, {}, {}), "complete"), 1);
  result.checks.push_back({"vertex_distance", 1e-9, 1e-7, false, "boundary vertices"});
  const io::Metadata metadata = describe_run(provenance, result, {}, {});
  EXPECT_EQ(number(metadata, "complete"), 0);
  EXPECT_EQ(column<std::int32_t>(metadata, "checks", "passed"), (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(column<double>(metadata, "checks", "found").back(), 1e-7);
  EXPECT_EQ(exit_code(result), ExitCode::incomplete);
  EXPECT_EQ(exit_code(good_result()), ExitCode::done);
}

TEST(RunReport, TheTableOfTagsNamesLoopsAndParts) {
  const CommandLine line;
  const RunOptions options;
  const std::string text;
  const Placement placement;
  geometry::Boundary boundary;
  boundary.part_names = {"square", "unused", "disc"};
  const Provenance provenance{line, options, text, placement, boundary, {}, {}, {}, true, {boundary.part_names}};
  meshing::MeshResult result = good_result();
  using Kind = polygon::LoopSummary::Kind;
  result.loops = {{1, Kind::outer, 40, 3.25, {0, 2}}, {2, Kind::hole, 7, 0.5, {2}}, {3, Kind::band, 9, 1, {0}}};
  const io::Metadata metadata = describe_run(provenance, result, {}, {});
  using Names = std::vector<std::string>;
  EXPECT_EQ(column<std::int32_t>(metadata, "tags", "edge_id"), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(column<std::string>(metadata, "tags", "edge_name"), (Names{"square+disc", "disc", "square"}));
  EXPECT_EQ(column<std::string>(metadata, "tags", "edge_kind"), (Names{"outer", "hole", "band"}));
  EXPECT_EQ(column<std::int64_t>(metadata, "tags", "edge_count"), (std::vector<std::int64_t>{40, 7, 9}));
  EXPECT_EQ(column<double>(metadata, "tags", "edge_length_sum"), (std::vector<double>{3.25, 0.5, 1}));
  EXPECT_EQ(column<std::int32_t>(metadata, "tags", "part_id"), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(column<std::string>(metadata, "tags", "part_name"), boundary.part_names);
}

TEST(RunReport, SaysHowManyPointsWereAskedForAndWhatTheSizesAre) {
  meshing::MeshResult result = good_result();
  result.requested_points = 1000;
  EXPECT_EQ(run_report(result, {}, {}, {}).find("asked for"), std::string::npos);
  result.requested_points = 2000;
  result.count_reason = "the sizes have bounds";
  const std::string text = run_report(result, {"automatic", 0.5, 0.75}, {}, {});
  EXPECT_NE(text.find("2000 asked for, 1000 made (50.00 %): the sizes have bounds\n"), std::string::npos) << text;
  EXPECT_NE(text.find("Size: automatic; target edge length from 0.5 to 0.75\n"), std::string::npos) << text;
  EXPECT_NE(run_report(result, {"uniform", 0.5, 0.5}, {}, {}).find("target edge length 0.5\n"), std::string::npos);
}

TEST(RunReport, ColumnsStandWhenNumbersAreLarge) {
  meshing::MeshResult result = good_result();
  result.checks = {{"euler_characteristic", 1, 1, true, "of the shape"},
                   {"area", 123456789012.25, 123456789012.25, true, "triangles fill the boundary polygon"},
                   {"written_triangles", 123456789012345, 123456789012345, true, "the triangles"}};
  result.quality.alpha = {1.0004, 35.63824, 41917.2643, 1.2969, 2e9};
  const std::string text = run_report(result, {}, {}, {});
  const auto column_of = [&](const std::string& line, const std::string& word) {
    const std::size_t start = text.find(line);
    return text.find(word, start) - text.rfind('\n', start);
  };
  EXPECT_EQ(column_of("ok     euler", "found"), column_of("ok     area", "found")) << text;
  EXPECT_EQ(column_of("ok     euler", "of the shape"), column_of("ok     written", "the triangles")) << text;
  EXPECT_NE(text.find("   35.6382 4.192e+04 "), std::string::npos) << text;
  EXPECT_EQ(column_of("  alpha  ", "2.000e+09") + 9, column_of("  beta  ", "0.0000\n") + 6) << text;
}

TEST(RunReport, TellsTheTransformOfANormalizedContour) {
  const std::vector<NormalizedPart> parts{{"sea", "coast.xy", 0.25, {-3, 1.5}}};
  EXPECT_NE(
      run_report(good_result(), {}, {}, {}, parts)
          .find("part 'sea', coordinates of coast.xy are (x - -3)/s and (y - 1.5)/s of those of the mesh, s = 0.25"),
      std::string::npos);
}

TEST(RunReport, TheSmallestAndLargestSizeAreThoseOfAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  mesh::DistributedMesh mesh;
  if (comm.rank() == comm.size() - 1)
    mesh.size = {0.5F, 0.25F, 2.0F};
  const SizeSummary summary = summarize_size("uniform", mesh, comm);
  EXPECT_EQ(summary.smallest, 0.25);
  EXPECT_EQ(summary.largest, 2);
}

TEST(Placement, SharesCoresAndObeysWishes) {
  const comm::Communicator comm = comm::Communicator::world();
  const Placement asked = place_threads(2, 1, comm);
  EXPECT_EQ(asked.threads, 1);
  EXPECT_EQ(asked.setup_threads, 2);
  EXPECT_EQ(asked.ranks, comm.size());
  EXPECT_EQ(asked.nodes, 1);
  EXPECT_GE(asked.cores, 1);
  EXPECT_LE(asked.sharing, comm.size());
  const Placement chosen = place_threads(0, 0, comm);
  EXPECT_GE(chosen.threads, 1);
  EXPECT_EQ(chosen.setup_threads, chosen.threads);
}

} // namespace
} // namespace trime::app
