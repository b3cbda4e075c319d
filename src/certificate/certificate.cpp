// SPDX-License-Identifier: BSD-3-Clause
// The proof that ends every run. It counts everything again from the stars and the boundary, and does not use how the
// mesh was made.
#include "certificate/certificate.hpp"

#include "certificate/boundary_proof.hpp"
#include "certificate/rules.hpp"
#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"
#include "polygon/polygon.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace trime::certificate {
namespace {

using geometry::Vec2;
using polygon::BoundarySite;
using polygon::BoundarySites;
using sites::FlatFan;
using sites::StageView;

/// Numbers and hashes, mergeable by addition.
struct Tallies {
  std::int64_t points = 0, edges = 0, triangles = 0, facets = 0, listings = 0;
  std::uint64_t hash_of_listings = 0, hash_of_triangles = 0, hash_of_written = 0;
  std::uint64_t hash_of_facets = 0, hash_of_written_facets = 0;
  std::uint64_t hash_of_points = 0, hash_of_written_points = 0;
  std::int64_t not_positive = 0, not_delaunay = 0, incomplete = 0, unused = 0, corners = 0, junctions = 0, fixed = 0,
               curve_edges = 0;

  static constexpr std::size_t members = 20;

  /// Calls visit(member) for all members of `counts`.
  template <class Self, class Visit>
  static void for_each_member(Self& counts, const Visit& visit) {
    for (auto* number : {&counts.points, &counts.edges, &counts.triangles, &counts.facets, &counts.listings})
      visit(*number);
    for (auto* hash :
         {&counts.hash_of_listings, &counts.hash_of_triangles, &counts.hash_of_written, &counts.hash_of_facets,
          &counts.hash_of_written_facets, &counts.hash_of_points, &counts.hash_of_written_points})
      visit(*hash);
    for (auto* number : {&counts.not_positive, &counts.not_delaunay, &counts.incomplete, &counts.unused,
                         &counts.corners, &counts.junctions, &counts.fixed, &counts.curve_edges})
      visit(*number);
  }
};
static_assert(sizeof(Tallies) == Tallies::members * sizeof(std::int64_t), "a member is missing in for_each_member");

/// Everything that is counted, mergeable.
struct Counts : Tallies {
  ExactArea area;

  static constexpr std::size_t size = members + 3; // and the parts of the area
  std::array<std::int64_t, size> pack() const {
    std::array<std::int64_t, size> packed{};
    auto next = packed.begin();
    for_each_member(*this, [&](const auto& member) { *next++ = static_cast<std::int64_t>(member); });
    for (const std::int64_t part : area.split())
      *next++ = part;
    return packed;
  }
  static Counts unpack(const std::array<std::int64_t, size>& packed) {
    Counts counts;
    auto next = packed.begin();
    for_each_member(counts, [&]<class T>(T& member) { member = static_cast<T>(*next++); });
    counts.area = ExactArea::join({next[0], next[1], next[2]});
    return counts;
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
std::uint64_t triangle_hash(GlobalId a, GlobalId b, GlobalId c) {
  const GlobalId first = std::min(std::min(a, b), c); // without a branch: nobody can foresee which
  const GlobalId second = first == a ? b : first == b ? c : a, third = first == a ? c : first == b ? a : b;
  const std::uint64_t two =
      static_cast<std::uint64_t>(first) + 0xd6e8feb86659fd93ULL * static_cast<std::uint64_t>(second);
  return mix_bits(mix_bits(two) ^ static_cast<std::uint64_t>(third));
}

std::uint64_t facet_hash(GlobalId first, GlobalId second, std::int32_t tag, std::int32_t part) {
  const auto labels = static_cast<std::uint64_t>((std::int64_t{tag} << 32) + part);
  return mix_bits(mix_bits(mix_bits(static_cast<std::uint64_t>(first)) ^ static_cast<std::uint64_t>(second)) ^ labels);
}

/// Hash of a point as it is written: its number, and its coordinates bit for bit.
std::uint64_t point_hash(GlobalId id, Vec2 p) {
  return mix_bits(mix_bits(mix_bits(static_cast<std::uint64_t>(id)) ^ std::bit_cast<std::uint64_t>(p.x)) ^
                  std::bit_cast<std::uint64_t>(p.y));
}

/// @brief Counts quadruples of points whose last lies inside the circle of the others, many at a time: nearly all are
/// found outside by the float filter.
class CircleTests {
public:
  CircleTests(const geometry::Lattice& lattice, const geometry::Periods& periods)
      : lattice_(lattice), periods_(periods) {}

  void add(Vec2 p, Vec2 q, Vec2 r, Vec2 s) {
    const std::array<Vec2, 4> points{p, q, r, s};
    for (std::size_t k = 0; k < 4; ++k) {
      x_[k][size_] = points[k].x;
      y_[k][size_] = points[k].y;
    }
    if (++size_ == most)
      finish();
  }
  void finish() {
    std::array<double, most> outside;
    for (std::size_t n = 0; n < size_; ++n)
      outside[n] = geometry::in_circle_filter(at(0, n), at(1, n), at(2, n), at(3, n)) < 0 ? 1 : 0;
    for (std::size_t n = 0; n < size_; ++n)
      if (outside[n] == 0)
        inside_ += geometry::in_circle(at(0, n), at(1, n), at(2, n), at(3, n), lattice_, periods_) > 0;
    size_ = 0;
  }
  /// @pre finished
  std::int64_t inside() const { return inside_; }

private:
  static constexpr std::size_t most = 256;
  Vec2 at(std::size_t k, std::size_t n) const { return {x_[k][n], y_[k][n]}; }

  const geometry::Lattice& lattice_;
  const geometry::Periods& periods_;
  std::array<std::array<double, most>, 4> x_, y_;
  std::size_t size_ = 0;
  std::int64_t inside_ = 0;
};

/// Counts at the stars of sites, one after the other.
class StarCounter {
public:
  /// @param junctions places of the corners of the curves, in lexicographic order
  StarCounter(const StageView& view, const decomposition::Numbering& numbering, std::span<const Vec2> junctions)
      : view_(view), numbering_(numbering), junctions_(junctions), points_(view.state.points()), fan_(view, numbering),
        circles_(view.lattice, points_.grid().periods()) {}

  void count(LocalIndex site) {
    fan_.load(site);
    const std::size_t n = fan_.vertices.size();
    ids_.resize(n);
    if (numbering_.foreign.empty())
      std::transform(fan_.vertices.begin(), fan_.vertices.end(), ids_.begin(),
                     [first = numbering_.first](LocalIndex vertex) { return first + vertex; });
    else
      std::transform(fan_.vertices.begin(), fan_.vertices.end(), ids_.begin(),
                     [&](LocalIndex vertex) { return numbering_.global_id(vertex); });
    ++counts_.points;
    counts_.hash_of_points += point_hash(numbering_.global_id(numbering_.vertex(site)), points_.position(site));
    counts_.incomplete += !fan_.complete;
    counts_.unused += fan_.triangles == 0;
    counts_.listings += static_cast<std::int64_t>(fan_.triangles);
    if (points_.boundary(site) != mesh::free_site)
      count_kept(site, points_.boundary(site));
    const LocalIndex own = numbering_.vertex(site);
    for (std::size_t k = 0; k < fan_.edges; ++k)
      counts_.edges += fan_.place[k] > own;
    count_triangles(own, points_.position(site));
  }
  /// The counts so far.
  const Counts& finish() {
    circles_.finish();
    counts_.not_delaunay = circles_.inside();
    return counts_;
  }

private:
  /// Boundary sites and fixed points.
  void count_kept(LocalIndex site, std::int32_t b) {
    const Vec2 p = points_.position(site);
    const bool is_corner = b >= 0 && view_.polygon.sites[at(b)].corner;
    if (b == mesh::fixed_site || is_corner)
      counts_.fixed += std::binary_search(view_.fixed.begin(), view_.fixed.end(), p, geometry::lexicographically_less);
    count_curve_edges(p);
    if (b < 0 || p != view_.polygon.sites[at(b)].position)
      return;
    counts_.corners += is_corner;
    counts_.junctions += std::binary_search(junctions_.begin(), junctions_.end(), p, geometry::lexicographically_less);
    if (!fan_.complete)
      return;
    const BoundarySite& to_next = view_.polygon.sites[at(b)]; // its chord leads to the next boundary site
    ++counts_.facets;
    counts_.hash_of_facets +=
        facet_hash(numbering_.global_id(numbering_.vertex(site)), ids_[0], to_next.tag, to_next.part);
  }

  /// Counts the chords of inner curves that begin here, are edges, and whose open diametral discs hold no third vertex
  /// of their two triangles.
  void count_curve_edges(Vec2 p) {
    const polygon::InnerChords& inner = view_.polygon.inner;
    for (const LocalIndex half : inner.at(p))
      for (std::size_t k = 0; half % 2 == 0 && k < fan_.edges; ++k) {
        if (fan_.positions[k] != inner.other_end(half) || (!fan_.closed && (k == 0 || k == fan_.triangles)))
          continue;
        const Vec2 q = fan_.positions[k], before = fan_.positions[k > 0 ? k - 1 : fan_.triangles - 1];
        counts_.curve_edges +=
            geometry::diametral_side(p, q, before) >= 0 && geometry::diametral_side(p, q, fan_.positions[k + 1]) >= 0;
      }
  }

  void count_triangles(LocalIndex own, Vec2 p) {
    const GlobalId id = numbering_.global_id(own);
    for (std::size_t k = 0; k < fan_.triangles; ++k) {
      const Vec2 q = fan_.positions[k], r = fan_.positions[k + 1];
      const std::uint64_t hash = triangle_hash(id, ids_[k], ids_[k + 1]);
      counts_.hash_of_listings += hash;
      if (fan_.place[k + 1] < own)
        continue;
      if (fan_.place[k] > own) {
        ++counts_.triangles;
        counts_.hash_of_triangles += hash;
        counts_.not_positive += geometry::orient2d(p, q, r) <= 0;
        counts_.area.add_triangle(p, q, r, view_.lattice);
      }
      // The edge to r lies between two triangles: seen from its lower end, once all stars agree on their triangles.
      if (k + 1 < fan_.triangles || fan_.closed)
        circles_.add(p, q, r, fan_.positions[k + 2]);
    }
  }

  const StageView& view_;
  const decomposition::Numbering& numbering_;
  std::span<const Vec2> junctions_;
  const mesh::BinnedPoints& points_;
  FlatFan fan_;
  CircleTests circles_;
  UnsetVector<GlobalId> ids_;
  Counts counts_;
};

/// @brief Where the curves turn by more than this or parts meet, in lexicographic order: corners by the curves alone,
/// whatever their layout says. Every rank holds them, as it does the pieces.
std::vector<Vec2> junctions_of(const geometry::Boundary& curves, double degrees) {
  std::vector<Vec2> places;
  for (const geometry::Loop& loop : curves.loops)
    for (std::size_t i = 0; i < loop.pieces.size(); ++i)
      if (polygon::is_corner(loop, i, degrees + CertificateRules::angle_slack))
        places.push_back(curves.periods.wrap(loop.pieces[i].start));
  std::sort(places.begin(), places.end(), geometry::lexicographically_less);
  return places;
}

/// Counts of this rank, from the stars.
Counts count_stars(const StageView& view, const decomposition::Numbering& numbering, std::span<const Vec2> junctions) {
  const mesh::BinnedPoints& points = view.state.points();
  PerThread<StarCounter> of_thread(view, numbering, junctions);
  thread_loop(points.last_tile() - points.first_tile(), 1, [&](std::ptrdiff_t t, int thread) {
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    StarCounter& counter = of_thread[thread];
    for (LocalIndex i = begin; i < end; ++i)
      counter.count(i);
  });
  Counts counts;
  for (StarCounter& counter : of_thread)
    counts.add(counter.finish());
  return counts;
}

/// Counts of this rank, from the arrays that will be written.
void add_written(const mesh::DistributedMesh& mesh, Counts& counts) {
  counts.hash_of_written = thread_sum(mesh.triangles.size(), [&](std::size_t t) {
    const auto [a, b, c] = mesh.triangle_ids(t);
    return triangle_hash(a, b, c);
  });
  counts.hash_of_written_points = thread_sum(mesh.points.size(), [&](std::size_t i) {
    return point_hash(mesh.point_slab.first + static_cast<GlobalId>(i), mesh.points[i]);
  });
  counts.hash_of_written_facets = thread_sum(mesh.facets.size(), [&](std::size_t k) {
    return facet_hash(mesh.facets[k][0], mesh.facets[k][1], mesh.facet_tags[k], mesh.facet_parts[k]);
  });
}

/// @brief Area on the left of all chords. Each loop is unrolled and counts with the area between it and the line from
/// the first image of its start to the last; in a periodic container the sum is right except for whole images of it.
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

mesh::Check check(const char* name, std::int64_t expected, std::int64_t found, const char* meaning) {
  return {name, static_cast<double>(expected), static_cast<double>(found), expected == found, meaning};
}

/// The checks of the triangles, and of what is to be written.
mesh::Checks triangle_checks(const Counts& counts, const mesh::DistributedMesh& mesh, std::int64_t chords,
                             const Expectation& expectation) {
  const std::int64_t sides = 3 * counts.triangles + chords; // of triangles and facets: odd numbers are wrong, too
  const bool changed = expectation.topology_changed;
  const auto written = [](bool is_same, GlobalId total) { return is_same ? total : -1; };
  return {
      check("incomplete_fans", 0, counts.incomplete, "points whose triangles do not form one fan without gaps"),
      check("star_listings", 3 * counts.triangles, counts.listings,
            "entries in the triangle lists of all points; each triangle is listed by its three vertices"),
      check("star_disagreements", 0, 3 * counts.hash_of_triangles != counts.hash_of_listings,
            "0 if the three vertices of each triangle list the same triangle, otherwise 1"),
      check("written_points", counts.points,
            written(counts.hash_of_written_points == counts.hash_of_points, mesh.point_slab.total),
            "points in the written arrays, if equal to the points checked here bit for bit and in order; otherwise -1"),
      check("written_triangles", counts.triangles,
            written(counts.hash_of_written == counts.hash_of_triangles, mesh.triangle_slab.total),
            "triangles in the written arrays, if equal to the triangles checked here; otherwise -1"),
      check("written_facets", chords,
            written(counts.hash_of_written_facets == counts.hash_of_facets, mesh.facet_slab.total),
            "facets in the written arrays, if they and their tags equal those checked here; otherwise -1"),
      check("not_positive", 0, counts.not_positive, "triangles that are not counter-clockwise"),
      check(
          "euler_characteristic", (changed ? expectation.meshed : expectation.shape).euler_characteristic(),
          counts.points - counts.edges + counts.triangles,
          changed
              ? "points - edges + triangles; expected: components minus holes of the simplified shape (if not periodic)"
              : "points - edges + triangles; expected: components minus holes of the given shape (if not periodic)"),
      {"edge_count", 0.5 * static_cast<double>(sides), static_cast<double>(counts.edges), sides == 2 * counts.edges,
       "edges of the mesh; each inner edge has two triangles, each facet one"},
      check("not_delaunay", 0, counts.not_delaunay, "edges that are not locally Delaunay (exact test)"),
      check("boundary_segments", chords, counts.facets,
            "segments between neighbouring boundary points that are edges of the mesh")};
}

/// Adds the checks of the points that the mesh must have, and of its area.
void add_point_checks(const Counts& counts, const StageView& view, std::int64_t junctions, mesh::Checks& checks) {
  checks.push_back(
      check("corners", view.polygon.corners, counts.corners,
            "corners that are vertices of the mesh, with equal bits after rounding to the coordinate lattice"));
  const std::int64_t kept = junctions - view.polygon.left_out;
  checks.push_back(
      {"turns_kept", static_cast<double>(std::max<std::int64_t>(0, kept)), static_cast<double>(counts.junctions),
       counts.junctions >= kept,
       "vertices at turns above corner_angle and where parts meet; at least all such places minus corners left out"});
  if (!view.fixed.empty())
    checks.push_back(
        check("fixed_points", static_cast<std::int64_t>(view.fixed.size()), counts.fixed,
              "fixed points that are vertices of the mesh, with equal bits after rounding to the coordinate lattice"));
  if (const polygon::InnerChords& inner = view.polygon.inner; !inner.empty())
    checks.push_back(check("curve_edges", std::ssize(inner.chords), counts.curve_edges,
                           "chords of the curves inside that are edges of two triangles, with angles of at most 90 "
                           "degrees opposite to them"));
  checks.push_back(check("unused_points", 0, counts.unused, "points without a triangle"));
  const ExactArea polygon = polygon_area(view.polygon, view.lattice);
  checks.push_back({"area", polygon.value(view.lattice), counts.area.value(view.lattice),
                    polygon.twice == counts.area.twice,
                    "area of all triangles; expected is the area inside the facets (exact integers)"});
}

} // namespace

mesh::Checks certify(const StageView& view, const decomposition::Numbering& numbering, const Expectation& expectation,
                     const mesh::DistributedMesh& mesh) {
  const std::vector<Vec2> junctions = junctions_of(expectation.meshed, expectation.corner_angle);
  Counts counts = count_stars(view, numbering, junctions);
  add_written(mesh, counts);
  auto packed = counts.pack();
  view.state.comm().sum(packed);
  counts = Counts::unpack(packed);

  mesh::Checks checks = triangle_checks(counts, mesh, std::ssize(view.polygon.sites), expectation);
  add_point_checks(counts, view, std::ssize(junctions), checks);
  const BoundaryTruth truth{
      expectation.shape,      expectation.meshed, view.polygon,     view.size,
      expectation.asked,      view.lattice,       expectation.side, counts.area.value(view.lattice),
      expectation.coarseness, expectation.within};
  for (mesh::Check& proof : prove_boundary(truth, mesh, view.state.comm()))
    checks.push_back(std::move(proof));
  return checks;
}

} // namespace trime::certificate
