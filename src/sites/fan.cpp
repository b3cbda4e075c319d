// SPDX-License-Identifier: BSD-3-Clause
#include "sites/fan.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>

namespace trime::sites {

using geometry::Vec2;
using polygon::BoundarySite;

Fan inside_fan(const StageView& view, LocalIndex i) {
  const mesh::BinnedPoints& points = view.state.points();
  Fan fan;
  fan.ring = view.state.stars().ring(i);
  const std::size_t n = fan.ring.size();
  const std::int32_t b = points.boundary(i);
  if (b < 0) {
    fan.closed = true;
    fan.complete = n >= 3 && std::find(fan.ring.begin(), fan.ring.end(), delaunay::gap) == fan.ring.end();
    fan.triangles = fan.complete ? n : 0;
    return fan;
  }
  const BoundarySite& site = view.polygon.sites[at(b)];
  // Positions distinguish the images of a boundary site.
  const geometry::Vec2 before = view.polygon.chord(site.previous).a - view.polygon.sites[at(site.previous)].next_shift;
  const auto is_next = [&](LocalIndex j) {
    return points.boundary(j) == site.next && points.position(j) == view.polygon.chord(b).b;
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

std::int64_t count_incomplete_fans(const StageView& view) {
  PerThread<std::int64_t> of_thread(0);
  thread_loop(view.state.points().owned(), 4096, [&](std::ptrdiff_t i, int thread) {
    of_thread[thread] += !inside_fan(view, static_cast<LocalIndex>(i)).complete;
  });
  std::int64_t sum = 0;
  for (const std::int64_t n : of_thread)
    sum += n;
  return sum;
}

void FlatFan::load(LocalIndex site) {
  const Fan fan = inside_fan(view_, site);
  closed = fan.closed;
  complete = fan.complete;
  triangles = fan.triangles;
  edges = complete ? fan.edges() : 0;
  const std::size_t n = triangles == 0 ? 0 : triangles + (closed ? 2 : 1);
  vertices.resize(n);
  place.resize(n);
  positions.resize(n);
  const std::span<const Vec2> sites = view_.state.points().positions();
  const std::span<const LocalIndex> site_vertex = numbering_.site_vertex;
  std::size_t entry = fan.first;
  for (std::size_t k = 0; k < n; ++k) {
    const LocalIndex neighbour = fan.ring[entry];
    vertices[k] = site_vertex[at(neighbour)];
    positions[k] = sites[at(neighbour)];
    entry = entry + 1 < fan.ring.size() ? entry + 1 : 0;
  }
  if (numbering_.foreign.empty()) // places are vertices
    std::copy(vertices.begin(), vertices.end(), place.begin());
  else
    std::transform(vertices.begin(), vertices.end(), place.begin(),
                   [&](LocalIndex vertex) { return numbering_.place(vertex); });
}

std::span<const std::uint32_t> FlatFan::triangles_above(LocalIndex own) {
  above_.resize(triangles + 1);
  std::size_t n = 0;
  for (std::size_t k = 0; k < triangles; ++k) { // no branch: nobody can foresee which
    above_[n] = static_cast<std::uint32_t>(k);
    n += place[k] > own && place[k + 1] > own;
  }
  for (std::size_t end = 1; end < n; ++end)
    for (std::size_t k = end; k > 0 && place[above_[k]] < place[above_[k - 1]]; --k)
      std::swap(above_[k], above_[k - 1]);
  return {above_.data(), n};
}

} // namespace trime::sites
