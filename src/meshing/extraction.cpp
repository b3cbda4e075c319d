// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/extraction.hpp"

#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;
using mesh::DistributedMesh;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

/// Triangles and boundary edges that are listed from one site: those whose lowest global id it has.
struct Emitter {
  const ExtractionContext& context;
  const std::vector<GlobalId>& ids;

  template <class Visit>
  void triangles(LocalIndex i, const Visit& visit) const {
    const Fan fan = inside_fan(context, i);
    const GlobalId own = ids[at(i)];
    for (std::size_t k = 0; k < fan.triangles; ++k) {
      const LocalIndex a = fan.neighbour(k), b = fan.neighbour(k + 1);
      if (own < ids[at(a)] && own < ids[at(b)])
        visit(a, b);
    }
  }

  /// Boundary edges (first, second, site from which the edge leads to the next), interior on the left.
  template <class Visit>
  void facets(LocalIndex i, const Visit& visit) const {
    const std::int32_t b = context.state.points().boundary(i);
    if (b < 0)
      return;
    const Fan fan = inside_fan(context, i);
    if (!fan.complete)
      return;
    const LocalIndex next = fan.neighbour(0), previous = fan.neighbour(fan.triangles);
    const bool with_next = ids[at(i)] < ids[at(next)], with_previous = ids[at(i)] < ids[at(previous)];
    const BoundarySite& site = context.boundary.sites[at(b)];
    const auto to_next = [&] { visit(ids[at(i)], ids[at(next)], site); };
    const auto from_previous = [&] { visit(ids[at(previous)], ids[at(i)], context.boundary.sites[at(site.previous)]); };
    if (with_next && with_previous && ids[at(previous)] < ids[at(next)]) {
      from_previous();
      to_next();
      return;
    }
    if (with_next)
      to_next();
    if (with_previous)
      from_previous();
  }
};

/// Prefix sums of per-site counts, by canonical position; the last entry is the total.
template <class Count>
std::vector<std::int64_t> starts_of(const std::vector<LocalIndex>& order, const Count& count) {
  std::vector<std::int64_t> starts(order.size() + 1, 0);
  thread_loop(static_cast<std::ptrdiff_t>(order.size()), 4096, [&](std::ptrdiff_t k, int) {
    starts[static_cast<std::size_t>(k) + 1] = count(order[static_cast<std::size_t>(k)]);
  });
  for (std::size_t k = 1; k < starts.size(); ++k)
    starts[k] += starts[k - 1];
  return starts;
}

void fill_points(const ExtractionContext& context, const decomposition::Numbering& numbering, DistributedMesh& mesh) {
  const std::size_t n = numbering.order.size();
  const mesh::BinnedPoints& points = context.state.points();
  mesh.points.resize(n);
  mesh.boundary.resize(n);
  mesh.size.resize(n);
  mesh.fixed.resize(n);
  thread_loop(static_cast<std::ptrdiff_t>(n), 4096, [&](std::ptrdiff_t item, int) {
    const std::size_t k = static_cast<std::size_t>(item);
    const LocalIndex i = numbering.order[k];
    const std::int32_t b = points.boundary(i);
    mesh.points[k] = points.position(i);
    mesh.boundary[k] = b < 0 ? 0 : context.boundary.sites[at(b)].tag;
    mesh.size[k] = static_cast<float>(context.size.size(points.position(i)));
    mesh.fixed[k] = b >= 0 ? context.boundary.sites[at(b)].corner : b == mesh::fixed_site;
  });
  mesh.point_slab = {numbering.first, numbering.total};
}

void fill_triangles(const ExtractionContext& context, const decomposition::Numbering& numbering,
                    DistributedMesh& mesh) {
  const Emitter emitter{context, numbering.global_ids};
  const mesh::BinnedPoints& points = context.state.points();
  const std::vector<std::int64_t> starts = starts_of(numbering.order, [&](LocalIndex i) {
    std::int64_t n = 0;
    emitter.triangles(i, [&](LocalIndex, LocalIndex) { ++n; });
    return n;
  });
  const std::size_t total = static_cast<std::size_t>(starts.back());
  mesh.triangles.resize(total);
  mesh.alpha.resize(total);
  mesh.beta.resize(total);
  mesh.region.assign(total, 1);
  thread_loop(static_cast<std::ptrdiff_t>(numbering.order.size()), 4096, [&](std::ptrdiff_t k, int) {
    const LocalIndex i = numbering.order[static_cast<std::size_t>(k)];
    const std::size_t begin = static_cast<std::size_t>(starts[static_cast<std::size_t>(k)]);
    std::size_t t = begin;
    emitter.triangles(i, [&](LocalIndex a, LocalIndex b) {
      const std::array<GlobalId, 3> triangle{numbering.global_ids[at(i)], numbering.global_ids[at(a)],
                                             numbering.global_ids[at(b)]};
      const Vec2 p = points.position(i), q = points.position(a), r = points.position(b);
      std::size_t slot = t++; // insertion sort by the second vertex; a fan has few triangles
      for (; slot > begin && mesh.triangles[slot - 1][1] > triangle[1]; --slot) {
        mesh.triangles[slot] = mesh.triangles[slot - 1];
        mesh.alpha[slot] = mesh.alpha[slot - 1];
        mesh.beta[slot] = mesh.beta[slot - 1];
      }
      mesh.triangles[slot] = triangle;
      mesh.alpha[slot] = static_cast<float>(mesh::aspect_ratio(p, q, r));
      mesh.beta[slot] = static_cast<float>(mesh::edge_ratio(p, q, r));
    });
  });
}

void fill_facets(const ExtractionContext& context, const decomposition::Numbering& numbering, DistributedMesh& mesh) {
  const Emitter emitter{context, numbering.global_ids};
  for (const LocalIndex i : numbering.order)
    emitter.facets(i, [&](GlobalId first, GlobalId second, const BoundarySite& site) {
      mesh.facets.push_back({first, second});
      mesh.facet_tags.push_back(site.tag);
      mesh.facet_parts.push_back(site.part);
    });
}

mesh::Slab slab_of(const comm::Communicator& comm, std::size_t count) {
  const std::int64_t n = static_cast<std::int64_t>(count);
  return {comm.exclusive_scan(n), comm.sum(n)};
}

} // namespace

Fan inside_fan(const ExtractionContext& context, LocalIndex i) {
  const mesh::BinnedPoints& points = context.state.points();
  Fan fan;
  fan.ring = context.state.stars().ring(i);
  const std::size_t n = fan.ring.size();
  const std::int32_t b = points.boundary(i);
  if (b < 0) {
    fan.closed = true;
    fan.complete = n >= 3 && std::find(fan.ring.begin(), fan.ring.end(), delaunay::gap) == fan.ring.end();
    fan.triangles = fan.complete ? n : 0;
    return fan;
  }
  const BoundarySite& site = context.boundary.sites[at(b)];
  // Positions tell the images of a boundary site from each other.
  const geometry::Vec2 before =
      context.boundary.chord(site.previous).a - context.boundary.sites[at(site.previous)].next_shift;
  const auto is_next = [&](LocalIndex j) {
    return points.boundary(j) == site.next && points.position(j) == context.boundary.chord(b).b;
  };
  const auto is_previous = [&](LocalIndex j) {
    return points.boundary(j) == site.previous && points.position(j) == before;
  };
  std::size_t first = 0;
  while (first < n && (fan.ring[first] == delaunay::gap || !is_next(fan.ring[first])))
    ++first;
  fan.first = first;
  for (std::size_t k = 1; first < n && k < n; ++k) {
    const LocalIndex neighbour = fan.neighbour(k);
    if (neighbour == delaunay::gap)
      break;
    if (is_previous(neighbour)) {
      fan.triangles = k;
      fan.complete = true;
      break;
    }
  }
  return fan;
}

std::int64_t count_incomplete_fans(const ExtractionContext& context) {
  std::vector<std::int64_t> of_thread(static_cast<std::size_t>(std::max(1, thread_count())), 0);
  thread_loop(context.state.points().owned(), 4096, [&](std::ptrdiff_t i, int thread) {
    of_thread[static_cast<std::size_t>(thread)] += !inside_fan(context, static_cast<LocalIndex>(i)).complete;
  });
  std::int64_t sum = 0;
  for (const std::int64_t n : of_thread)
    sum += n;
  return sum;
}

DistributedMesh extract_mesh(const ExtractionContext& context, const decomposition::Numbering& numbering) {
  const comm::Communicator& comm = context.state.comm();
  DistributedMesh mesh;
  fill_points(context, numbering, mesh);
  fill_triangles(context, numbering, mesh);
  fill_facets(context, numbering, mesh);
  mesh.triangle_slab = slab_of(comm, mesh.triangles.size());
  mesh.facet_slab = slab_of(comm, mesh.facets.size());
  mesh.hash = static_cast<std::uint64_t>(comm.sum(static_cast<std::int64_t>(partial_hash(mesh))));
  return mesh;
}

} // namespace trime::meshing
