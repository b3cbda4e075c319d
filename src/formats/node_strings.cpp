// SPDX-License-Identifier: BSD-3-Clause
#include "formats/node_strings.hpp"

#include "comm/agree.hpp"
#include "io/point_lookup.hpp"

#include <algorithm>
#include <cstring>

namespace trime::formats {
namespace {

struct Edge {
  GlobalId first, second;
  std::int64_t loop, label;
  geometry::Vec2 place; // of the first point
};

/// Appends values of one type from the bytes of all ranks.
template <class T>
std::vector<T> joined(const std::vector<std::string>& parts) {
  std::vector<T> values;
  for (const std::string& part : parts) {
    const std::size_t before = values.size();
    values.resize(before + part.size() / sizeof(T));
    std::memcpy(static_cast<void*>(values.data() + before), part.data(), part.size());
  }
  return values;
}

std::vector<Edge> gather_edges(const ExchangeMesh& exchange) {
  const mesh::DistributedMesh& mesh = exchange.mesh();
  const comm::Communicator& comm = exchange.comm();
  std::vector<GlobalId> firsts;
  for (const auto& facet : mesh.facets)
    firsts.push_back(facet[0]);
  const io::PointLookup points(mesh, firsts, comm);
  std::string bytes;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    append_bytes(bytes, Edge{mesh.facets[k][0], mesh.facets[k][1], mesh.facet_tags[k], mesh.facet_parts[k] + 1,
                             points[mesh.facets[k][0]].position});
  return joined<Edge>(comm.gather(bytes));
}

bool comes_before(const Edge& a, const Edge& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// Edges one after the other; where a loop touches itself it may fall into several.
std::vector<std::vector<Edge>> loops_of(std::vector<Edge> edges) {
  std::sort(edges.begin(), edges.end(), comes_before);
  std::vector<bool> used(edges.size());
  std::vector<std::vector<Edge>> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start])
      continue;
    std::vector<Edge>& loop = loops.emplace_back();
    for (std::size_t k = start; k < edges.size();) {
      used[k] = true;
      loop.push_back(edges[k]);
      const GlobalId next = edges[k].second;
      for (k = static_cast<std::size_t>(
               std::lower_bound(edges.begin(), edges.end(), Edge{next, -1, 0, 0, {}}, comes_before) - edges.begin());
           k < edges.size() && edges[k].first == next && (used[k] || edges[k].loop != loop[0].loop);)
        ++k;
      if (k < edges.size() && edges[k].first != next)
        k = edges.size();
    }
  }
  return loops;
}

/// Twice the area to the left of a loop: negative around a hole.
double signed_area(const std::vector<Edge>& loop) {
  double area = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    area += geometry::cross(loop[k].place - loop[0].place, loop[(k + 1) % loop.size()].place - loop[0].place);
  return area;
}

/// A loop around a hole, or both sides of a curve that is split, which have no area between them.
bool goes_round_island(const std::vector<Edge>& loop, std::size_t parts) {
  const auto is_on_curve = [&](const Edge& edge) { return edge.label > static_cast<std::int64_t>(parts); };
  return std::ranges::all_of(loop, is_on_curve) || signed_area(loop) < 0;
}

void append_strings(std::vector<Edge> loop, std::size_t parts, std::vector<NodeString>& strings) {
  const bool is_island = goes_round_island(loop, parts);
  std::size_t turn = 0; // the first edge whose label is not that of the edge before it
  while (turn < loop.size() && loop[turn].label == loop[turn == 0 ? loop.size() - 1 : turn - 1].label)
    ++turn;
  const bool is_closed = turn == loop.size();
  if (!is_closed)
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(turn), loop.end());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (k == 0 || loop[k].label != loop[k - 1].label)
      strings.push_back({loop[k].label, is_closed, is_island, {loop[k].first}});
    if (!is_closed || k + 1 < loop.size())
      strings.back().points.push_back(loop[k].second);
  }
}

BoundaryRing ring_of(std::vector<Edge> loop, std::size_t parts) {
  const auto height = [](const Edge& edge) { return edge.place.x + edge.place.y; };
  std::rotate(loop.begin(), std::ranges::min_element(loop, {}, height), loop.end());
  BoundaryRing ring{goes_round_island(loop, parts), {}, {}};
  for (const Edge& edge : loop) {
    ring.points.push_back(edge.first);
    ring.labels.push_back(edge.label);
  }
  return ring;
}

} // namespace

std::vector<BoundaryRing> boundary_rings(const ExchangeMesh& mesh) {
  const std::vector<Edge> edges = gather_edges(mesh);
  std::vector<BoundaryRing> rings;
  comm::run_agreed(mesh.comm(), [&] {
    for (std::vector<Edge>& loop : loops_of(edges))
      rings.push_back(ring_of(std::move(loop), mesh.names().parts.size()));
    std::ranges::stable_sort(rings, {}, &BoundaryRing::is_island);
  });
  return rings;
}

std::vector<NodeString> node_strings(const ExchangeMesh& mesh) {
  const std::vector<Edge> edges = gather_edges(mesh);
  std::vector<NodeString> strings;
  comm::run_agreed(mesh.comm(), [&] {
    for (std::vector<Edge>& loop : loops_of(edges))
      append_strings(std::move(loop), mesh.names().parts.size(), strings);
  });
  return strings;
}

std::vector<PairString> pair_strings(const ExchangeMesh& exchange) {
  struct Pair {
    std::array<GlobalId, 2> points;
    std::int32_t curve, path;
  };
  const mesh::DistributedMesh& mesh = exchange.mesh();
  std::vector<PairString> strings;
  if (mesh.split_slab.total == 0)
    return strings;
  std::string bytes, sides;
  for (std::size_t k = 0; k < mesh.split_pairs.size(); ++k)
    append_bytes(bytes, Pair{mesh.split_pairs[k], mesh.split_curves[k], mesh.split_paths[k]});
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    if (mesh.facet_parts[k] >= std::ssize(exchange.names().parts))
      append_bytes(sides, mesh.facets[k]);
  std::vector<std::array<GlobalId, 2>> edges = joined<std::array<GlobalId, 2>>(exchange.comm().gather(sides));
  std::sort(edges.begin(), edges.end());
  std::int32_t path = -1;
  const auto close = [&] { // a ring has three edges or more
    if (!strings.empty() && strings.back().pairs.size() > 2 &&
        std::binary_search(edges.begin(), edges.end(),
                           std::array{strings.back().pairs.back()[0], strings.back().pairs.front()[0]}))
      strings.back().pairs.push_back(strings.back().pairs.front());
  };
  for (const Pair& pair : joined<Pair>(exchange.comm().gather(bytes))) {
    if (pair.path != path) {
      close();
      strings.push_back({pair.curve, {}});
    }
    path = pair.path;
    strings.back().pairs.push_back(pair.points);
  }
  close();
  return strings;
}

} // namespace trime::formats
