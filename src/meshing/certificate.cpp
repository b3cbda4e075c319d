// SPDX-License-Identifier: BSD-3-Clause
// The proof that ends every run. What is counted here comes from the stars and the boundary anew, not from the way in
// which the mesh was made.
#include "meshing/boundary_proof.hpp"
#include "meshing/extraction.hpp"

#include "trime/core/random.hpp"
#include "trime/core/thread_loop.hpp"
#include "trime/geometry/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;
__extension__ using Int128 = __int128;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

/// Twice an area in squared lattice steps: exact, also over ranks (in three parts of 40 bits and the rest).
struct ExactArea {
  Int128 twice = 0;

  void add_triangle(Vec2 p, Vec2 q, Vec2 r, const geometry::Lattice& lattice) {
    const Int128 ux = lattice.steps(q.x - p.x), uy = lattice.steps(q.y - p.y);
    const Int128 vx = lattice.steps(r.x - p.x), vy = lattice.steps(r.y - p.y);
    twice += ux * vy - uy * vx;
  }
  std::array<std::int64_t, 3> split() const {
    constexpr Int128 mask = (Int128{1} << 40) - 1;
    return {static_cast<std::int64_t>(twice & mask), static_cast<std::int64_t>((twice >> 40) & mask),
            static_cast<std::int64_t>(twice >> 80)};
  }
  static ExactArea join(const std::array<std::int64_t, 3>& parts) {
    return {(Int128{parts[2]} << 80) + (Int128{parts[1]} << 40) + parts[0]};
  }
  double value(const geometry::Lattice& lattice) const {
    return 0.5 * static_cast<double>(twice) * lattice.step() * lattice.step();
  }
};

/// Everything that is counted, mergeable.
struct Counts {
  std::int64_t points = 0, edges = 0, triangles = 0, facets = 0, listings = 0;
  std::int64_t hash_of_listings = 0, hash_of_triangles = 0, hash_of_written = 0; // mod 2^64
  std::int64_t hash_of_facets = 0, hash_of_written_facets = 0;
  std::int64_t not_positive = 0, not_delaunay = 0, incomplete = 0, unused = 0, corners = 0;
  ExactArea area;

  static constexpr std::size_t size = 18;
  std::array<std::int64_t, size> pack() const {
    const auto parts = area.split();
    return {points,
            edges,
            triangles,
            facets,
            listings,
            hash_of_listings,
            hash_of_triangles,
            hash_of_written,
            hash_of_facets,
            hash_of_written_facets,
            not_positive,
            not_delaunay,
            incomplete,
            unused,
            corners,
            parts[0],
            parts[1],
            parts[2]};
  }
  static Counts unpack(const std::array<std::int64_t, size>& p) {
    Counts c{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10], p[11], p[12], p[13], p[14], {}};
    c.area = ExactArea::join({p[15], p[16], p[17]});
    return c;
  }
  void add(const Counts& other) {
    auto sum = pack();
    const auto more = other.pack();
    for (std::size_t k = 0; k < size; ++k)
      sum[k] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum[k]) + static_cast<std::uint64_t>(more[k]));
    *this = unpack(sum);
  }
};

/// Hash of a triangle that does not depend on the vertex from which it is seen.
std::int64_t triangle_hash(GlobalId a, GlobalId b, GlobalId c) {
  if (b < a && b < c) {
    std::swap(a, b);
    std::swap(b, c);
  } else if (c < a && c < b) {
    std::swap(a, c);
    std::swap(b, c);
  }
  return static_cast<std::int64_t>(
      mix_bits(mix_bits(mix_bits(static_cast<std::uint64_t>(a)) ^ static_cast<std::uint64_t>(b)) ^
               static_cast<std::uint64_t>(c)));
}

std::int64_t facet_hash(GlobalId first, GlobalId second, std::int32_t tag, std::int32_t part) {
  const auto labels = static_cast<std::uint64_t>((std::int64_t{tag} << 32) + part);
  return static_cast<std::int64_t>(
      mix_bits(mix_bits(mix_bits(static_cast<std::uint64_t>(first)) ^ static_cast<std::uint64_t>(second)) ^ labels));
}

std::int64_t wrapping_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

void count_site(const ExtractionContext& context, const std::vector<GlobalId>& ids, LocalIndex i, Counts& counts) {
  const mesh::BinnedPoints& points = context.state.points();
  const Fan fan = inside_fan(context, i);
  const Vec2 p = points.position(i);
  const std::int32_t b = points.boundary(i);
  ++counts.points;
  counts.incomplete += !fan.complete;
  counts.unused += fan.triangles == 0;
  if (b >= 0) {
    const BoundarySite& site = context.boundary.sites[at(b)];
    counts.corners += site.corner && p == site.position;
    if (fan.complete && p == site.position) { // the segment to the next boundary site
      ++counts.facets;
      counts.hash_of_facets =
          wrapping_sum(counts.hash_of_facets, facet_hash(ids[at(i)], ids[at(fan.neighbour(0))], site.tag, site.part));
    }
  }
  for (std::size_t k = 0; k < fan.triangles; ++k) {
    const LocalIndex u = fan.neighbour(k), v = fan.neighbour(k + 1);
    const Vec2 q = points.position(u), r = points.position(v);
    const std::int64_t hash = triangle_hash(ids[at(i)], ids[at(u)], ids[at(v)]);
    ++counts.listings;
    counts.hash_of_listings = wrapping_sum(counts.hash_of_listings, hash);
    if (ids[at(i)] < ids[at(u)] && ids[at(i)] < ids[at(v)]) {
      ++counts.triangles;
      counts.hash_of_triangles = wrapping_sum(counts.hash_of_triangles, hash);
      counts.not_positive += geometry::orient2d(p, q, r) <= 0;
      counts.area.add_triangle(p, q, r, context.lattice);
    }
    if (k + 1 < fan.triangles || fan.closed) { // the edge to v lies between two triangles
      const Vec2 s = points.position(fan.neighbour(k + 2));
      counts.not_delaunay += geometry::in_circle(p, q, r, s, context.lattice, points.grid().periods()) > 0;
    }
  }
  for (std::size_t k = 0; fan.complete && k < fan.edges(); ++k)
    counts.edges += ids[at(i)] < ids[at(fan.neighbour(k))];
}

/// @brief Area on the left of all chords. Each loop is unrolled and counts with the area between it and the line from
/// the first image of its start to the last; in a periodic container the sum is right but for whole images of it.
ExactArea polygon_area(const BoundarySites& boundary, const geometry::Lattice& lattice) {
  const geometry::Periods& periods = boundary.periods;
  ExactArea area;
  for (std::size_t loop = 0; loop + 1 < boundary.loop_start.size(); ++loop) {
    const Vec2 origin = boundary.sites[at(boundary.loop_start[loop])].position;
    Vec2 from = origin;
    for (LocalIndex k = boundary.loop_start[loop]; k < boundary.loop_start[loop + 1]; ++k) {
      const geometry::Segment chord = boundary.chord(k);
      const Vec2 to = from + (chord.b - chord.a);
      area.add_triangle(origin, from, to, lattice);
      from = to;
    }
    if (from != origin) { // it winds: the sum over all loops does not depend on the corner that is chosen here
      area.add_triangle(periods.min, origin, from, lattice);
      area.add_triangle(periods.min, origin, from, lattice);
    }
  }
  if (periods.x > 0 && periods.y > 0) {
    const Int128 torus = Int128{2} * lattice.steps(periods.x) * lattice.steps(periods.y);
    area.twice = (area.twice % torus + torus) % torus;
    if (area.twice == 0)
      area.twice = torus;
  }
  return area;
}

/// Owned sites that are fixed points, where they were asked for. Collective.
std::int64_t count_fixed(const ExtractionContext& context) {
  const mesh::BinnedPoints& points = context.state.points();
  std::int64_t found = 0;
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    const std::int32_t b = points.boundary(i);
    if (b == mesh::fixed_site || (b >= 0 && context.boundary.sites[at(b)].corner))
      found += std::binary_search(context.fixed.begin(), context.fixed.end(), points.position(i),
                                  geometry::lexicographically_less);
  }
  return context.state.comm().sum(found);
}

mesh::Check check(const char* name, std::int64_t expected, std::int64_t found, const char* meaning) {
  return {name, static_cast<double>(expected), static_cast<double>(found), expected == found, meaning};
}

} // namespace

mesh::Checks certify(const ExtractionContext& context, const decomposition::Numbering& numbering,
                     const Expectation& expectation, const mesh::DistributedMesh& mesh) {
  const mesh::BinnedPoints& points = context.state.points();
  std::vector<Counts> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  thread_loop(points.owned(), 4096, [&](std::ptrdiff_t i, int thread) {
    count_site(context, numbering.global_ids, static_cast<LocalIndex>(i), of_thread[static_cast<std::size_t>(thread)]);
  });
  Counts counts;
  for (const Counts& c : of_thread)
    counts.add(c);
  for (const auto& triangle : mesh.triangles)
    counts.hash_of_written = wrapping_sum(counts.hash_of_written, triangle_hash(triangle[0], triangle[1], triangle[2]));
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    counts.hash_of_written_facets =
        wrapping_sum(counts.hash_of_written_facets,
                     facet_hash(mesh.facets[k][0], mesh.facets[k][1], mesh.facet_tags[k], mesh.facet_parts[k]));
  auto packed = counts.pack();
  context.state.comm().sum(packed);
  counts = Counts::unpack(packed);

  const std::int64_t segments = static_cast<std::int64_t>(context.boundary.sites.size());
  const ExactArea polygon = polygon_area(context.boundary, context.lattice);
  const std::int64_t hash_of_thrice =
      wrapping_sum(counts.hash_of_triangles, wrapping_sum(counts.hash_of_triangles, counts.hash_of_triangles));
  mesh::Checks checks;
  checks.push_back(
      check("incomplete_fans", 0, counts.incomplete, "manifold: each site has one unbroken fan of triangles"));
  checks.push_back(
      check("star_listings", 3 * counts.triangles, counts.listings, "every triangle is listed by its three stars"));
  checks.push_back(
      check("star_disagreements", 0, hash_of_thrice != counts.hash_of_listings, "and all three list the same one"));
  checks.push_back(check("written_triangles", counts.triangles,
                         counts.hash_of_written == counts.hash_of_triangles ? mesh.triangle_slab.total : -1,
                         "the triangles to be written are these"));
  checks.push_back(check("written_facets", segments,
                         counts.hash_of_written_facets == counts.hash_of_facets ? mesh.facet_slab.total : -1,
                         "the boundary edges to be written are these, with their tags"));
  checks.push_back(check("not_positive", 0, counts.not_positive, "triangles that are not counter-clockwise"));
  checks.push_back(check("euler_characteristic", expectation.meshed.euler_characteristic(),
                         counts.points - counts.edges + counts.triangles,
                         "of the shape; in the plane components minus holes"));
  checks.push_back(check("edge_count", (3 * counts.triangles + segments) / 2, counts.edges,
                         "inner edges have two triangles, boundary edges one"));
  checks.push_back(check("not_delaunay", 0, counts.not_delaunay, "edges that are not locally Delaunay (exact test)"));
  checks.push_back(check("boundary_segments", segments, counts.facets, "boundary segments that are edges of the mesh"));
  checks.push_back(check("corners", context.boundary.corners, counts.corners,
                         "corners that are vertices, bit for bit on the lattice"));
  if (!context.fixed.empty())
    checks.push_back(check("fixed_points", static_cast<std::int64_t>(context.fixed.size()), count_fixed(context),
                           "fixed points that are vertices, bit for bit on the lattice"));
  checks.push_back(check("unused_points", 0, counts.unused, "points without a triangle"));
  checks.push_back({"area", polygon.value(context.lattice), counts.area.value(context.lattice),
                    polygon.twice == counts.area.twice, "triangles fill the boundary polygon (exact integers)"});
  const BoundaryTruth truth{expectation.shape,
                            expectation.meshed,
                            context.boundary,
                            context.size,
                            context.lattice,
                            expectation.side,
                            counts.area.value(context.lattice)};
  for (mesh::Check& proof : prove_boundary(truth, mesh, context.state.comm()))
    checks.push_back(std::move(proof));
  return checks;
}

} // namespace trime::meshing
