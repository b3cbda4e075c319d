// SPDX-License-Identifier: BSD-3-Clause
// The library in one header: meshes of programs that have MPI running, on all ranks, on some of them, and on one.
#include "support/mesh_slabs.hpp"
#include "support/temporary_directory.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/record/describe.hpp"
#include "trime/trime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

namespace trime {
namespace {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

Shape plate() {
  return rectangle("plate", {0, 0}, {2, 1}) - circle("hole", {1, .5}, .2);
}

/// The message of an error of this class; empty if there was none. All ranks must come here together.
template <class Expected, class Work>
std::string error_of(const Work& work) {
  std::string message;
  try {
    work();
  } catch (const Expected& error) {
    message = error.what();
  }
  MPI_Barrier(MPI_COMM_WORLD); // nobody is left behind in a collective
  return message;
}

void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << "expected '" << part << "' in: " << text;
}

TEST(Facade, MeshesOnTheWorldAsOnOneRank) {
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), {.points = 1500});
  const Mesh alone = make_mesh(MPI_COMM_SELF, plate(), {.points = 1500});
  EXPECT_TRUE(mesh.certified());
  EXPECT_EQ(mesh.hash(), alone.hash());
  EXPECT_EQ(mesh.points(), alone.points());
  EXPECT_EQ(mesh.quality().alpha.mean, alone.quality().alpha.mean);
  EXPECT_EQ(mesh.facet_names()[0], "plate");
  EXPECT_EQ(mesh.facet_names()[1], "hole");
}

TEST(Facade, HalfOfTheRanksMakeAMeshOfTheirOwn) {
  const int rank = rank_of(MPI_COMM_WORLD), half = rank % 2;
  MPI_Comm part = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, half, rank, &part);
  const GlobalId points = half == 0 ? 800 : 1200;
  const Mesh mesh = make_mesh(part, plate(), {.points = points});
  MPI_Comm_free(&part); // the mesh has a duplicate
  EXPECT_EQ(mesh.hash(), make_mesh(MPI_COMM_SELF, plate(), {.points = points}).hash());
  const LocalMesh local = mesh.local();
  EXPECT_EQ(local.sum(static_cast<double>(local.owned_points())), static_cast<double>(mesh.points()));
}

TEST(Facade, BoundaryEdgesByName) {
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), {.points = 2000});
  const LocalMesh local = mesh.local();
  double length = 0;
  for (const Facet& facet : local.facets("hole")) {
    const Vec2 a = local.points()[at(facet.first)], b = local.points()[at(facet.second)];
    EXPECT_NEAR(geometry::length(a - Vec2{1, .5}), .2, 1e-9);
    if (facet.owned)
      length += geometry::length(b - a);
  }
  EXPECT_NEAR(local.sum(length), 2 * std::acos(-1.0) * .2, 0.01);
  const auto slab = static_cast<double>(mesh.facets("hole").size());
  double owned = 0;
  for (const Facet& facet : local.facets("hole"))
    owned += facet.owned ? 1 : 0;
  EXPECT_EQ(local.sum(slab), local.sum(owned));
}

TEST(Facade, RegionsAndCurves) {
  const Shape left = rectangle("left", {0, 0}, {.5, 1});
  const MeshOptions options{.points = 1000,
                            .regions = {{"iron", left, .5}, {"all", domain()}},
                            .curves = {{"fault", {{{.7, .2}, {.7, .8}}}}}};
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, domain(), options);
  EXPECT_TRUE(mesh.certified());
  EXPECT_EQ(mesh.names().regions, (std::vector<std::string>{"domain", "iron", "all"}));
  EXPECT_EQ(mesh.names().interfaces, (std::vector<std::string>{"iron|all"}));
  const LocalMesh local = mesh.local();
  for (LocalIndex t = 0; t < std::ssize(local.triangles()); ++t) {
    double x = 0;
    for (const LocalIndex corner : local.triangles()[at(t)])
      x += local.points()[at(corner)].x / 3;
    EXPECT_EQ(local.region(t), x < .5 ? 2 : 3);
  }
  const auto length_of = [&](const std::vector<InnerEdge>& edges) {
    double length = 0;
    for (const InnerEdge& edge : edges)
      length += edge.owned ? geometry::length(local.points()[at(edge.second)] - local.points()[at(edge.first)]) : 0;
    return local.sum(length);
  };
  EXPECT_NEAR(length_of(local.interfaces("iron|all")), 1, 1e-12);
  EXPECT_NEAR(length_of(local.curve_edges("fault")), .6, 1e-12);
  EXPECT_EQ(mesh.hash(), make_mesh(MPI_COMM_SELF, domain(), options).hash());
}

TEST(Facade, SplitCurves) {
  const MeshOptions options{
      .points = 1000, .curves = {{"crack", {{{.3, .5}, {.7, .5}}}, false, true}, {"river", {{{.2, .1}, {.8, .1}}}}}};
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, domain(), options);
  EXPECT_TRUE(mesh.certified());
  EXPECT_EQ(mesh.names().split_curves, std::vector<std::string>{"crack"});
  const LocalMesh local = mesh.local();
  double length = 0, sides = 0, left = 0;
  for (const Facet& side : local.facets("crack"))
    if (side.owned) {
      length += geometry::length(local.points()[at(side.second)] - local.points()[at(side.first)]);
      ++sides;
    }
  for (const auto& pair : local.split_pairs("crack"))
    left += pair[0] >= local.global_id(0) && pair[0] < local.global_id(0) + local.owned_points() ? 1 : 0;
  EXPECT_NEAR(local.sum(length), .8, 1e-12);
  EXPECT_EQ(local.sum(sides), 2 * (local.sum(left) + 1)); // its ends are single
  EXPECT_TRUE(local.curve_edges("crack").empty());
  EXPECT_TRUE(local.split_pairs("river").empty());
  expect_in("no boundary 'river'", error_of<ConfigError>([&] { local.facets("river"); }));
  EXPECT_EQ(mesh.hash(), make_mesh(MPI_COMM_SELF, domain(), options).hash());
}

TEST(Facade, WrongRegionsAndCurves) {
  const Shape square = rectangle("square", {0, 0}, {.5, .5}), other = rectangle("other", {.6, .6}, {.7, .7});
  const auto make = [&](const MeshOptions& options) {
    return [&options, &square] { make_mesh(MPI_COMM_WORLD, square, options); };
  };
  EXPECT_NE(error_of<GeometryError>(make({.points = 100, .regions = {{"far", other}}})).find("region 'far'"),
            std::string::npos);
  EXPECT_NE(error_of<ConfigError>(make({.points = 100, .regions = {{"a", square}, {"a", square}}})).find("'a'"),
            std::string::npos);
  EXPECT_NE(error_of<ConfigError>(make({.points = 100, .regions = {{"a", square, -1}}})).find("size of the region"),
            std::string::npos);
  EXPECT_NE(error_of<GeometryError>(make({.points = 100, .curves = {{"c", {{{.1, .1}, {.9, .1}}}}}})).find("curve 'c'"),
            std::string::npos);
}

TEST(Facade, GhostsGetTheValuesOfTheirOwners) {
  const LocalMesh local = make_mesh(MPI_COMM_WORLD, plate(), {.points = 1000}).local(); // the mesh is gone
  std::vector<double> values(local.points().size(), -1);
  for (LocalIndex i = 0; i < local.owned_points(); ++i)
    values[at(i)] = static_cast<double>(local.global_id(i));
  local.update_ghosts(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i], static_cast<double>(local.global_id(static_cast<LocalIndex>(i))));
}

TEST(Facade, AFileIsReadBackWithItsNames) {
  const comm::Communicator world = comm::Communicator::world();
  const test::TemporaryDirectory directory(world);
  const std::string path = directory.path() + "/deep/er/plate.h5";
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), {.points = 700});
  mesh.write(path);
  expect_in("exists", error_of<FileError>([&] { mesh.write(path); }));
  mesh.write(path, {.overwrite = true});
  const Mesh read = read_mesh(MPI_COMM_WORLD, path);
  EXPECT_EQ(read.hash(), mesh.hash());
  EXPECT_EQ(read.certified(), mesh.certified());
  EXPECT_EQ(read.facet_names(), mesh.facet_names());
  EXPECT_EQ(read.checks().size(), mesh.checks().size());
  EXPECT_EQ(read.quality().alpha.mean, mesh.quality().alpha.mean);
  const LocalMesh local = read.local();
  EXPECT_GT(local.sum(static_cast<double>(local.facets("hole").size())), 0);
  read.write(directory.path() + "/other/plate.msh");
  expect_in("exists", error_of<FileError>([&] { read.write(directory.path() + "/other/plate.msh"); }));
  expect_in("expected a path that ends in .h5", error_of<ConfigError>([&] { read.write("plate.docx"); }));
}

TEST(Facade, LatitudesOfAnotherMeshDoNotStay) {
  const comm::Communicator world = comm::Communicator::world();
  const test::TemporaryDirectory directory(world);
  const std::string path = directory.path() + "/plate_grd.dat", latitudes = directory.path() + "/plate_cor.dat";
  if (world.is_root())
    std::ofstream(latitudes) << "Node Number = 1\n0 0 54\n";
  MPI_Barrier(MPI_COMM_WORLD);
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), {.points = 200});
  expect_in("plate_cor.dat exists", error_of<FileError>([&] { mesh.write(path); }));
  EXPECT_FALSE(std::filesystem::exists(path));
  mesh.write(path, {.overwrite = true});
  EXPECT_TRUE(std::filesystem::exists(path));
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(std::filesystem::exists(latitudes));
}

/// Writes a mesh with regions, which came from a program, to a file that names them.
void write_divided_square(const std::string& directory, const comm::Communicator& comm) {
  io::MeshFileOptions options;
  options.directory = directory;
  options.name = "square";
  options.part_markers = {0, 0};
  const mesh::DistributedMesh whole = test::divided_square(11);
  record::Origin origin{{"hole", "rim"}, {0, 0}, test::three_regions()};
  origin.curve_names = {"fault", "wall"};
  meshing::MeshResult result;
  result.mesh = test::slabs_of(whole, comm, 3);
  result.mesh.hash = mesh::partial_hash(whole);
  io::write_mesh(options, result.mesh, record::describe(result, origin, "uniform", comm), comm);
}

TEST(Facade, RegionsCurvesAndInterfacesAreFoundByTheirNames) {
  const comm::Communicator world = comm::Communicator::world();
  const test::TemporaryDirectory directory(world);
  write_divided_square(directory.path(), world);
  const Mesh mesh = read_mesh(MPI_COMM_WORLD, directory.path() + "/square.h5");
  const MeshNames names = mesh.names();
  EXPECT_EQ(names.regions, (std::vector<std::string>{"rest", "rock", "soil"}));
  EXPECT_EQ(names.interfaces, (std::vector<std::string>{"rest|rock", "rest|soil", "rock|soil"}));
  const LocalMesh local = mesh.local();
  const mesh::DistributedMesh whole = test::divided_square(11);
  double owned = 0;
  for (const InnerEdge& edge : local.interfaces("rock|soil")) {
    EXPECT_EQ(edge.left < 0 ? 2 : local.region(edge.left), 2);
    EXPECT_EQ(edge.right < 0 ? 3 : local.region(edge.right), 3);
    owned += edge.owned ? 1 : 0;
  }
  EXPECT_EQ(local.sum(owned),
            static_cast<double>(std::count(whole.interface_pairs.begin(), whole.interface_pairs.end(), 2)));
  EXPECT_EQ(local.sum(static_cast<double>(local.arrays().owned_curve_edges)),
            static_cast<double>(whole.curve_slab.total));
  EXPECT_LE(local.curve_edges("wall").size(), 10u);
  expect_in("no interface 'soil|rock'", error_of<ConfigError>([&] { local.interfaces("soil|rock"); }));
  expect_in("no curve 'wal'", error_of<ConfigError>([&] { local.curve_edges("wal"); }));
  mesh.write(directory.path() + "/again.h5");
  const Mesh again = read_mesh(MPI_COMM_WORLD, directory.path() + "/again.h5");
  EXPECT_EQ(again.names().interfaces, names.interfaces);
  EXPECT_EQ(again.result().mesh.interface_slab.total, whole.interface_slab.total);
}

TEST(Facade, SizesByAFunctionAndAutomatically) {
  const MeshOptions options{.points = 1500};
  const auto growing = [](Vec2 p) { return 1 + 3 * p.x; };
  const Mesh graded = make_mesh(MPI_COMM_WORLD, plate(), growing, options);
  const Mesh automatic = make_mesh(MPI_COMM_WORLD, plate(), sizes::automatic(0.2), options);
  const Mesh uniform = make_mesh(MPI_COMM_WORLD, plate(), sizes::uniform(), options);
  EXPECT_TRUE(graded.certified());
  EXPECT_TRUE(automatic.certified());
  EXPECT_EQ(uniform.hash(), make_mesh(MPI_COMM_WORLD, plate(), options).hash());
  EXPECT_EQ(std::set<std::uint64_t>({graded.hash(), automatic.hash(), uniform.hash()}).size(), 3u);
  EXPECT_EQ(automatic.hash(), make_mesh(MPI_COMM_SELF, plate(), sizes::automatic(0.2), options).hash());
}

TEST(Facade, TheSmallestOfSeveralSizesCounts) {
  const Size rising([](Vec2 p) { return 0.02 + 0.02 * p.x; });
  const Size smallest = sizes::smallest({{"wave", rising}, {"coast", sizes::formula("0.05 - 0.02*x")}});
  const MeshOptions options{.absolute_sizes = true, .max_size = 0.045};
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), smallest, options);
  EXPECT_TRUE(mesh.certified());
  EXPECT_EQ(mesh.hash(), make_mesh(MPI_COMM_SELF, plate(), smallest, options).hash());
  const Size by_hand([](Vec2 p) { return std::fmin(0.02 + 0.02 * p.x, 0.05 - 0.02 * p.x); });
  EXPECT_EQ(mesh.hash(), make_mesh(MPI_COMM_WORLD, plate(), by_hand, options).hash());
  const std::vector<SizeShare> shares = mesh.size_shares();
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].name, "size.wave");
  EXPECT_EQ(shares[0].points + shares[1].points, mesh.points());
  double waves = 0; // the two sizes meet at x = 0.75
  const LocalMesh local = mesh.local();
  for (LocalIndex k = 0; k < local.owned_points(); ++k)
    waves += local.points()[static_cast<std::size_t>(k)].x < 0.75 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(shares[0].points), local.sum(waves), 2);
  const comm::Communicator world = comm::Communicator::world();
  const test::TemporaryDirectory directory(world);
  mesh.write(directory.path() + "/smallest.h5");
  const Mesh read = read_mesh(MPI_COMM_WORLD, directory.path() + "/smallest.h5");
  ASSERT_EQ(read.size_shares().size(), 2u);
  EXPECT_EQ(read.size_shares()[1].points, shares[1].points);
}

TEST(Facade, RulesOfModelsJudgeTheMesh) {
  const double half = 35 * std::numbers::pi / 180; // two corners of 70 degrees, with one triangle each
  const Shape rhombus =
      rings("rhombus",
            {{{0, 0}, {std::cos(half), -std::sin(half)}, {2 * std::cos(half), 0}, {std::cos(half), std::sin(half)}}});
  MeshOptions options{.points = 300, .accept = {"fvcom", "adcirc"}};
  const Mesh eared = make_mesh(MPI_COMM_WORLD, rhombus, options);
  options.split_ears = true;
  const Mesh split = make_mesh(MPI_COMM_WORLD, rhombus, options);
  const auto ears = [](const Mesh& mesh) {
    const std::vector<Verdict> verdicts = mesh.verdicts();
    const auto found = std::ranges::find_if(
        verdicts, [](const Verdict& v) { return v.solver == "fvcom" && v.rule == "boundary_edges"; });
    return found == verdicts.end() ? Verdict{} : *found;
  };
  EXPECT_EQ(ears(eared).broken, 2);
  EXPECT_EQ(ears(eared).worst, 2);
  EXPECT_EQ(ears(eared).measured, eared.triangles());
  EXPECT_TRUE(ears(eared).place.has_value());
  EXPECT_LT(ears(split).broken, ears(eared).broken);
  EXPECT_NE(eared.hash(), split.hash());
  const comm::Communicator world = comm::Communicator::world();
  const test::TemporaryDirectory directory(world);
  eared.write(directory.path() + "/eared.h5");
  const Mesh read = read_mesh(MPI_COMM_WORLD, directory.path() + "/eared.h5");
  ASSERT_EQ(read.verdicts().size(), eared.verdicts().size());
  EXPECT_EQ(read.verdicts().back().worst, eared.verdicts().back().worst);
  EXPECT_EQ(ears(read).place, ears(eared).place);
  EXPECT_TRUE(make_mesh(MPI_COMM_WORLD, rhombus, {.points = 300}).verdicts().empty());
}

TEST(Facade, AnOpenBoundaryIsNamedForRulesAndFiles) {
  // SCHISM refuses an outer loop that is open all along.
  const MeshOptions options{.points = 300, .accept = {"schism"}, .open_boundary = std::vector<std::string>{"plate"}};
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), options);
  EXPECT_FALSE(mesh.certified());
  const std::vector<Verdict> verdicts = mesh.verdicts();
  EXPECT_TRUE(std::ranges::any_of(verdicts, [](const Verdict& v) {
    return v.rule == "looped_open_boundary" && v.broken == 1 && v.refuses && !v.place;
  }));
  EXPECT_TRUE(make_mesh(MPI_COMM_WORLD, plate(), {.points = 300, .accept = {"schism"}}).certified());
}

TEST(Facade, AbsoluteSizesAreLengths) {
  const Size size([](Vec2 p) { return 0.02 + 0.05 * p.x; });
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), size, {.absolute_sizes = true});
  EXPECT_TRUE(mesh.certified());
  EXPECT_NEAR(mesh.quality().size_mean, 1, 0.03) << "mean of the edge length over the size";
  const Mesh uniform = make_mesh(MPI_COMM_WORLD, plate(), {.absolute_sizes = true, .max_size = 0.03});
  EXPECT_EQ(uniform.hash(), make_mesh(MPI_COMM_WORLD, plate(), {.edge_length = 0.03}).hash());
}

TEST(Facade, SteepFunctionsAreLimitedUnlessTheyAreAskedFor) {
  const Size jump([](Vec2 p) { return p.x < 0.5 ? 0.05 : 1; });
  const Mesh limited = make_mesh(MPI_COMM_WORLD, plate(), jump, {.points = 2000});
  EXPECT_TRUE(limited.certified());
  EXPECT_LT(limited.quality().alpha.max, 1.6);
  const double none = std::numeric_limits<double>::infinity();
  const Mesh raw = make_mesh(MPI_COMM_WORLD, plate(), jump, {.points = 2000, .gradation = none, .worst_alpha = 1e9});
  EXPECT_GT(raw.quality().alpha.max, limited.quality().alpha.max);
}

TEST(Facade, AllKindsOfParts) {
  const auto disc = [](Vec2 p) { return std::hypot(p.x - 3, p.y - 0.5) - 0.5; };
  const Shape shape =
      (rings("frame", {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{.5, .5}, {.5, 1.5}, {1.5, 1.5}, {1.5, .5}}}) +
       function("disc", disc, {{2.5, 0}, {3.5, 1}})) &
      rectangle("window", {-1, -1}, {3, 5});
  EXPECT_EQ(shape.text(), "intersection(union(frame, disc), window)");
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, shape, {.edge_length = 0.1});
  EXPECT_TRUE(mesh.certified());
  EXPECT_EQ(mesh.facet_names()[2], "window");
}

TEST(Facade, TextOfOperators) {
  const Shape a = rectangle("a", {0, 0}, {1, 1}), b = circle("b", {0, 0}, 1), c = circle("c", {1, 1}, 1);
  EXPECT_EQ((a - b - c).text(), "difference(a, b, c)");
  EXPECT_EQ((a - (b - c)).text(), "difference(a, difference(b, c))");
  EXPECT_EQ((a + (b + c)).text(), "union(a, b, c)");
  EXPECT_EQ((domain() - (a & b)).text(), "difference(domain, intersection(a, b))");
}

TEST(Facade, PeriodicMeshes) {
  const Mesh mesh =
      make_mesh(MPI_COMM_WORLD, domain() - circle("hole", {.5, .5}, .2),
                {.points = 800, .container = Box{{0, 0}, {1, 1}}, .periodic_x = true, .periodic_y = true});
  EXPECT_TRUE(mesh.certified());
}

TEST(Facade, ASecondEnvironmentDoesNothing) {
  int argc = 0;
  char** argv = nullptr;
  { const Environment second(argc, argv); }
  EXPECT_TRUE(comm::mpi_is_running());
}

TEST(FacadeErrors, Communicators) {
  const auto mesh_on = [](MPI_Comm comm) { return [=] { make_mesh(comm, plate(), {.points = 100}); }; };
  expect_in("MPI_COMM_NULL", error_of<ConfigError>(mesh_on(MPI_COMM_NULL)));
  MPI_Comm freed = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &freed);
  const MPI_Comm copy = freed;
  MPI_Comm_free(&freed);
  expect_in("it was freed before", error_of<ConfigError>(mesh_on(copy)));
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size == 1)
    return;
  MPI_Comm half = MPI_COMM_NULL, both = MPI_COMM_NULL;
  const int group = rank_of(MPI_COMM_WORLD) % 2;
  MPI_Comm_split(MPI_COMM_WORLD, group, 0, &half);
  MPI_Intercomm_create(half, 0, MPI_COMM_WORLD, 1 - group, 0, &both);
  expect_in("MPI_Intercomm_merge", error_of<ConfigError>(mesh_on(both)));
  MPI_Comm_free(&both);
  MPI_Comm_free(&half);
}

TEST(FacadeErrors, Options) {
  const auto mesh_with = [](const MeshOptions& options) {
    return [=] { make_mesh(MPI_COMM_WORLD, plate(), options); };
  };
  expect_in("one of points and edge_length, found none", error_of<ConfigError>(mesh_with({})));
  expect_in("found both", error_of<ConfigError>(mesh_with({.points = 100, .edge_length = 0.1})));
  expect_in("at least 3, found 2", error_of<ConfigError>(mesh_with({.points = 2})));
  expect_in("edge_length: expected a finite number above 0", error_of<ConfigError>(mesh_with({.edge_length = -1})));
  expect_in("min_size <= max_size",
            error_of<ConfigError>(mesh_with({.points = 100, .min_size = 0.2, .max_size = 0.1})));
  expect_in("need a container", error_of<ConfigError>(mesh_with({.points = 100, .periodic_x = true})));
  expect_in("container", error_of<GeometryError>(mesh_with({.points = 100, .container = Box{{0, 0}, {1, 1}}})));
  expect_in("MeshOptions::fixed_points[0]",
            error_of<GeometryError>(mesh_with({.points = 100, .fixed_points = {{1, .5}}}))); // in the hole
  if (const comm::Communicator world = comm::Communicator::world(); world.size() > 1) {
    const GlobalId points = 100 + world.rank();
    expect_in("rank 0 has 'points 100', another rank has 'points 101'",
              error_of<ConfigError>(mesh_with({.points = points})));
    MeshOptions lossy{.points = 100};
    lossy.features.max_loss = world.is_root() ? 0.1 : 0.2;
    expect_in("max_loss 0.1', another rank", error_of<ConfigError>(mesh_with(lossy)));
  }
  MeshOptions beyond{.points = 100};
  beyond.features.max_loss = 1.5;
  expect_in("expected a share from 0 to 1, found 1.5", error_of<ConfigError>(mesh_with(beyond)));
}

TEST(FacadeErrors, ModelsAndSeveralSizes) {
  const auto mesh_with = [](const Size& size, const MeshOptions& options) {
    return [=] { make_mesh(MPI_COMM_WORLD, plate(), size, options); };
  };
  const auto smallest = [](std::vector<NamedSize> sizes) { return sizes::smallest(std::move(sizes)); };
  const MeshOptions options{.points = 200};
  expect_in("adcirc schism telemac fvcom delft3d mpas, found 'fvcon'",
            error_of<ConfigError>(mesh_with(sizes::uniform(), {.points = 200, .accept = {"fvcon"}})));
  expect_in("open_boundary: no part of the boundary has the name 'hol'; did you mean 'hole'?; the names are",
            error_of<ConfigError>(
                mesh_with(sizes::uniform(), {.points = 200, .open_boundary = std::vector<std::string>{"hol"}})));
  const Size formula = sizes::formula("1 + x");
  expect_in("the size 'a' is uniform", error_of<ConfigError>(mesh_with(smallest({{"a", sizes::uniform()}}), options)));
  expect_in("two sizes are called 'a'",
            error_of<ConfigError>(mesh_with(smallest({{"a", formula}, {"a", formula}}), options)));
  expect_in("the name 'a b' of a size", error_of<ConfigError>(mesh_with(smallest({{"a b", formula}}), options)));
  expect_in("'outer' is the smallest one of others",
            error_of<ConfigError>(mesh_with(smallest({{"outer", smallest({{"a", formula}})}}), options)));
  expect_in("at least one size with a name, found none", error_of<ConfigError>(mesh_with(smallest({}), options)));
  expect_in("'none' is the smallest one of others",
            error_of<ConfigError>(mesh_with(smallest({{"a", formula}, {"none", smallest({})}}), options)));
}

TEST(FacadeErrors, SizesThatDifferBetweenRanks) {
  const comm::Communicator world = comm::Communicator::world();
  if (world.size() == 1)
    GTEST_SKIP() << "one rank agrees with itself";
  const auto mesh_with = [&](const Size& of_root, const Size& of_others) {
    return error_of<ConfigError>(
        [&] { make_mesh(MPI_COMM_WORLD, plate(), world.is_root() ? of_root : of_others, {.points = 200}); });
  };
  const Size formula = sizes::formula("1 + x"), other = sizes::formula("2 - x");
  const auto pair = [](const char* first, const Size& a, const char* second, const Size& b) {
    return sizes::smallest({{first, a}, {second, b}});
  };
  expect_in("rank 0 has 'size expression 1 + x', another rank has 'size expression 2 - x'", mesh_with(formula, other));
  expect_in("rank 0 has 'size uniform', another rank has 'size automatic",
            mesh_with(sizes::uniform(), sizes::automatic()));
  expect_in("gradation 0.1', another rank has 'size automatic, gradation 0.2'",
            mesh_with(sizes::automatic(0.1), sizes::automatic(0.2)));
  expect_in("rank 0 has 'size 'a' expression 1 + x', another rank has 'size 'b' expression 2 - x'",
            mesh_with(pair("a", formula, "b", other), pair("b", other, "a", formula)));
  expect_in("another rank has 'size 'b b' expression 2 - x'", // and not the bad name on that rank alone
            mesh_with(pair("a", formula, "b", other), pair("a", formula, "b b", other)));
  expect_in("the smallest of 2 sizes', another rank has 'size the smallest of 0 sizes'",
            mesh_with(pair("a", formula, "b", other), sizes::smallest({})));
  MeshOptions options{.points = 200};
  if (world.is_root())
    options.regions = {{"west", rectangle("west", {0, 0}, {0.5, 1})}};
  expect_in("rank 0 has '1 regions, 0 curves", // the items of root begin with those of the others
            error_of<ConfigError>([&] { make_mesh(MPI_COMM_WORLD, plate(), options); }));
}

TEST(FacadeErrors, Shapes) {
  const auto mesh_of = [](const Shape& shape) { return [=] { make_mesh(MPI_COMM_WORLD, shape, {.points = 100}); }; };
  const Shape square = rectangle("a", {0, 0}, {1, 1});
  expect_in("two different parts are called 'a'", error_of<ConfigError>(mesh_of(square - circle("a", {0, 0}, .5))));
  expect_in("letters, digits", error_of<ConfigError>(mesh_of(circle("my part", {0, 0}, .5))));
  expect_in("this name stands for the container", error_of<ConfigError>(mesh_of(circle("domain", {0, 0}, .5))));
  expect_in("the part 'c'", error_of<GeometryError>(mesh_of(circle("c", {0, 0}, 0))));
  expect_in("the part 'r'", error_of<GeometryError>(mesh_of(rectangle("r", {1, 1}, {0, 0}))));
  expect_in("nowhere.xy", error_of<FileError>(mesh_of(contour("f", "nowhere.xy"))));
  const int last = comm::Communicator::world().size() - 1;
  const bool fails = rank_of(MPI_COMM_WORLD) == last;
  const auto throwing = [=](Vec2 p) {
    if (fails)
      throw std::runtime_error("no table");
    return std::hypot(p.x - .5, p.y - .5) - .3;
  };
  expect_in("the function of the part 'f' failed at",
            error_of<GeometryError>(mesh_of(function("f", throwing, {{0, 0}, {1, 1}}))));
}

TEST(FacadeErrors, SizesThatFailOnOneRank) {
  const int last = comm::Communicator::world().size() - 1;
  const bool fails = rank_of(MPI_COMM_WORLD) == last;
  const auto mesh_with = [](const Size& size) {
    return [=] { make_mesh(MPI_COMM_WORLD, plate(), size, {.points = 300}); };
  };
  const auto nan = [=](Vec2 p) { return fails ? std::numeric_limits<double>::quiet_NaN() : 1 + p.x; };
  expect_in("expected a positive finite size, found nan", error_of<GeometryError>(mesh_with(Size(nan))));
  const auto throwing = [=](Vec2 p) {
    if (fails)
      throw std::out_of_range("beyond my table");
    return 1 + p.x;
  };
  const std::string message = error_of<GeometryError>(mesh_with(Size(throwing)));
  expect_in("the size function failed at (", message);
  expect_in("beyond my table", message);
  expect_in("gradation", error_of<ConfigError>(mesh_with(sizes::automatic(-1))));
}

TEST(FacadeErrors, AbsoluteSizes) {
  const auto mesh_with = [](const Size& size, const MeshOptions& options) {
    return [=] { make_mesh(MPI_COMM_WORLD, plate(), size, options); };
  };
  const Size function([](Vec2) { return 0.02; });
  expect_in("points = 100 is the limit",
            error_of<ConfigError>(mesh_with(function, {.points = 100, .absolute_sizes = true})));
  expect_in("expected no edge length with absolute_sizes",
            error_of<ConfigError>(mesh_with(function, {.edge_length = 0.1, .absolute_sizes = true})));
  expect_in("max_size: expected the length of the edges",
            error_of<ConfigError>(mesh_with(sizes::uniform(), {.absolute_sizes = true})));
  expect_in("min_size: expected a length",
            error_of<ConfigError>(mesh_with(sizes::automatic(), {.absolute_sizes = true})));
  expect_in("gradation: expected a number above 0",
            error_of<ConfigError>(mesh_with(function, {.points = 100, .gradation = 0})));
  const bool fails = rank_of(MPI_COMM_WORLD) == comm::Communicator::world().size() - 1;
  const Size late([=](Vec2 p) { // fails at few places, so that the first search for steep places meets them
    if (fails && std::hypot(p.x - 0.31, p.y - 0.52) < 0.01)
      throw std::out_of_range("beyond my table");
    return 0.02;
  });
  expect_in("beyond my table", error_of<GeometryError>(mesh_with(late, {.absolute_sizes = true})));
}

TEST(FacadeErrors, UnknownBoundaryNames) {
  const Mesh mesh = make_mesh(MPI_COMM_WORLD, plate(), {.points = 300});
  const std::string message = error_of<ConfigError>([&] { mesh.facets("hol"); });
  expect_in("no boundary 'hol'; did you mean 'hole'?", message);
  expect_in("known: plate, hole", message);
  const LocalMesh local = mesh.local();
  expect_in("did you mean 'plate'", error_of<ConfigError>([&] { local.facets("plat"); }));
}

} // namespace
} // namespace trime
