// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/boundary_proof.hpp"

#include "certificate/rules.hpp"
#include "core/thread_loop.hpp"
#include "polygon/chord_curve.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace trime::certificate {
namespace {

using geometry::Vec2;
using polygon::area_of_loops;
using polygon::BoundarySite;
using polygon::ChordCurve;
using polygon::compare_chords;

/// Largest distance of a boundary vertex from the curve: of those written, from the nearest piece of it; of those laid
/// out, from their places on it. Collective.
double vertex_distance(const BoundaryTruth& truth, const std::vector<ChordCurve>& chords,
                       const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  const geometry::PieceTree pieces(truth.meshed);
  PerThread<double> of_thread(0);
  thread_loop(static_cast<std::ptrdiff_t>(mesh.points.size()), 4096, [&](std::ptrdiff_t item, int thread) {
    const auto k = static_cast<std::size_t>(item);
    double& largest = of_thread[thread];
    if (mesh.boundary[k] > 0)
      largest = std::max(largest, pieces.distance(mesh.points[k]));
  });
  double largest = 0;
  for (const double one : of_thread)
    largest = std::max(largest, one);
  for (const ChordCurve& chord : chords)
    largest = std::max(largest, chord.offset);
  return comm.max(largest);
}

/// Largest distance of the curves that were meshed from the shape, over the h for which they were simplified.
double generalisation(const BoundaryTruth& truth) {
  const geometry::PieceTree given(truth.shape);
  PerThread<double> of_thread(0);
  for (const geometry::Loop& loop : truth.meshed.loops)
    thread_loop(std::ssize(loop.pieces), 256, [&](std::ptrdiff_t k, int thread) {
      const geometry::Piece& piece = loop.pieces[static_cast<std::size_t>(k)];
      for (const Vec2 p : {piece.start, piece.point(0.5 * piece.length())})
        of_thread[thread] =
            std::max(of_thread[thread], given.distance(p) / truth.asked.size(truth.meshed.periods.wrap(p)));
    });
  double largest = 0;
  for (const double one : of_thread)
    largest = std::max(largest, one);
  return largest / truth.coarseness;
}

/// Corner sites that are a vertex of the shape, bit for bit.
std::int64_t corners_in_place(const BoundaryTruth& truth) {
  std::int64_t count = 0;
  for (std::size_t loop = 0; loop < truth.meshed.loops.size(); ++loop)
    for (LocalIndex k = truth.sites.loop_start[loop]; k < truth.sites.loop_start[loop + 1]; ++k) {
      const BoundarySite& site = truth.sites.sites[at(k)];
      const Vec2 vertex = truth.meshed.loops[loop].pieces[at(site.piece)].start;
      count += site.corner && site.along == 0 && site.position == truth.meshed.periods.wrap(vertex);
    }
  return count;
}

/// The chords against their curves.
struct ChordExtremes {
  double deviation = 0; ///< largest, over the h that was asked for
  double of_arcs = 0;   ///< largest of a chord of a circle, over what a good one has
  double area = 0;      ///< that all chords take from the shape
};

ChordExtremes extremes_of(const BoundaryTruth& truth, const std::vector<ChordCurve>& chords) {
  ChordExtremes extremes;
  for (LocalIndex k = 0; k < std::ssize(truth.sites.sites); ++k) {
    const ChordCurve& curve = chords[at(k)];
    const geometry::Segment chord = truth.sites.chord(k);
    const BoundarySite& next = truth.sites.sites[at(truth.sites.sites[at(k)].next)];
    const double h = 0.5 * (truth.size.size(chord.a) + truth.size.size(next.position));
    const double sagitta = squared_length(chord.b - chord.a) * curve.curvature / 8;
    const double asked = 0.5 * (truth.asked.size(chord.a) + truth.asked.size(next.position));
    extremes.deviation = std::max(extremes.deviation, curve.deviation / asked);
    if (curve.curvature > 0)
      extremes.of_arcs = std::max(extremes.of_arcs, curve.deviation / (CertificateRules::arc_tolerance * sagitta +
                                                                       CertificateRules::arc_slack * h));
    extremes.area += curve.area;
  }
  return extremes;
}

/// @brief Area of the mesh, with what its chords take from the shape, against that of the shape: over the latter.
double area_residual(const BoundaryTruth& truth, double chord_area, double shape_area) {
  const geometry::Periods& periods = truth.meshed.periods;
  const double torus = periods.x * periods.y;
  double residual = truth.mesh_area + chord_area - shape_area;
  if (torus > 0) // areas inside loops are known up to whole areas of the torus
    residual -= torus * std::round(residual / torus);
  return std::fabs(residual) / shape_area;
}

/// Over all ranks. Collective.
CycleCounts cycles_of(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  std::vector<TaggedFacet> facets;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    facets.push_back({mesh.facets[k][0], mesh.facets[k][1], mesh.facet_tags[k]});
  std::vector<TaggedFacet> all;
  for (const comm::Message& message : comm.exchange_any({{0, comm::to_bytes<TaggedFacet>(facets)}})) {
    const auto part = comm::from_bytes<TaggedFacet>(message.data);
    all.insert(all.end(), part.begin(), part.end());
  }
  const CycleCounts counts = count_cycles(std::move(all)); // nothing but on rank 0
  std::array<std::int64_t, 3> packed{counts.irregular, counts.cycles, counts.foreign};
  comm.sum(packed);
  return {packed[0], packed[1], packed[2]};
}

mesh::Check count_check(const char* name, std::int64_t expected, std::int64_t found, const char* meaning) {
  return {name, static_cast<double>(expected), static_cast<double>(found), expected == found, meaning};
}
mesh::Check limit_check(const char* name, double limit, double found, const char* meaning) {
  return {name, limit, found, found <= limit, meaning};
}

} // namespace

CycleCounts count_cycles(std::vector<TaggedFacet> facets) {
  CycleCounts counts;
  std::sort(facets.begin(), facets.end(), [](const TaggedFacet& a, const TaggedFacet& b) { return a.first < b.first; });
  std::vector<GlobalId> starts, ends, irregular;
  for (const TaggedFacet& facet : facets) {
    starts.push_back(facet.first);
    ends.push_back(facet.second);
  }
  std::sort(ends.begin(), ends.end());
  for (const std::vector<GlobalId>* ids : {&starts, &ends}) // those that come more than once
    for (std::size_t k = 1; k < ids->size(); ++k)
      if ((*ids)[k] == (*ids)[k - 1])
        irregular.push_back((*ids)[k]);
  std::set_symmetric_difference(starts.begin(), starts.end(), ends.begin(), ends.end(), std::back_inserter(irregular));
  std::sort(irregular.begin(), irregular.end());
  irregular.erase(std::unique(irregular.begin(), irregular.end()), irregular.end());
  counts.irregular = std::ssize(irregular);

  std::vector<bool> seen(facets.size(), false);
  std::set<std::int64_t> tags;
  for (std::size_t first = 0; first < facets.size(); ++first) {
    if (seen[first])
      continue;
    std::int64_t length = 0, foreign = 0;
    bool closed = false;
    for (std::size_t k = first; !seen[k] && !closed; ++length) {
      seen[k] = true;
      foreign += facets[k].tag != facets[first].tag;
      closed = facets[k].second == facets[first].first;
      const auto next = std::lower_bound(starts.begin(), starts.end(), facets[k].second);
      if (next == starts.end() || *next != facets[k].second)
        break;
      if (!closed)
        k = static_cast<std::size_t>(next - starts.begin());
    }
    counts.cycles += closed;
    counts.foreign += tags.insert(facets[first].tag).second ? foreign : length;
  }
  return counts;
}

mesh::Checks prove_boundary(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh,
                            const comm::Communicator& comm) {
  const std::vector<ChordCurve> chords = compare_chords(truth.meshed, truth.sites);
  const ChordExtremes extremes = extremes_of(truth, chords);
  const CycleCounts cycles = cycles_of(mesh, comm);
  const double distance = vertex_distance(truth, chords, mesh, comm) / truth.side;
  const double shape_area = truth.meshed.loops.empty() ? truth.meshed.area : area_of_loops(truth.meshed);
  // Vertices lie on the lattice: in a container far larger than the shape, or far from the origin, its step is what
  // limits them, and with them the area.
  const double step = truth.lattice.step();
  return {
      count_check("irregular_boundary_points", 0, cycles.irregular,
                  "boundary points without exactly one facet in and one out"),
      count_check("boundary_cycles", std::ssize(truth.meshed.loops), cycles.cycles,
                  "loops of the shape; closed cycles of facets"),
      count_check("foreign_tags", 0, cycles.foreign, "facets with another tag than their cycle"),
      count_check("corner_places", truth.sites.corners, corners_in_place(truth),
                  "corners that are vertices of the shape, bit for bit"),
      limit_check(
          "vertex_distance", std::max(CertificateRules::vertex_limit, step / truth.side), distance,
          "boundary vertices from the curves that were meshed, over the longer side of the container (at most)"),
      limit_check(
          "generalisation", std::max(truth.within, CertificateRules::least_within), generalisation(truth),
          "the curves that were meshed from the shape's boundary, over the h for which they were simplified (at most)"),
      limit_check("chord_deviation", CertificateRules::chord_limit, extremes.deviation,
                  "the shape's boundary from the facets, over h as it was asked for (at most)"),
      limit_check("arc_deviation", 1, extremes.of_arcs,
                  "arcs of circles from their facets, over 1.08 l^2/8R + h/1000, facet l, radius R (at most)"),
      limit_check("area_residual", CertificateRules::area_limit + step * truth.meshed.length() / shape_area,
                  area_residual(truth, extremes.area, shape_area),
                  "mesh, with what lies between facets and curve, from the shape, over the shape's area (at most)")};
}

} // namespace trime::certificate
