// SPDX-License-Identifier: BSD-3-Clause
#include "formats/boundary_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace trime::formats {
namespace {

double nearest_image(double p, double near, double period) {
  return period > 0 ? p - period * std::round((p - near) / period) : p;
}

/// Edges by their first vertex; those that are already in a loop are taken.
class EdgeTable {
public:
  explicit EdgeTable(std::vector<LoopEdge> edges) : edges_(std::move(edges)), taken_(edges_.size(), false) {
    std::sort(edges_.begin(), edges_.end(), [](const LoopEdge& a, const LoopEdge& b) {
      return std::tie(a.first, a.tag, a.second) < std::tie(b.first, b.tag, b.second);
    });
  }

  std::size_t size() const { return edges_.size(); }
  const LoopEdge& operator[](std::size_t edge) const { return edges_[edge]; }
  bool is_taken(std::size_t edge) const { return taken_[edge]; }
  void take(std::size_t edge) { taken_[edge] = true; }

  /// Returns a free edge that starts where this one ends, if possible with the same tag; size() if no edge does.
  std::size_t next(const LoopEdge& edge) const {
    std::size_t found = size();
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), edge.second,
                                     [](const LoopEdge& e, GlobalId id) { return e.first < id; });
    for (auto k = static_cast<std::size_t>(at - edges_.begin()); k < size() && edges_[k].first == edge.second; ++k)
      if (!taken_[k] && (found == size() || edges_[k].tag == edge.tag))
        found = k;
    return found;
  }

private:
  std::vector<LoopEdge> edges_;
  std::vector<bool> taken_;
};

/// Takes the loop through a free edge.
std::vector<LoopVertex> take_loop(EdgeTable& edges, std::size_t start) {
  std::vector<LoopVertex> loop;
  for (std::size_t edge = start; edge != edges.size(); edge = edges.next(edges[edge])) {
    edges.take(edge);
    loop.push_back({edges[edge].first, edges[edge].place});
    if (edges[edge].second == edges[start].first)
      break;
  }
  return loop;
}

/// True for a loop that runs clockwise and comes back to its start without winding round the container.
bool is_clockwise(const std::vector<LoopVertex>& loop, geometry::Vec2 period) {
  double twice_area = 0;
  geometry::Vec2 from{0, 0}; // relative to the first vertex: differences of near points are exact
  for (std::size_t k = 1; k <= loop.size(); ++k) {
    const geometry::Vec2 place = loop[k % loop.size()].place, before = loop[k - 1].place;
    const geometry::Vec2 to = from + (formats::nearest_image(place, before, period) - before);
    twice_area += from.x * to.y - from.y * to.x;
    from = to;
  }
  const bool winds = (period.x > 0 && std::fabs(from.x) > period.x / 2) || //
                     (period.y > 0 && std::fabs(from.y) > period.y / 2);
  return !winds && twice_area < 0;
}

} // namespace

geometry::Vec2 nearest_image(geometry::Vec2 p, geometry::Vec2 near, geometry::Vec2 period) {
  return {nearest_image(p.x, near.x, period.x), nearest_image(p.y, near.y, period.y)};
}

std::vector<std::vector<LoopVertex>> boundary_loops(std::vector<LoopEdge> edges, geometry::Vec2 period) {
  EdgeTable table(std::move(edges));
  std::vector<std::size_t> order(table.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return table[a].tag < table[b].tag; });
  std::vector<std::vector<LoopVertex>> loops;
  for (const std::size_t edge : order) {
    if (table.is_taken(edge))
      continue;
    loops.push_back(take_loop(table, edge));
    if (is_clockwise(loops.back(), period))
      std::reverse(loops.back().begin() + 1, loops.back().end());
  }
  return loops;
}

} // namespace trime::formats
