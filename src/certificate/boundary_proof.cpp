// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/boundary_proof.hpp"

#include "certificate/facet_cycles.hpp"
#include "certificate/rules.hpp"
#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "polygon/chord_curve.hpp"
#include "sizing/lowered_size.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trime::certificate {
namespace {

using geometry::Vec2;
using polygon::area_of_loops;
using polygon::BoundarySite;
using polygon::ChordCurve;

/// Items begin .. end-1 of those that all ranks share out.
struct Share {
  std::size_t begin, end;

  Share(std::size_t n, const comm::Communicator& comm)
      : begin(n * static_cast<std::size_t>(comm.rank()) / static_cast<std::size_t>(comm.size())),
        end(n * static_cast<std::size_t>(comm.rank() + 1) / static_cast<std::size_t>(comm.size())) {}
};

/// The result of the share of a rank; mergeable in any order.
struct Findings {
  std::int64_t corners = 0; ///< that are a vertex of the shape, bit for bit
  ExactArea area;           ///< that chords take from the shape
  double distance = 0;      ///< largest of a boundary vertex from the curve
  double moved = 0;         ///< largest distance of the curves that were meshed from the shape, over h
  double deviation = 0;     ///< largest of a chord from its curve, over the h that was asked for
  double of_arcs = 0;       ///< largest of a chord of a circle, over what a good one has

  void add(const Findings& other) {
    corners += other.corners;
    area.add(other.area);
    distance = std::max(distance, other.distance);
    moved = std::max(moved, other.moved);
    deviation = std::max(deviation, other.deviation);
    of_arcs = std::max(of_arcs, other.of_arcs);
  }
};

/// Looks at what one rank has to prove.
class Prover {
public:
  Prover(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh, const comm::Communicator& comm)
      : truth_(truth), mesh_(mesh), comm_(comm) {}

  Findings prove() {
    compare_vertices();
    compare_curves();
    compare_sites();
    Findings all;
    for (const Findings& one : of_thread_)
      all.add(one);
    return all;
  }

private:
  /// Boundary vertices that are written, with the nearest piece of the curves that were meshed.
  void compare_vertices() {
    const geometry::PieceTree pieces(truth_.meshed);
    thread_loop(static_cast<std::ptrdiff_t>(mesh_.points.size()), 4096, [&](std::ptrdiff_t item, int thread) {
      const auto k = static_cast<std::size_t>(item);
      double& largest = of_thread_[thread].distance;
      if (mesh_.boundary[k] > 0)
        largest = std::max(largest, pieces.distance(mesh_.points[k]));
    });
  }

  /// The curves that were meshed with those of the shape.
  void compare_curves() {
    const geometry::PieceTree given(truth_.shape);
    std::size_t pieces = 0, before = 0;
    for (const geometry::Loop& loop : truth_.meshed.loops)
      pieces += loop.pieces.size();
    const Share share(pieces, comm_);
    for (const geometry::Loop& loop : truth_.meshed.loops) {
      const std::size_t n = loop.pieces.size();
      const std::size_t first = std::clamp(share.begin, before, before + n) - before;
      const std::size_t last = std::clamp(share.end, before, before + n) - before;
      thread_loop(static_cast<std::ptrdiff_t>(last - first), 256, [&](std::ptrdiff_t k, int thread) {
        const geometry::Piece& piece = loop.pieces[first + static_cast<std::size_t>(k)];
        double& largest = of_thread_[thread].moved;
        for (const auto& at_place : sizing::curve_distances(piece, given, truth_.asked, truth_.meshed.periods))
          largest = std::max(largest, at_place.in_sizes());
      });
      before += n;
    }
  }

  /// Sites with their places, and the chords to their next ones with the curves.
  void compare_sites() {
    const Share share(truth_.sites.sites.size(), comm_);
    const auto first = static_cast<LocalIndex>(share.begin), last = static_cast<LocalIndex>(share.end);
    const std::vector<ChordCurve> chords = polygon::compare_chords(truth_.meshed, truth_.sites, first, last);
    const std::vector<double> sizes = sizes_of_chords(truth_.size, first, last),
                              asked = sizes_of_chords(truth_.asked, first, last);
    thread_loop(last - first, 256, [&](std::ptrdiff_t item, int thread) {
      const auto k = static_cast<std::size_t>(item);
      const LocalIndex site = first + static_cast<LocalIndex>(item);
      Findings& found = of_thread_[thread];
      found.corners += is_vertex(truth_.sites.sites[at(site)], loop_of(site));
      add_chord(site, chords[k], {sizes[k], asked[k]}, found);
    });
  }

  /// Returns the mean of the sizes at the ends of each chord.
  std::vector<double> sizes_of_chords(const sizing::SizeField& size, LocalIndex first, LocalIndex last) const {
    std::vector<double> means(at(last - first));
    sizing::loop_over_blocks(size, last - first, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      std::vector<Vec2> ends;
      for (LocalIndex k = first + static_cast<LocalIndex>(begin); k < first + static_cast<LocalIndex>(end); ++k) {
        ends.push_back(truth_.sites.chord(k).a);
        ends.push_back(truth_.sites.sites[at(truth_.sites.sites[at(k)].next)].position);
      }
      const std::vector<double> sizes = sizing::sizes_at(size, ends);
      for (std::ptrdiff_t k = begin; k < end; ++k) {
        const auto its = static_cast<std::size_t>(2 * (k - begin));
        means[static_cast<std::size_t>(k)] = 0.5 * (sizes[its] + sizes[its + 1]);
      }
    });
    return means;
  }

  const geometry::Loop& loop_of(LocalIndex site) const {
    const std::vector<LocalIndex>& start = truth_.sites.loop_start;
    const auto after = std::upper_bound(start.begin(), start.end(), site);
    return truth_.meshed.loops[static_cast<std::size_t>(after - start.begin()) - 1];
  }

  bool is_vertex(const BoundarySite& site, const geometry::Loop& loop) const {
    return site.corner && site.along == 0 &&
           site.position == truth_.meshed.periods.wrap(loop.pieces[at(site.piece)].start);
  }

  /// The size at a chord, and the one that was asked for.
  struct ChordSizes {
    double h, asked;
  };

  void add_chord(LocalIndex site, const ChordCurve& curve, const ChordSizes& sizes, Findings& found) const {
    const geometry::Segment chord = truth_.sites.chord(site);
    const double sagitta = squared_length(chord.b - chord.a) * curve.curvature / 8;
    found.distance = std::max(found.distance, curve.offset);
    found.deviation = std::max(found.deviation, curve.deviation / sizes.asked);
    if (curve.curvature > 0)
      found.of_arcs = std::max(found.of_arcs, curve.deviation / (CertificateRules::arc_tolerance * sagitta +
                                                                 CertificateRules::arc_slack * sizes.h));
    found.area.add(curve.area, truth_.lattice);
  }

  const BoundaryTruth& truth_;
  const mesh::DistributedMesh& mesh_;
  const comm::Communicator& comm_;
  PerThread<Findings> of_thread_;
};

/// Merges the results of all ranks. Collective.
void reduce(const comm::Communicator& comm, Findings& found, CycleCounts& cycles) {
  const std::array<std::int64_t, 3> area = found.area.split();
  constexpr int half = 32; // of the sum of hashes, so that sums over ranks do not overflow
  constexpr std::uint64_t low = (std::uint64_t{1} << half) - 1;
  std::array<std::int64_t, 9> sums{cycles.irregular,
                                   cycles.cycles,
                                   cycles.changes,
                                   static_cast<std::int64_t>(cycles.tags & low),
                                   static_cast<std::int64_t>(cycles.tags >> half),
                                   found.corners,
                                   area[0],
                                   area[1],
                                   area[2]};
  std::array<double, 4> largest{found.distance, found.moved, found.deviation, found.of_arcs};
  comm.sum_and_max(sums, largest);
  cycles = {sums[0], sums[1], sums[2],
            static_cast<std::uint64_t>(sums[3]) + (static_cast<std::uint64_t>(sums[4]) << half)};
  found = {sums[5], ExactArea::join({sums[6], sums[7], sums[8]}), largest[0], largest[1], largest[2], largest[3]};
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

/// Returns the counts of this rank. Collective.
CycleCounts cycles_of(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  std::vector<TaggedFacet> facets;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    facets.push_back({mesh.facets[k][0], mesh.facets[k][1], mesh.facet_tags[k]});
  return count_cycles(facets, mesh.point_slab.total, comm);
}

/// Returns the hash of the tags of the loops.
std::uint64_t tags_of(const std::vector<geometry::Loop>& loops) {
  std::uint64_t tags = 0;
  for (const geometry::Loop& loop : loops)
    tags += tag_hash(loop.tag);
  return tags;
}

mesh::Check count_check(const char* name, std::int64_t expected, std::int64_t found, const char* meaning) {
  return {name, static_cast<double>(expected), static_cast<double>(found), expected == found, meaning};
}
mesh::Check limit_check(const char* name, double limit, double found, const char* meaning) {
  return {name, limit, found, found <= limit, meaning};
}

} // namespace

mesh::Checks prove_boundary(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh,
                            const comm::Communicator& comm) {
  CycleCounts cycles = cycles_of(mesh, comm);
  Findings found;
  comm::run_agreed(comm, [&] { found = Prover(truth, mesh, comm).prove(); }); // sizes may be the user's
  reduce(comm, found, cycles);
  const std::int64_t loops = std::ssize(truth.meshed.loops);
  const bool exchanged = cycles.cycles == loops && cycles.tags != tags_of(truth.meshed.loops);
  const double shape_area = truth.meshed.loops.empty() ? truth.meshed.area : area_of_loops(truth.meshed);
  // Vertices lie on the lattice: in a container far larger than the shape, or far from the origin, its step is what
  // limits them, and with them the area.
  const double step = truth.lattice.step();
  return {
      count_check("irregular_boundary_points", 0, cycles.irregular,
                  "boundary points at which not exactly one facet ends and one begins"),
      count_check("boundary_cycles", loops, cycles.cycles,
                  "expected: loops of the simplified shape; found: closed cycles of facets"),
      count_check("foreign_tags", 0, cycles.changes + exchanged,
                  "points at which the tag of the facets changes, plus 1 if the tags of cycles and loops differ"),
      count_check("corner_places", truth.sites.corners, found.corners,
                  "corners of the mesh that are vertices of the shape, with equal bits"),
      limit_check("vertex_distance", std::max(CertificateRules::vertex_limit, step / truth.side),
                  found.distance / truth.side,
                  "largest distance of a boundary vertex from the meshed curves over the longer side of the container "
                  "(at most)"),
      limit_check(
          "generalisation", std::max(truth.within, CertificateRules::least_within), found.moved / truth.coarseness,
          "largest distance of the meshed curves from the shape over the h for which they were simplified (at most)"),
      limit_check("chord_deviation", CertificateRules::chord_limit, found.deviation,
                  "largest distance of the boundary of the shape from the facets over the h asked for (at most)"),
      limit_check(
          "arc_deviation", 1, found.of_arcs,
          "largest distance of an arc of radius R from its facet of length l over 1.08 l^2/8R + h/1000 (at most)"),
      limit_check(
          "area_residual", CertificateRules::area_limit + step * truth.meshed.length() / shape_area,
          area_residual(truth, found.area.value(truth.lattice), shape_area),
          "area of mesh and slivers between facets and curves, minus area of the curves, over the latter (at most)")};
}

} // namespace trime::certificate
