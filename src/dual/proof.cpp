// SPDX-License-Identifier: BSD-3-Clause
#include "dual/proof.hpp"

#include "core/thread_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace trime::dual {
namespace {

using geometry::Vec2;

constexpr double unit_roundings = 1000;     // area units: what roundings to units may add up to in a region
constexpr double area_tolerance = 1e-12;    // of areas of regions
constexpr double length_tolerance = 1e-12;  // of the length of an edge
constexpr double coordinate_roundings = 64; // half units in the last place of the largest coordinate

/// @brief Adds areas of regions as whole multiples of a small unit, so that sums do not depend on the order of their
/// terms. All areas of a mesh together are at most as large as the box around it, which has 2^61 units. What an area
/// has beyond whole units is added in smaller ones: the triangles of a mesh with one size have few different areas, so
/// the roundings of millions of equal terms would add up.
class AreaSums {
public:
  AreaSums(double box_area, std::size_t regions)
      : unit_(std::ldexp(box_area > 0 ? box_area : 1, -61)), units_(regions, 0), rests_(regions, 0) {}

  void add(std::int32_t region, double area) { // regions count from 1
    const double units = area / unit_, whole = std::nearbyint(units);
    units_[index(region)] += static_cast<std::int64_t>(whole);
    rests_[index(region)] += static_cast<std::int64_t>(std::nearbyint((units - whole) * rests_of_unit));
  }
  void add(const AreaSums& other) {
    for (std::size_t k = 0; k < units_.size(); ++k) {
      units_[k] += other.units_[k];
      rests_[k] += other.rests_[k];
    }
  }
  void sum_over_ranks(const comm::Communicator& comm) {
    comm.sum(units_);
    comm.sum(rests_);
  }

  /// Returns the area of all regions.
  double total() const {
    return in_units(std::accumulate(units_.begin(), units_.end(), std::int64_t{0}),
                    std::accumulate(rests_.begin(), rests_.end(), std::int64_t{0})) *
           unit_;
  }
  /// Returns how many regions have another area than in a sum with the same unit.
  std::int64_t count_different(const AreaSums& wanted) const {
    std::int64_t different = 0;
    for (std::size_t k = 0; k < units_.size(); ++k)
      if (std::fabs(in_units(units_[k] - wanted.units_[k], rests_[k] - wanted.rests_[k])) >
          area_tolerance * in_units(wanted.units_[k], wanted.rests_[k]) + unit_roundings)
        ++different;
    return different;
  }

private:
  static constexpr double rests_of_unit = 1 << 24; // 2^39 areas then add up to less than 2^62 of them
  static std::size_t index(std::int32_t region) { return static_cast<std::size_t>(region - 1); }
  static double in_units(std::int64_t units, std::int64_t rests) {
    return static_cast<double>(units) + static_cast<double>(rests) / rests_of_unit;
  }

  double unit_;
  std::vector<std::int64_t> units_, rests_; // by region
};

/// The frame in which roundings are judged.
struct CoordinateRange {
  double largest = 0;  // coordinate
  double box_area = 0; // of the box around the points
};

CoordinateRange range_of(const Cells& cells, const comm::Communicator& comm) {
  constexpr double huge = std::numeric_limits<double>::max();
  std::array<double, 4> ends{-huge, -huge, -huge, -huge}; // of -x, -y, x, y
  for (LocalIndex site = 0; site < cells.site_count; ++site) {
    const Vec2 p = cells.points[at(site)];
    const std::array<double, 4> here{-p.x, -p.y, p.x, p.y};
    for (std::size_t k = 0; k < 4; ++k)
      ends[k] = std::max(ends[k], here[k]);
  }
  comm.max(ends);
  const double width = cells.period.x > 0 ? cells.period.x : ends[0] + ends[2];
  const double height = cells.period.y > 0 ? cells.period.y : ends[1] + ends[3];
  CoordinateRange range{0, width * height};
  for (const double end : ends)
    range.largest = std::max(range.largest, std::fabs(end));
  return range;
}

/// Holds what a rank counts at its sites.
struct SiteTotals {
  std::int64_t parts = 0, boundary_cells = 0, corners = 0, spokes = 0, outside = 0, negative = 0, not_positive = 0;
  std::int64_t most_corners = 0;
  double smallest_area = std::numeric_limits<double>::max();
  double shortest_dual = std::numeric_limits<double>::max();
  AreaSums areas;

  explicit SiteTotals(const AreaSums& none) : areas(none) {}
};

class SiteCounter {
public:
  SiteCounter(const Cells& cells, double rounding) : cells_(cells), rounding_(rounding) {}

  void count(LocalIndex site, Surroundings& around, SiteTotals& totals) const {
    look_around(cells_, site, around);
    double area = 0;
    for_each_part(around, [&](const CellPart& part) {
      const double of_part = moments_of(around, part).area;
      area += of_part;
      totals.areas.add(part.region, of_part);
      ++totals.parts;
      totals.not_positive += of_part > 0 ? 0 : 1;
    });
    const std::int64_t corners = std::ssize(around.triangles) + (around.is_closed ? 0 : 3);
    totals.boundary_cells += around.is_closed ? 0 : 1;
    totals.corners += corners;
    totals.spokes += std::ssize(around.arms);
    totals.most_corners = std::max(totals.most_corners, corners);
    totals.smallest_area = std::min(totals.smallest_area, area);
    for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
      if (cells_.number_of(site) < cells_.number_of(around.ends[spoke])) // each edge once
        count_face(face_of(around, spoke), totals);
  }

private:
  void count_face(const CellFace& face, SiteTotals& totals) const {
    const double least = -(length_tolerance * face.length + rounding_);
    const bool is_divided = face.is_boundary || face.parts > 1;
    for (std::int64_t part = 0; part < face.parts; ++part)
      if (!(face.dual_lengths[static_cast<std::size_t>(part)] >= least))
        ++(is_divided ? totals.outside : totals.negative);
    if (!face.is_boundary)
      totals.shortest_dual = std::min(totals.shortest_dual, face.dual_length() / face.length);
  }

  const Cells& cells_;
  double rounding_;
};

void add(const SiteTotals& part, SiteTotals& sum) {
  sum.parts += part.parts;
  sum.boundary_cells += part.boundary_cells;
  sum.corners += part.corners;
  sum.spokes += part.spokes;
  sum.outside += part.outside;
  sum.negative += part.negative;
  sum.not_positive += part.not_positive;
  sum.most_corners = std::max(sum.most_corners, part.most_corners);
  sum.smallest_area = std::min(sum.smallest_area, part.smallest_area);
  sum.shortest_dual = std::min(sum.shortest_dual, part.shortest_dual);
  sum.areas.add(part.areas);
}

/// Counts over all ranks.
SiteTotals count_sites(const Cells& cells, const AreaSums& no_areas, double rounding, const comm::Communicator& comm) {
  const SiteTotals none(no_areas);
  PerThread<SiteTotals> of_thread(none);
  PerThread<Surroundings> around;
  const SiteCounter counter(cells, rounding);
  thread_loop(cells.site_count, 256, [&](std::ptrdiff_t site, int thread) {
    counter.count(static_cast<LocalIndex>(site), around[thread], of_thread[thread]);
  });
  SiteTotals sum = none;
  for (const SiteTotals& part : of_thread)
    add(part, sum);
  std::array<std::int64_t, 7> counts{sum.parts,   sum.boundary_cells, sum.corners,     sum.spokes,
                                     sum.outside, sum.negative,       sum.not_positive};
  std::array<double, 3> extremes{static_cast<double>(sum.most_corners), -sum.smallest_area, -sum.shortest_dual};
  comm.sum_and_max(counts, extremes);
  sum.areas.sum_over_ranks(comm);
  sum.parts = counts[0];
  sum.boundary_cells = counts[1];
  sum.corners = counts[2];
  sum.spokes = counts[3];
  sum.outside = counts[4];
  sum.negative = counts[5];
  sum.not_positive = counts[6];
  sum.most_corners = static_cast<std::int64_t>(extremes[0]);
  sum.smallest_area = -extremes[1];
  sum.shortest_dual = -extremes[2];
  return sum;
}

/// Areas of the regions by the triangles of the mesh as it is distributed: without the cells.
AreaSums triangle_areas(const mesh::DistributedMesh& mesh, const Cells& cells, AreaSums areas,
                        const comm::Communicator& comm) {
  const auto place = [&](LocalIndex corner) {
    const std::size_t k = at(corner);
    return k < mesh.points.size() ? mesh.points[k] : cells.slab_places[k - mesh.points.size()];
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec2 first = place(a);
    const double twice = cross(difference(place(b), first, cells.period), difference(place(c), first, cells.period));
    areas.add(mesh.region.empty() ? 1 : mesh.region[t], 0.5 * twice);
  }
  areas.sum_over_ranks(comm);
  return areas;
}

mesh::Check zero(const char* name, std::int64_t found, const char* meaning) {
  return {name, 0, static_cast<double>(found), found == 0, meaning};
}

} // namespace

CellProof prove(const mesh::DistributedMesh& mesh, const Cells& cells, std::size_t regions,
                const comm::Communicator& comm) {
  const CoordinateRange range = range_of(cells, comm);
  const AreaSums no_areas(range.box_area, regions);
  const double rounding = 0.5 * coordinate_roundings * std::numeric_limits<double>::epsilon() * range.largest;
  const SiteTotals sites = count_sites(cells, no_areas, rounding, comm);
  const AreaSums triangles = triangle_areas(mesh, cells, no_areas, comm);
  const GlobalId points = mesh.point_slab.total, facets = mesh.facet_slab.total, count = mesh.triangle_slab.total;
  const double area = sites.areas.total(), wanted = triangles.total();
  // Cells: circumcentres, middles of boundary edges and boundary sites; each edge lies in two cells, those on the
  // boundary in one. Triangles have 3 sides each, which they share except on the boundary.
  const std::int64_t vertices = count + facets + sites.boundary_cells;
  const std::int64_t twice_euler = 2 * (vertices + points) - (sites.corners + 2 * sites.boundary_cells);
  const std::int64_t twice_mesh = 2 * (points + count) - (3 * count + facets);
  CellProof proof;
  proof.facts = {points, sites.boundary_cells, sites.parts,        sites.most_corners,
                 area,   sites.smallest_area,  sites.shortest_dual};
  proof.checks = {{"cell_area", wanted, area, std::fabs(area - wanted) <= area_tolerance * wanted,
                   "area of all Voronoi cells; that of the triangles is expected"},
                  zero("cell_region_areas", sites.areas.count_different(triangles),
                       "regions in which the parts of cells have another area than the triangles"),
                  zero("cells_without_area", sites.not_positive, "cells or parts of cells whose area is not positive"),
                  zero("circumcentres_outside", sites.outside,
                       "circumcentres behind a boundary edge, or behind an edge between regions"),
                  zero("negative_dual_edges", sites.negative, "edges inside a region whose two cells overlap"),
                  {"cell_edges", static_cast<double>(3 * count + facets), static_cast<double>(sites.spokes),
                   sites.spokes == 3 * count + facets,
                   "neighbours of all cells; two for each edge of the mesh are expected"},
                  {"cell_euler", 0.5 * static_cast<double>(twice_mesh), 0.5 * static_cast<double>(twice_euler),
                   twice_mesh == twice_euler, "vertices - edges + cells; that of the mesh is expected"}};
  return proof;
}

} // namespace trime::dual
