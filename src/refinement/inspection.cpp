// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/inspection.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"
#include "refinement/boundary_walk.hpp"
#include "refinement/edge_table.hpp"
#include "trime/core/error.hpp"
#include "trime/handover/local_mesh.hpp"

#include <algorithm>
#include <array>

namespace trime::refinement {
namespace {

using certificate::ExactArea;
using geometry::Vec2;

/// Numbers of all ranks, which are sums of those of each rank.
struct Counts {
  std::int64_t points = 0, triangles = 0, edges = 0, listings = 0, segments = 0;
  std::int64_t not_positive = 0, not_delaunay = 0, incomplete = 0, unused = 0, corners = 0, fixed_inside = 0,
               interfaces = 0;
  ExactArea area;

  void add(const comm::Communicator& comm) {
    const std::array<std::int64_t*, 12> members{&points,   &triangles,    &edges,        &listings,
                                                &segments, &not_positive, &not_delaunay, &incomplete,
                                                &unused,   &corners,      &fixed_inside, &interfaces};
    std::array<std::int64_t, members.size() + 3> sums;
    std::ranges::transform(members, sums.begin(), [](const std::int64_t* member) { return *member; });
    std::ranges::copy(area.split(), sums.begin() + members.size());
    comm.sum(sums);
    for (std::size_t k = 0; k < members.size(); ++k)
      *members[k] = sums[k];
    area = ExactArea::join({sums[members.size()], sums[members.size() + 1], sums[members.size() + 2]});
  }
};

/// One rank's part of a mesh, joined from the arrays.
class Inspector {
public:
  Inspector(const comm::Communicator& comm, const geometry::Frame& frame, mesh::DistributedMesh& mesh)
      : comm_(comm), frame_(frame), mesh_(mesh), local_(handover::make_local_mesh(comm, mesh)), edges_(local_) {
    sizes_.resize(local_.points.size());
    std::ranges::copy(mesh.size, sizes_.begin());
    handover::update_ghosts(comm, local_, sizes_);
  }

  BoundaryWalk walk() const;
  Counts count() const;
  std::vector<RegionSum> region_sums() const; ///< of all ranks
  mesh::QualitySummary measure(const BoundaryWalk& walk);

private:
  std::array<Vec2, 3> corners(LocalIndex triangle) const {
    const auto& [a, b, c] = local_.triangles[at(triangle)];
    return {local_.points[at(a)], near(b, a), near(c, a)};
  }
  Vec2 near(LocalIndex point, LocalIndex other) const {
    return frame_.periods().nearest_image(local_.points[at(point)], local_.points[at(other)]);
  }
  bool is_delaunay(LocalIndex edge) const;
  void count_points(Counts& counts) const;
  std::int64_t count_segments() const;
  std::int64_t count_interfaces() const;

  const comm::Communicator& comm_;
  const geometry::Frame& frame_;
  mesh::DistributedMesh& mesh_;
  const handover::LocalMesh local_;
  const EdgeTable edges_;
  std::vector<double> sizes_; // of all local points
};

/// Every rank gets all boundary edges: as a run holds the sites of the boundary.
BoundaryWalk Inspector::walk() const {
  std::vector<PlacedFacet> facets;
  for (LocalIndex k = 0; k < local_.owned_facets; ++k) {
    const auto [a, b] = local_.facets[at(k)];
    facets.push_back({local_.global_id(a), local_.global_id(b), local_.points[at(a)], local_.points[at(b)],
                      local_.facet_tags[at(k)], local_.facet_parts[at(k)]});
  }
  std::vector<GlobalId> corners;
  for (std::size_t i = 0; i < mesh_.points.size(); ++i)
    if (mesh_.fixed[i] != 0 && mesh_.boundary[i] != 0)
      corners.push_back(mesh_.point_slab.first + static_cast<GlobalId>(i));
  facets = comm::gather_everywhere(comm_, std::move(facets));
  corners = comm::gather_everywhere(comm_, std::move(corners)); // ascending, as the points of the ranks are
  return walk_along(std::move(facets), corners, frame_);
}

bool Inspector::is_delaunay(LocalIndex edge) const {
  const auto& [left, right] = edges_.triangles(edge);
  if (left < 0 || right < 0)
    return true;
  const std::array<Vec2, 3> p = corners(left);
  const std::size_t j = edges_.place_in(left, edge), k = edges_.place_in(right, edge);
  const Vec2 beyond = frame_.periods().nearest_image(local_.points[at(local_.triangles[at(right)][(k + 2) % 3])], p[j]);
  return geometry::orient2d(p[0], p[1], p[2]) <= 0 ||
         !geometry::is_inside_circle(p[0], p[1], p[2], beyond, frame_.lattice());
}

/// At a point inside there are as many edges as triangles, on the boundary one more, two of them with one triangle.
void Inspector::count_points(Counts& counts) const {
  struct Fan {
    std::int32_t triangles = 0, edges = 0, ends = 0;
  };
  std::vector<Fan> fans(mesh_.points.size());
  const auto is_owned = [&](LocalIndex point) { return point < local_.owned_points; };
  for (const std::array<LocalIndex, 3>& triangle : local_.triangles)
    for (const LocalIndex point : triangle)
      if (is_owned(point))
        ++fans[at(point)].triangles;
  for (LocalIndex edge = 0; edge < edges_.size(); ++edge)
    for (const LocalIndex point : {edges_.lower(edge), edges_.upper(edge)})
      if (is_owned(point)) {
        ++fans[at(point)].edges;
        fans[at(point)].ends += edges_.triangles(edge)[1] == -1;
      }
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const Fan& fan = fans[i];
    const bool is_closed = fan.edges == fan.triangles && fan.ends == 0;
    const bool is_open = fan.edges == fan.triangles + 1 && fan.ends == 2;
    counts.incomplete += !is_closed && !is_open;
    counts.unused += fan.triangles == 0;
    counts.listings += fan.triangles;
    counts.corners += mesh_.fixed[i] != 0 && mesh_.boundary[i] != 0;
    counts.fixed_inside += mesh_.fixed[i] != 0 && mesh_.boundary[i] == 0;
  }
}

/// Facets that are edges of one triangle, which lies on their left.
std::int64_t Inspector::count_segments() const {
  std::int64_t count = 0;
  for (std::size_t k = 0; k < local_.facets.size(); ++k) {
    const auto [a, b] = local_.facets[k];
    const LocalIndex edge = edges_.find(a, b);
    if (edge < 0 || edge >= edges_.owned() || edges_.triangles(edge)[1] != -1)
      continue;
    const LocalIndex triangle = edges_.triangles(edge)[0];
    count += local_.triangles[at(triangle)][edges_.place_in(triangle, edge)] == a;
  }
  return count;
}

Counts Inspector::count() const {
  Counts counts;
  counts.points = local_.owned_points;
  counts.triangles = local_.owned_triangles;
  counts.edges = edges_.owned();
  counts.segments = count_segments();
  count_points(counts);
  for (LocalIndex t = 0; t < local_.owned_triangles; ++t) {
    const std::array<Vec2, 3> p = corners(t);
    counts.not_positive += geometry::orient2d(p[0], p[1], p[2]) <= 0;
    counts.area.add_triangle(p[0], p[1], p[2], frame_.lattice());
  }
  counts.not_delaunay =
      static_cast<std::int64_t>(thread_sum(at(edges_.owned()), [&](std::size_t edge) -> std::uint64_t {
        return is_delaunay(static_cast<LocalIndex>(edge)) ? 0 : 1;
      }));
  counts.interfaces = count_interfaces();
  counts.add(comm_);
  return counts;
}

std::int64_t Inspector::count_interfaces() const {
  if (local_.regions.empty())
    return 0;
  std::int64_t count = 0;
  for (LocalIndex edge = 0; edge < edges_.owned(); ++edge) {
    const auto& [one, other] = edges_.triangles(edge);
    count += one >= 0 && other >= 0 && local_.regions[at(one)] != local_.regions[at(other)];
  }
  return count;
}

std::vector<RegionSum> Inspector::region_sums() const {
  const auto region = [&](LocalIndex t) { return local_.regions.empty() ? 1 : local_.regions[at(t)]; };
  std::int64_t last = 1;
  for (LocalIndex t = 0; t < local_.owned_triangles; ++t)
    last = std::max<std::int64_t>(last, region(t));
  const auto regions = static_cast<std::size_t>(comm_.max(last));
  std::vector<ExactArea> areas(regions);
  std::vector<std::int64_t> sums(4 * regions); // triangles, then the area in three parts
  for (LocalIndex t = 0; t < local_.owned_triangles; ++t) {
    const std::array<Vec2, 3> p = corners(t);
    areas[at(region(t) - 1)].add_triangle(p[0], p[1], p[2], frame_.lattice());
    ++sums[4 * at(region(t) - 1)];
  }
  for (std::size_t k = 0; k < regions; ++k)
    std::ranges::copy(areas[k].split(), sums.begin() + static_cast<std::ptrdiff_t>(4 * k + 1));
  comm_.sum(sums);
  std::vector<RegionSum> made;
  for (std::size_t k = 0; k < 4 * regions; k += 4)
    made.push_back({sums[k], ExactArea::join({sums[k + 1], sums[k + 2], sums[k + 3]}).value(frame_.lattice())});
  return made;
}

mesh::QualitySummary Inspector::measure(const BoundaryWalk& walk) {
  TRIME_ASSERT(local_.owned_triangles == static_cast<LocalIndex>(mesh_.triangles.size()),
               "{} triangles of the array belong to the points of this rank, expected {}", local_.owned_triangles,
               mesh_.triangles.size());
  const geometry::Periods& periods = frame_.periods();
  const extraction::SharpCorners sharp(walk.corners, periods);
  constexpr LocalIndex chunk = 1 << 14;
  const auto run = [&](LocalIndex count, const auto& work) {
    thread_loop((count + chunk - 1) / chunk, 1, [&](std::ptrdiff_t item, int thread) {
      const auto first = static_cast<LocalIndex>(item * chunk);
      work(first, std::min(count, first + chunk), thread);
    });
  };
  PerThread<extraction::QualityMeter> meters(periods, sharp);
  mesh_.alpha.resize(mesh_.triangles.size());
  mesh_.beta.resize(mesh_.triangles.size());
  run(local_.owned_triangles, [&](LocalIndex first, LocalIndex last, int thread) {
    extraction::QualityMeter& meter = meters[thread];
    meter.write_to(std::span(mesh_.alpha).subspan(at(first)), std::span(mesh_.beta).subspan(at(first)));
    for (LocalIndex t = first; t < last; ++t) {
      const std::array<Vec2, 3> p = corners(t);
      meter.add_triangle(p[0], p[1], p[2]);
    }
    meter.finish();
  });
  run(edges_.owned(), [&](LocalIndex first, LocalIndex last, int thread) {
    for (LocalIndex edge = first; edge < last; ++edge) {
      const LocalIndex a = edges_.lower(edge), b = edges_.upper(edge);
      meters[thread].add_edge(local_.points[at(a)], near(b, a), sizes_[at(a)], 0.5 * (sizes_[at(a)] + sizes_[at(b)]));
    }
    meters[thread].finish();
  });
  auto meter = meters.begin();
  extraction::QualitySums& sums = (*meter).sums();
  while ((++meter) != meters.end())
    sums.add((*meter).sums());
  return extraction::summarize(comm_, sums);
}

mesh::Check check(const char* name, std::int64_t expected, std::int64_t found, const char* meaning) {
  return {name, static_cast<double>(expected), static_cast<double>(found), expected == found, meaning};
}

mesh::Checks checks_of(const Counts& counts, const BoundaryWalk& walk, const ExpectedCounts& expected,
                       const mesh::DistributedMesh& mesh, const geometry::Lattice& lattice) {
  const std::int64_t sides = 3 * counts.triangles + mesh.facet_slab.total;
  mesh::Checks checks{
      check("incomplete_fans", 0, counts.incomplete, "points whose triangles do not form one fan without gaps"),
      check("star_listings", 3 * counts.triangles, counts.listings,
            "entries in the triangle lists of all points; each triangle is listed by its three vertices"),
      check("written_points", expected.points, mesh.point_slab.total,
            "points in the written arrays; expected: points plus edges of the mesh that was refined"),
      check("written_triangles", expected.triangles, mesh.triangle_slab.total,
            "triangles in the written arrays; expected: four times those of the mesh that was refined"),
      check("written_facets", expected.facets, mesh.facet_slab.total,
            "facets in the written arrays; expected: twice those of the mesh that was refined"),
      check("not_positive", 0, counts.not_positive, "triangles that are not counter-clockwise"),
      check("euler_characteristic", expected.euler_characteristic, counts.points - counts.edges + counts.triangles,
            "points - edges + triangles; expected is that of the mesh that was refined"),
      {"edge_count", 0.5 * static_cast<double>(sides), static_cast<double>(counts.edges), sides == 2 * counts.edges,
       "edges of the mesh; each inner edge has two triangles, each facet one"},
      check("not_delaunay", 0, counts.not_delaunay, "edges that are not locally Delaunay (exact test)"),
      check("boundary_segments", expected.facets, counts.segments,
            "facets that are edges of one triangle of the mesh, on their left"),
      check("corners", expected.corners, counts.corners,
            "corners that are vertices of the mesh; expected is the number in the mesh that was refined"),
      check("unused_points", 0, counts.unused, "points without a triangle"),
      {"area", walk.area.value(lattice), counts.area.value(lattice), walk.area.twice == counts.area.twice,
       "area of all triangles; expected is the area inside the facets (exact integers)"},
      check("irregular_boundary_points", 0, walk.irregular,
            "boundary points at which not exactly one facet ends and one begins"),
      check("boundary_cycles", walk.tags, std::ssize(walk.loops),
            "expected: different tags of facets; found: closed cycles of facets"),
      check("foreign_tags", 0, walk.changes, "points at which the tag of the facets changes")};
  if (expected.fixed_inside > 0)
    checks.push_back(check("fixed_points", expected.fixed_inside, counts.fixed_inside,
                           "fixed points inside that are vertices; expected is the number in the refined mesh"));
  if (expected.interfaces > 0 || counts.interfaces > 0)
    checks.push_back(check("interfaces", expected.interfaces, counts.interfaces,
                           "edges between triangles of different regions; expected: twice the interfaces of the mesh "
                           "that was refined"));
  return checks;
}

} // namespace

Inspection inspect(const comm::Communicator& comm, const geometry::Frame& frame, const ExpectedCounts& expected,
                   mesh::DistributedMesh& mesh) {
  Inspector inspector(comm, frame, mesh);
  BoundaryWalk walk = inspector.walk();
  if (mesh.facet_slab.total == 0) // a torus without holes
    walk.area.twice =
        certificate::Int128{2} * frame.lattice().steps(frame.periods().x) * frame.lattice().steps(frame.periods().y);
  const Counts counts = inspector.count();
  return {inspector.measure(walk), checks_of(counts, walk, expected, mesh, frame.lattice()), std::move(walk.loops),
          inspector.region_sums()};
}

} // namespace trime::refinement
