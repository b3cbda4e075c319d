// SPDX-License-Identifier: BSD-3-Clause
#include "formats/flow_cells.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::formats {
namespace {

using dual::Surroundings;
using geometry::Vec2;

constexpr double least_face = 1e-9;   // of the edge that it crosses; smaller faces of Voronoi cells are left out
constexpr double same_centre = 1e-9;  // of the length of a face: nearer centres count as one place
constexpr double right_angle = -1e-9; // cosine: rounding must not make a right angle obtuse

/// The cosine of the largest angle of a triangle.
double least_cosine_of(Vec2 b, Vec2 c) {
  const Vec2 side = c - b;
  const double at_0 = dot(b, c) / (length(b) * length(c)), at_b = -dot(b, side) / (length(b) * length(side)),
               at_c = dot(c, side) / (length(c) * length(side));
  return std::min({at_0, at_b, at_c});
}

} // namespace

FlowCells::FlowCells(const ExchangeMesh& mesh)
    : mesh_(std::make_shared<const CellMesh>(mesh)), are_triangles_(mesh.names().cells == CellKind::triangles) {
  if (are_triangles_)
    find_facts();
}

GlobalId FlowCells::count() const {
  return are_triangles_ ? mesh_->mesh().triangles() : mesh_->mesh().points();
}

FlowCell FlowCells::cell_at(const CellMesh& mesh, LocalIndex site, const Surroundings& around) {
  double area = 0;
  dual::for_each_part(around, [&](const dual::CellPart& part) { area += dual::moments_of(around, part).area; });
  return {mesh.cells().number_of(site), mesh.cells().points[at(site)], area, dual::whole_cell(around).region};
}

FlowCell FlowCells::triangle_at(const CellMesh& mesh, std::int64_t row) {
  const mesh::DistributedMesh& part = mesh.mesh().mesh();
  const dual::SlabTriangle triangle = dual::slab_triangle(part, mesh.cells(), static_cast<std::size_t>(row));
  return {part.triangle_slab.first + row, triangle.first + dual::circumcentre(triangle.b, triangle.c),
          0.5 * cross(triangle.b, triangle.c), static_cast<std::int32_t>(mesh.mesh().region(row))};
}

FlowFace FlowCells::face_at(const CellMesh& mesh, bool are_triangles, LocalIndex site, const Surroundings& around,
                            std::size_t spoke) {
  const dual::Cells& cells = mesh.cells();
  const Vec2 middle = cells.points[at(site)] + around.middle(spoke);
  const double length_of_arm = length(around.arms[spoke]);
  if (!are_triangles)
    return {{cells.number_of(site), cells.number_of(around.ends[spoke])},
            middle,
            dual::face_of(around, spoke).dual_length(),
            {0.5 * length_of_arm, 0.5 * length_of_arm}};
  FlowFace face{{-1, -1}, middle, length_of_arm, {0, 0}};
  std::size_t side = 0;
  for (const auto& triangle : {around.right(spoke), around.left(spoke)})
    if (triangle) {
      face.cells[side] = cells.triangles[at(around.triangles[*triangle])].number;
      face.distances[side++] = dual::half_dual_length(around, spoke, *triangle);
    }
  if (face.cells[0] > face.cells[1] && face.cells[1] >= 0) {
    std::swap(face.cells[0], face.cells[1]);
    std::swap(face.distances[0], face.distances[1]);
  }
  return face;
}

bool FlowCells::has_face(const FlowFace& face, bool are_triangles) {
  return are_triangles ? face.cells[1] >= 0 : face.length > 2 * least_face * face.distances[0];
}

FlowCells::FaceCounts FlowCells::count_faces() const {
  const comm::Communicator& comm = mesh_->mesh().comm();
  double nearest = std::numeric_limits<double>::max();
  std::array<std::int64_t, 2> counts{};
  comm::run_agreed(comm, [&] {
    Surroundings around;
    for (LocalIndex site = 0; site < mesh_->cells().site_count; ++site) {
      dual::look_around(mesh_->cells(), site, around);
      for_each_face(*mesh_, are_triangles_, site, around, [&](const FlowFace& face) {
        const double distance = (face.distances[0] + face.distances[1]) / face.length;
        ++counts[0];
        counts[1] += distance > same_centre ? 0 : 1;
        nearest = std::min(nearest, distance);
      });
    }
  });
  comm.sum(counts);
  return {counts[0], counts[1], comm.min(nearest)};
}

/// Finds the triangle with the largest angle; among equal ones that with the lowest number.
void FlowCells::find_facts() {
  facts_.faces = count_faces();
  const ExchangeMesh& mesh = mesh_->mesh();
  const comm::Communicator& comm = mesh.comm();
  constexpr double huge = std::numeric_limits<double>::max();
  std::int64_t worst_row = -1;
  for (std::int64_t row = 0; row < std::ssize(mesh.mesh().triangles); ++row) {
    const dual::SlabTriangle triangle = dual::slab_triangle(mesh.mesh(), mesh_->cells(), static_cast<std::size_t>(row));
    const double cosine = least_cosine_of(triangle.b, triangle.c);
    facts_.obtuse += cosine < right_angle ? 1 : 0;
    if (cosine < facts_.least_cosine) {
      facts_.least_cosine = cosine;
      worst_row = row;
    }
  }
  facts_.obtuse = comm.sum(facts_.obtuse);
  const double here = facts_.least_cosine;
  facts_.least_cosine = comm.min(here);
  const bool is_worst = worst_row >= 0 && here == facts_.least_cosine;
  const GlobalId number = mesh.mesh().triangle_slab.first + worst_row;
  const GlobalId lowest = comm.min(is_worst ? number : std::numeric_limits<GlobalId>::max());
  std::array<double, 2> place{-huge, -huge};
  if (is_worst && number == lowest) {
    const Vec2 centre = triangle_at(*mesh_, worst_row).centre;
    place = {centre.x, centre.y};
  }
  comm.max(place);
  facts_.worst = {place[0], place[1]};
}

std::optional<FlowFace> FlowCells::boundary_face(GlobalId site, GlobalId other) const {
  const dual::Cells& cells = mesh_->cells();
  const auto here = static_cast<LocalIndex>(site - cells.first_site);
  Surroundings around;
  dual::look_around(cells, here, around);
  for (const std::size_t spoke : {std::size_t{0}, around.ends.size() - 1})
    if (cells.number_of(around.ends[spoke]) == other) {
      if (are_triangles_)
        return site < other ? std::optional(face_at(*mesh_, true, here, around, spoke)) : std::nullopt;
      return FlowFace{
          {site, -1}, cells.points[at(here)] + 0.25 * around.arms[spoke], 0.5 * length(around.arms[spoke]), {0, 0}};
    }
  return std::nullopt;
}

std::vector<CellLength> FlowCells::along_edge(GlobalId site, GlobalId other) const {
  const dual::Cells& cells = mesh_->cells();
  const auto here = static_cast<LocalIndex>(site - cells.first_site);
  Surroundings around;
  dual::look_around(cells, here, around);
  for (std::size_t spoke = 0; spoke < around.ends.size(); ++spoke)
    if (cells.number_of(around.ends[spoke]) == other) {
      const double half = 0.5 * length(around.arms[spoke]);
      if (!are_triangles_)
        return {{site, half}, {other, half}};
      const FlowFace face = face_at(*mesh_, true, here, around, spoke);
      if (face.cells[1] < 0)
        return {{face.cells[0], 2 * half}};
      return {{face.cells[0], half}, {face.cells[1], half}};
    }
  return {};
}

FilePlan FlowCells::proved(FilePlan plan) const {
  plan = mesh_->proved(std::move(plan));
  if (!are_triangles_)
    return plan;
  const std::string worst =
      fmt::format("{:.4g} degrees at ({:.9g}, {:.9g})", degrees_per_radian * std::acos(facts_.least_cosine),
                  facts_.worst.x, facts_.worst.y);
  plan.summary = fmt::format("{} triangles as cells, {} of them obtuse; largest angle {}; the centres of two cells are "
                             "at least {:.3g} of their side apart",
                             count(), facts_.obtuse, worst, facts_.faces.nearest_centres);
  if (facts_.obtuse > 0)
    plan.warning = fmt::format("obtuse triangles, whose centres lie in a neighbour: {} of {}; the largest angle is {}; "
                               "use more points there, or cells = voronoi, whose centres lie inside",
                               facts_.obtuse, count(), worst);
  if (facts_.faces.same_centres > 0)
    plan.warning += fmt::format("{}neighbours with their centres at one place, since the corners of both lie on one "
                                "circle: {} pairs; a flux between them has no limit; use cells = voronoi",
                                plan.warning.empty() ? "" : "; ", facts_.faces.same_centres);
  return plan;
}

} // namespace trime::formats
