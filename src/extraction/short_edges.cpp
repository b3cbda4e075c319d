// SPDX-License-Identifier: BSD-3-Clause
#include "extraction/short_edges.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "sites/fan.hpp"

#include <algorithm>

namespace trime::extraction {

using geometry::ShortEdge;
using geometry::Vec2;

namespace {

constexpr std::ptrdiff_t sites_in_a_row = 1024; // by one thread

} // namespace

std::vector<ShortEdge> short_edges(const sites::StageView& view, double shortest) {
  const mesh::BinnedPoints& points = view.state.points();
  std::vector<ShortEdge> edges = comm::gather_agreed<ShortEdge>(view.state.comm(), [&] {
    return gather_in_order<ShortEdge>(points.owned(), sites_in_a_row,
                                      [&](std::ptrdiff_t item, std::vector<ShortEdge>& list) {
                                        const auto i = static_cast<LocalIndex>(item);
                                        const Vec2 p = points.position(i);
                                        const sites::Fan fan = sites::inside_fan(view, i);
                                        for (std::size_t k = 0; fan.complete && k < fan.edges(); ++k) {
                                          const Vec2 q = points.position(fan.neighbour(k));
                                          if (const double length = geometry::length(q - p);
                                              length < shortest && geometry::lexicographically_less(p, q))
                                            list.push_back({points.grid().periods().wrap(0.5 * (p + q)), length});
                                        }
                                      });
  });
  std::sort(edges.begin(), edges.end(), [](const ShortEdge& a, const ShortEdge& b) {
    return geometry::lexicographically_less(a.middle, b.middle);
  });
  return edges;
}

} // namespace trime::extraction
