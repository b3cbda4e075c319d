// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"

#include <algorithm>
#include <bit>

namespace trime_check {
namespace {

constexpr std::int64_t vtk_triangle = 5; // VTK's number of this kind of cell

void check_views(const Mesh& mesh, Report& report) {
  Tally points, cells;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Point p = mesh.points[i];
    if (mesh.has_vtk &&
        (mesh.vtk_points[3 * i] != p.x || mesh.vtk_points[3 * i + 1] != p.y || mesh.vtk_points[3 * i + 2] != 0))
      points.note([&] { return fmt::format("/VTKHDF/Points[{}] and {}", i, place_of(p)); });
    if (mesh.has_plain && (mesh.petsc_points[2 * i] != p.x || mesh.petsc_points[2 * i + 1] != p.y))
      points.note([&] { return fmt::format("/geometry/vertices[{}] and {}", i, place_of(p)); });
  }
  for (std::size_t t = 0; mesh.has_vtk && t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.connectivity[3 * t + k] != mesh.triangles[t][k])
        cells.note([&] { return fmt::format("/VTKHDF/Connectivity[{}] and {}", 3 * t + k, place_of(mesh, t)); });
    if (mesh.offsets[t] != static_cast<std::int64_t>(3 * t) || mesh.types[t] != vtk_triangle)
      cells.note([&] { return fmt::format("/VTKHDF/Offsets or Types [{}]", t); });
  }
  const std::vector<std::int64_t> counts{std::ssize(mesh.points), std::ssize(mesh.triangles),
                                         std::ssize(mesh.connectivity)};
  if (mesh.has_vtk && (mesh.offsets.back() != counts[2] || mesh.counts != counts))
    cells.note([] { return std::string("/VTKHDF/Offsets at its end, or one of /VTKHDF/NumberOf..."); });
  report.none("vtk_points", points, "points of the views /VTKHDF and /geometry that differ from /Mesh/mesh/geometry");
  report.none("vtk_cells", cells, "cells of the view /VTKHDF that differ from /Mesh/mesh/topology");
}

/// Canonical: the lowest vertex first, triangles by their first and then second vertex, facets by their lowest vertex.
void check_order(const Mesh& mesh, Report& report) {
  Tally wrong;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& now = mesh.triangles[t];
    if (now[0] > now[1] || now[0] > now[2] || (t > 0 && !(mesh.triangles[t - 1] < now)))
      wrong.note([&] { return place_of(mesh, t); });
  }
  for (std::size_t k = 1; k < mesh.facets.size(); ++k) {
    const auto least = [&](std::size_t f) { return std::min(mesh.facets[f][0], mesh.facets[f][1]); };
    if (least(k) < least(k - 1))
      wrong.note([&] { return fmt::format("facet {}: {}", k, place_of(mesh, mesh.facets[k])); });
  }
  report.none("order", wrong, "triangles and facets that do not stand in the order of their vertices, lowest first");
}

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// See "mesh_hash" in src/files.md.
std::uint64_t hash_of(const Mesh& mesh) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value); };
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    sum += mix(mix(mix(2 * std::uint64_t{i}) ^ bits(mesh.points[i].x)) ^ bits(mesh.points[i].y));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint64_t term = mix(2 * std::uint64_t{t} + 1);
    for (const std::int64_t id : mesh.triangles[t])
      term = mix(term ^ static_cast<std::uint64_t>(id));
    sum += term;
  }
  return sum;
}

void check_hash(const StoredFile& file, const Mesh& mesh, Report& report) {
  const std::uint64_t hash = hash_of(mesh);
  const std::string hex = fmt::format("{:016x}", hash);
  const std::optional<std::uint64_t> stored = file.hash("/trime_mpi", "mesh_hash");
  report.add("mesh_hash", stored == hash && file.text_attribute("/trime_mpi", "mesh_hash_hex") == hex,
             stored ? fmt::format("{:016x}", *stored) : std::string("a hash"), hex,
             "hash of points and triangles; expected is what /trime_mpi says");
}

} // namespace

bool check_arrays(const StoredFile& file, const Mesh& mesh, Report& report) {
  Tally range, infinite;
  const auto is_id = [&](std::int64_t id) { return id >= 0 && id < std::ssize(mesh.points); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!std::ranges::all_of(mesh.triangles[t], is_id))
      range.note([&] { return fmt::format("triangle {}", t); });
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    if (!std::ranges::all_of(mesh.facets[k], is_id))
      range.note([&] { return fmt::format("facet {}", k); });
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!std::isfinite(mesh.points[i].x) || !std::isfinite(mesh.points[i].y))
      infinite.note([&] { return fmt::format("point {} {}", i, place_of(mesh.points[i])); });
  report.none("id_range", range,
              fmt::format("triangles and facets with ids that are not those of {} points", mesh.points.size()));
  report.none("finite", infinite, "points whose coordinates are not finite numbers");
  if (range.count > 0)
    return false;
  check_hash(file, mesh, report);
  check_views(mesh, report);
  check_order(mesh, report);
  return infinite.count == 0;
}

} // namespace trime_check
