// SPDX-License-Identifier: BSD-3-Clause
#include "extraction/extraction.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "extraction/mesh_quality.hpp"
#include "extraction/rules.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace trime::extraction {
namespace {

using geometry::Vec2;
using mesh::DistributedMesh;
using polygon::BoundarySite;
using polygon::centroid;
using sites::Fan;
using sites::FlatFan;
using sites::inside_fan;
using sites::StageView;

/// Triangles and facets of one tile, or where those of a tile begin.
struct Offsets {
  std::size_t triangles = 0, facets = 0;
};

/// Lists triangles and facets at that of their vertices which has the lowest global id.
class Extractor {
public:
  Extractor(const StageView& view, const decomposition::Numbering& numbering, const sizing::SizeField& asked,
            const polygon::RegionFinder& regions)
      : view_(view), numbering_(numbering), asked_(asked), regions_(regions), points_(view.state.points()) {}

  Extraction run() {
    Extraction made;
    const SharpCorners corners(view_.polygon, points_.grid().periods());
    PerThread<QualityMeter> meters(view_.size, points_.grid().periods(), corners);
    comm::run_agreed(view_.state.comm(), [&] { // the size field is the user's
      fill_points(made.mesh);
      const std::vector<Offsets> begin = offsets();
      make_room(begin.back(), made.mesh);
      if (regions_.any())
        made.mesh.region.resize(begin.back().triangles);
      PerThread<FlatFan> fans(view_, numbering_);
      thread_loop(tiles(), 1, [&](std::ptrdiff_t t, int thread) {
        fill_tile(first_tile() + static_cast<LocalIndex>(t), begin[static_cast<std::size_t>(t)], fans[thread],
                  meters[thread], made.mesh);
      });
      if (!view_.polygon.inner.empty())
        list_inner_edges(fans[0], made.mesh);
    });
    auto meter = meters.begin();
    QualitySums& sums = (*meter).sums();
    while ((++meter) != meters.end())
      sums.add((*meter).sums());
    made.quality = summarize(view_.state.comm(), sums);
    return made;
  }

private:
  LocalIndex first_tile() const { return points_.first_tile(); }
  LocalIndex tiles() const { return points_.last_tile() - points_.first_tile(); }
  LocalIndex place(LocalIndex site) const { return numbering_.place(numbering_.vertex(site)); }

  void fill_points(DistributedMesh& mesh) const {
    const std::size_t n = numbering_.order.size();
    mesh.points.resize(n);
    mesh.boundary.resize(n);
    mesh.size.resize(n);
    mesh.fixed.resize(n);
    sizing::loop_over_blocks(view_.size, std::ssize(mesh.points), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      const auto first = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end - begin);
      for (std::size_t k = first; k < first + count; ++k) {
        const LocalIndex i = numbering_.order[k];
        const std::int32_t b = points_.boundary(i);
        mesh.points[k] = points_.position(i);
        mesh.boundary[k] = b < 0 ? 0 : view_.polygon.sites[at(b)].tag;
        mesh.fixed[k] = b >= 0 ? view_.polygon.sites[at(b)].corner : b == mesh::fixed_site && is_kept(mesh.points[k]);
      }
      const std::vector<double> sizes = // those of the state may be older
          sizing::sizes_at(view_.size, std::span(mesh.points).subspan(first, count));
      for (std::size_t k = 0; k < count; ++k)
        mesh.size[first + k] = static_cast<float>(sizes[k]);
    });
    mesh.point_slab = {numbering_.first, numbering_.total};
    mesh.foreign = numbering_.foreign;
  }

  /// Where each tile begins; the last entry is the end.
  std::vector<Offsets> offsets() const {
    std::vector<Offsets> begin(static_cast<std::size_t>(tiles()) + 1);
    thread_loop(tiles(), 1, [&](std::ptrdiff_t t, int) {
      const auto [first, last] = points_.tile_range(first_tile() + static_cast<LocalIndex>(t));
      Offsets& count = begin[static_cast<std::size_t>(t) + 1];
      for (LocalIndex i = first; i < last; ++i)
        count_site(i, count);
    });
    for (std::size_t t = 1; t < begin.size(); ++t) {
      begin[t].triangles += begin[t - 1].triangles;
      begin[t].facets += begin[t - 1].facets;
    }
    return begin;
  }

  void count_site(LocalIndex i, Offsets& count) const {
    const Fan fan = inside_fan(view_, i);
    if (fan.triangles == 0)
      return;
    const LocalIndex own = numbering_.vertex(i);
    const auto is_above = [&](std::size_t k) { return place(fan.neighbour(k)) > own; };
    bool above = is_above(0);
    const bool first_above = above;
    for (std::size_t k = 1; k <= fan.triangles; ++k) {
      const bool next_above = k == fan.triangles && fan.closed ? first_above : is_above(k);
      count.triangles += above && next_above;
      above = next_above;
    }
    if (!fan.closed)
      count.facets += std::size_t{first_above} + above;
  }

  static void make_room(Offsets total, DistributedMesh& mesh) {
    mesh.triangles.resize(total.triangles);
    mesh.alpha.resize(total.triangles);
    mesh.beta.resize(total.triangles);
    mesh.facets.resize(total.facets);
    mesh.facet_tags.resize(total.facets);
    mesh.facet_parts.resize(total.facets);
    mesh.facet_sizes.resize(total.facets);
  }

  void fill_tile(LocalIndex tile, Offsets next, FlatFan& fan, QualityMeter& meter, DistributedMesh& mesh) const {
    meter.write_to(std::span(mesh.alpha).subspan(next.triangles), std::span(mesh.beta).subspan(next.triangles));
    const auto [first, last] = points_.tile_range(tile);
    for (LocalIndex vertex = first; vertex < last; ++vertex) {
      const LocalIndex site = numbering_.order[at(vertex)];
      fan.load(site);
      list_triangles(vertex, points_.position(site), fan, meter, next, mesh);
      for (std::size_t k = 0; k < fan.edges; ++k)
        if (fan.place[k] > vertex)
          meter.add_edge(points_.position(site), fan.positions[k], static_cast<double>(mesh.size[at(vertex)]));
      if (!fan.closed && fan.complete)
        list_facets(vertex, site, fan, next, mesh);
    }
    meter.finish();
  }

  /// By the second vertex; a fan has few triangles.
  void list_triangles(LocalIndex vertex, Vec2 position, FlatFan& fan, QualityMeter& meter, Offsets& next,
                      DistributedMesh& mesh) const {
    for (const std::uint32_t k : fan.triangles_above(vertex)) {
      if (regions_.any())
        mesh.region[next.triangles] =
            1 + regions_.at(centroid(position, fan.positions[k], fan.positions[k + 1], view_.lattice));
      mesh.triangles[next.triangles++] = {vertex, fan.vertices[k], fan.vertices[k + 1]};
      meter.add_triangle(position, fan.positions[k], fan.positions[k + 1]);
    }
  }

  /// Lists the edges to the next boundary site and from the previous one if their other end is higher, ordered by their
  /// first vertex and then the second.
  void list_facets(LocalIndex vertex, LocalIndex own, const FlatFan& fan, Offsets& next, DistributedMesh& mesh) const {
    const std::vector<BoundarySite>& sites = view_.polygon.sites;
    const std::int32_t boundary_site = points_.boundary(own);
    const std::size_t last = fan.triangles;
    const auto add = [&](LocalIndex from, LocalIndex to, const BoundarySite& site) {
      const Vec2 other = fan.positions[from == vertex ? 0 : last];
      const Vec2 middle = points_.grid().periods().wrap(0.5 * (points_.position(own) + other));
      mesh.facet_sizes[next.facets] = static_cast<float>(asked_.size(middle));
      mesh.facets[next.facets] = {numbering_.global_id(from), numbering_.global_id(to)};
      mesh.facet_tags[next.facets] = site.tag;
      mesh.facet_parts[next.facets++] = site.part;
    };
    const auto from_previous = [&] { add(fan.vertices[last], vertex, sites[at(sites[at(boundary_site)].previous)]); };
    const bool with_next = fan.place[0] > vertex, with_previous = fan.place[last] > vertex;
    const bool previous_first = with_previous && (!with_next || fan.place[last] < fan.place[0]);
    if (previous_first)
      from_previous();
    if (with_next)
      add(vertex, fan.vertices[0], sites[at(boundary_site)]);
    if (with_previous && !previous_first)
      from_previous();
  }

  /// Is it a fixed point, or a node or corner of a curve? Other sites on curves could lie elsewhere.
  bool is_kept(Vec2 p) const {
    return view_.polygon.inner.is_corner(p) ||
           std::binary_search(view_.fixed.begin(), view_.fixed.end(), p, geometry::lexicographically_less);
  }

  /// Lists the edges on curves and interfaces at their lower ends, by the place of the higher one.
  void list_inner_edges(FlatFan& fan, DistributedMesh& mesh) const {
    const polygon::InnerChords& inner = view_.polygon.inner;
    for (LocalIndex vertex = 0; vertex < static_cast<LocalIndex>(numbering_.order.size()); ++vertex) {
      const LocalIndex site = numbering_.order[at(vertex)];
      const Vec2 p = points_.position(site);
      const std::span<const LocalIndex> ends =
          points_.boundary(site) == mesh::free_site ? std::span<const LocalIndex>() : inner.at(p);
      if (ends.empty())
        continue;
      fan.load(site);
      std::vector<std::array<LocalIndex, 3>> found; // place and vertex of the other end, and the end here
      for (const LocalIndex half : ends)
        for (std::size_t k = 0; k < fan.edges; ++k)
          if (fan.positions[k] == inner.other_end(half) && fan.place[k] > vertex)
            found.push_back({fan.place[k], fan.vertices[k], half});
      std::sort(found.begin(), found.end());
      for (const auto& [place, other, half] : found) {
        const GlobalId own = numbering_.global_id(vertex), end = numbering_.global_id(other);
        list_edge(half % 2 == 0 ? std::array{own, end} : std::array{end, own}, inner.chords[at(half / 2)], mesh);
      }
    }
  }

  void list_edge(const std::array<GlobalId, 2>& edge, const polygon::InnerChord& chord, DistributedMesh& mesh) const {
    if (chord.curve >= 0) {
      mesh.curve_edges.push_back(edge);
      mesh.curve_numbers.push_back(chord.curve);
    }
    if (chord.left == chord.right)
      return;
    const bool lower_left = chord.left < chord.right;
    mesh.interfaces.push_back(lower_left ? edge : std::array{edge[1], edge[0]});
    mesh.interface_regions.push_back({1 + std::min(chord.left, chord.right), 1 + std::max(chord.left, chord.right)});
    mesh.interface_pairs.push_back(regions_.regions().pair_of(chord.left, chord.right));
    mesh.interface_curves.push_back(chord.curve);
  }

  const StageView& view_;
  const decomposition::Numbering& numbering_;
  const sizing::SizeField& asked_;
  const polygon::RegionFinder& regions_;
  const mesh::BinnedPoints& points_;
};

} // namespace

void place_among_all(const comm::Communicator& comm, DistributedMesh& mesh) {
  const std::int64_t triangles = std::ssize(mesh.triangles), facets = std::ssize(mesh.facets);
  mesh.triangle_slab.first = comm.exclusive_scan(triangles);
  mesh.facet_slab.first = comm.exclusive_scan(facets);
  const std::int64_t curve_edges = std::ssize(mesh.curve_edges);
  mesh.curve_slab.first = comm.exclusive_scan(curve_edges);
  const std::int64_t interfaces = std::ssize(mesh.interfaces);
  mesh.interface_slab.first = comm.exclusive_scan(interfaces);
  std::array<std::int64_t, 5> sums{triangles, facets, static_cast<std::int64_t>(partial_hash(mesh)), curve_edges,
                                   interfaces};
  comm.sum(sums);
  mesh.interface_slab.total = sums[4];
  mesh.curve_slab.total = sums[3];
  mesh.triangle_slab.total = sums[0];
  mesh.facet_slab.total = sums[1];
  mesh.hash = static_cast<std::uint64_t>(sums[2]);
}

mesh::Check worst_alpha_check(const mesh::QualitySummary& quality, double most) {
  const double found = std::max(1.0, quality.worst_away.alpha);
  return {"worst_alpha", most, found, found <= most,
          "largest alpha above 2 of a triangle away from sharp corners, else 1; at most meshing.worst_alpha"};
}

mesh::Check longest_edge_check(const mesh::QualitySummary& quality) {
  const double most = ExtractionRules::longest_edge, found = quality.longest_over_size;
  return {"longest_edge", most, found, found <= most,
          "largest length of an edge over h at its middle (at most); a larger one has missed a place with small sizes"};
}

mesh::Check shortest_edge_check(const mesh::QualitySummary& quality, double least) {
  const double found = quality.shortest_edge;
  return {"shortest_edge", least, found, found >= least,
          "length of the shortest edge: at least shortest_edge in [sizing]"};
}

Extraction extract_mesh(const StageView& view, const decomposition::Numbering& numbering,
                        const sizing::SizeField& asked, const polygon::RegionFinder& regions) {
  Extraction made = Extractor(view, numbering, asked, regions).run();
  place_among_all(view.state.comm(), made.mesh);
  return made;
}

} // namespace trime::extraction
