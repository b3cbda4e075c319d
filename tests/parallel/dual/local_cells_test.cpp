// SPDX-License-Identifier: BSD-3-Clause
// The cells that a solver gets in memory, against those of the whole mesh on one rank: squares with holes and regions,
// cut anywhere, and a torus.
#include "trime/dual/local_cells.hpp"

#include "comm/agree.hpp"
#include "dual/site_cell.hpp"
#include "support/mesh_slabs.hpp"
#include "support/periodic_shapes.hpp"
#include "support/plain_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace trime::dual {
namespace {

using geometry::Vec2;
using mesh::DistributedMesh;

struct Made {
  handover::LocalMesh mesh;
  LocalCells cells;
};

Made made_of(const DistributedMesh& mesh, const comm::Communicator& comm, Vec2 period) {
  handover::LocalMesh local = handover::make_local_mesh(comm, mesh);
  LocalCells cells = make_local_cells(comm, local, period);
  return {std::move(local), std::move(cells)};
}

/// A number of a cell or of a face, in a form that does not depend on ranks.
struct Row {
  std::int64_t kind;
  GlobalId first, second;
  std::array<double, 8> values;

  auto operator<=>(const Row&) const = default;
};

void add_polygon(std::vector<Row>& rows, const Made& made, GlobalId id, std::int64_t kind,
                 std::span<const LocalIndex> corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 p = made.cells.vertices.at(at(corners[k]));
    rows.push_back({kind, id, static_cast<GlobalId>(k), {p.x, p.y}});
  }
}

template <class Value>
std::span<const Value> cut(const std::vector<Value>& values, std::int64_t from, std::int64_t to) {
  return std::span(values).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from));
}

/// Everything that a rank knows of its cells.
void add_cell(std::vector<Row>& rows, const Made& made, std::size_t i) {
  const LocalCells& cells = made.cells;
  const GlobalId id = made.mesh.global_id(static_cast<LocalIndex>(i));
  rows.push_back({0, id, 0, {cells.areas[i], cells.centroids[i].x, cells.centroids[i].y}});
  add_polygon(rows, made, id, 1, cut(cells.corners, cells.corner_first[i], cells.corner_first[i + 1]));
  for (auto part = cells.part_first[i]; part < cells.part_first[i + 1]; ++part) {
    const auto k = static_cast<std::size_t>(part);
    const Vec2 centroid = cells.part_centroids[k];
    rows.push_back({2, id, cells.part_regions[k], {cells.part_areas[k], centroid.x, centroid.y}});
    add_polygon(rows, made, id, 3 + part - cells.part_first[i],
                cut(cells.part_corners, cells.part_corner_first[k], cells.part_corner_first[k + 1]));
  }
}

/// A face as its cell sees it: the ends in the frame of this cell.
Row face_row(const Made& made, LocalIndex face, std::int64_t kind) {
  const LocalCells& cells = made.cells;
  const auto f = at(face);
  const Vec2 arm = cells.face_arms[f];
  const auto& lengths = cells.face_lengths[f];
  const auto& regions = cells.face_regions[f];
  return {kind,
          made.mesh.global_id(cells.faces[f][0]),
          made.mesh.global_id(cells.faces[f][1]),
          {arm.x, arm.y, lengths[0], lengths[1], static_cast<double>(regions[0]), static_cast<double>(regions[1])}};
}

std::vector<Row> all_rows(const Made& made, const comm::Communicator& comm) {
  const LocalCells& cells = made.cells;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < at(cells.cells); ++i) {
    add_cell(rows, made, i);
    for (auto k = cells.neighbour_first[i]; k < cells.neighbour_first[i + 1]; ++k) {
      Row row = face_row(made, cells.neighbour_faces[static_cast<std::size_t>(k)], 100);
      row.values[6] = static_cast<double>(made.mesh.global_id(static_cast<LocalIndex>(i)));
      row.values[7] = static_cast<double>(k - cells.neighbour_first[i]);
      rows.push_back(row);
    }
  }
  for (LocalIndex face = 0; face < cells.owned_faces; ++face) {
    Row row = face_row(made, face, 101);
    const auto& ends = cells.face_vertices[at(face)];
    row.values[6] = length(cells.vertices[at(ends[1])] - cells.vertices[at(ends[0])]);
    rows.push_back(row);
  }
  for (std::size_t k = 0; k < cells.chord_cells.size(); ++k) {
    const auto& facet = made.mesh.facets[at(cells.chord_facets[k])];
    const Vec2 normal = cells.chord_normals[k];
    rows.push_back({102,
                    made.mesh.global_id(facet[0]),
                    made.mesh.global_id(facet[1]),
                    {normal.x, normal.y, static_cast<double>(made.mesh.global_id(cells.chord_cells[k]))}});
  }
  std::vector<Row> all = comm::gather_everywhere(comm, rows);
  std::sort(all.begin(), all.end());
  return all;
}

struct Case {
  std::string name;
  DistributedMesh whole, part;
  Vec2 period{0, 0};
};

std::vector<Case> cases(const comm::Communicator& comm) {
  std::vector<Case> list;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const DistributedMesh holed = test::holed_square(5), divided = test::divided_square(7);
    list.push_back({"holed", holed, test::slabs_of(holed, comm, seed)});
    list.push_back({"divided", divided, test::slabs_of(divided, comm, seed)});
  }
  meshing::MeshOptions options;
  options.points = 300;
  options.max_sweeps = 5;
  const sizing::UniformSize size;
  const geometry::Domain torus = testing::torus_with_hole().domain();
  list.push_back({"torus",
                  testing::mesh_silently(comm::Communicator::self(), torus, size, options).mesh,
                  testing::mesh_silently(comm, torus, size, options).mesh,
                  {1, 1}});
  return list;
}

TEST(LocalCells, AreTheSameOnAnyRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const Case& made : cases(comm)) {
    const std::vector<Row> one =
        all_rows(made_of(made.whole, comm::Communicator::self(), made.period), comm::Communicator::self());
    EXPECT_TRUE(all_rows(made_of(made.part, comm, made.period), comm) == one) << made.name;
  }
}

TEST(LocalCells, CoverTheMeshAndKnowTheirGhosts) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const Case& made : cases(comm)) {
    const Made local = made_of(made.part, comm, made.period);
    const handover::LocalMesh& mesh = local.mesh;
    const LocalCells& cells = local.cells;
    std::vector<double> areas = cells.areas, of_regions(4, 0), wanted(4, 0);
    std::fill(areas.begin() + cells.cells, areas.end(), -1);
    handover::update_ghosts(comm, mesh, areas);
    EXPECT_EQ(areas, cells.areas) << made.name;
    for (std::size_t part = 0; part < cells.part_areas.size(); ++part)
      of_regions[at(cells.part_regions[part])] += cells.part_areas[part];
    for (std::size_t t = 0; t < at(mesh.owned_triangles); ++t) {
      const auto corner = [&](std::size_t k) { return mesh.points[at(mesh.triangles[t][k])]; };
      wanted[at(mesh.regions.empty() ? 1 : mesh.regions[t])] +=
          0.5 * cross(difference(corner(1), corner(0), made.period), difference(corner(2), corner(0), made.period));
    }
    for (std::size_t region = 0; region < 4; ++region) {
      const auto sum = [&](double value) {
        double total = 0;
        for (const double part : comm.all_gather(value))
          total += part;
        return total;
      };
      EXPECT_NEAR(sum(of_regions[region]), sum(wanted[region]), 1e-13) << made.name << ' ' << region;
    }
    EXPECT_EQ(comm.sum(std::int64_t{cells.owned_faces}) * 2 - made.part.facet_slab.total, 3 * mesh.total_triangles);
    EXPECT_EQ(comm.sum(std::ssize(cells.chord_cells)), 2 * made.part.facet_slab.total);
  }
}

/// The divergence theorem: around each cell, faces and chords close.
TEST(LocalCells, AreClosedByTheirFacesAndChords) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const Case& made : cases(comm)) {
    const Made local = made_of(made.part, comm, made.period);
    const LocalCells& cells = local.cells;
    std::vector<Vec2> sums(at(cells.cells), {0, 0});
    for (std::size_t i = 0; i < sums.size(); ++i)
      for (auto k = cells.neighbour_first[i]; k < cells.neighbour_first[i + 1]; ++k) {
        const auto face = at(cells.neighbour_faces[static_cast<std::size_t>(k)]);
        const double sign = cells.faces[face][0] == static_cast<LocalIndex>(i) ? 1 : -1;
        const Vec2 arm = cells.face_arms[face];
        const double area = cells.face_lengths[face][0] + cells.face_lengths[face][1];
        EXPECT_EQ(cells.faces[face][sign > 0 ? 1 : 0], cells.neighbours[static_cast<std::size_t>(k)]);
        sums[i] = sums[i] + (sign * area / length(arm)) * arm;
        const auto& ends = cells.face_vertices[face];
        EXPECT_NEAR(length(cells.vertices[at(ends[1])] - cells.vertices[at(ends[0])]), area, 1e-14);
      }
    for (std::size_t k = 0; k < cells.chord_cells.size(); ++k)
      sums[at(cells.chord_cells[k])] = sums[at(cells.chord_cells[k])] + cells.chord_normals[k];
    for (const Vec2 sum : sums)
      EXPECT_NEAR(length(sum), 0, 1e-13) << made.name;
  }
}

TEST(LocalCells, NeedTheTrianglesOfOtherRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const DistributedMesh part = test::slabs_of(test::holed_square(7), comm, 1);
  const handover::LocalMesh local = handover::make_local_mesh(comm, part, handover::Overlap::none);
  if (comm.max(std::int64_t{local.owned_points}) < part.point_slab.total) {
    EXPECT_THROW(make_local_cells(comm, local, {0, 0}), FileError);
  }
}

} // namespace
} // namespace trime::dual
