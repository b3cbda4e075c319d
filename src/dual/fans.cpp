// SPDX-License-Identifier: BSD-3-Clause
#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "dual/cells.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <numeric>

namespace trime::dual {
namespace {

/// Lists the triangles at each site.
void list_fans(Cells& cells) {
  cells.fan_first.assign(at(cells.site_count) + 1, 0);
  const auto for_each_site = [&](const auto& use) {
    for (std::size_t t = 0; t < cells.triangles.size(); ++t)
      for (const LocalIndex corner : cells.triangles[t].corners)
        if (corner < cells.site_count)
          use(at(corner), static_cast<LocalIndex>(t));
  };
  for_each_site([&](std::size_t site, LocalIndex) { ++cells.fan_first[site + 1]; });
  std::partial_sum(cells.fan_first.begin(), cells.fan_first.end(), cells.fan_first.begin());
  cells.fans.resize(static_cast<std::size_t>(cells.fan_first.back()));
  std::vector<std::int64_t> next = cells.fan_first;
  for_each_site([&](std::size_t site, LocalIndex t) { cells.fans[static_cast<std::size_t>(next[site]++)] = t; });
}

/// The corner of a triangle that follows a site `steps` places later.
LocalIndex corner_behind(const CellTriangle& triangle, LocalIndex site, std::size_t steps) {
  const std::size_t k = triangle.corners[0] == site ? 0 : triangle.corners[1] == site ? 1 : 2;
  return triangle.corners[(k + steps) % 3];
}

enum class FanKind : std::uint8_t { open, closed, broken };

/// Puts the triangles of one site into their order.
FanKind order_fan(const Cells& cells, LocalIndex site, std::span<LocalIndex> fan) {
  const auto enters = [&](LocalIndex t) { return corner_behind(cells.triangles[at(t)], site, 1); };
  const auto leaves = [&](LocalIndex t) { return corner_behind(cells.triangles[at(t)], site, 2); };
  if (fan.empty())
    return FanKind::broken;
  const auto by_number = [&](LocalIndex a, LocalIndex b) {
    return cells.triangles[at(a)].number < cells.triangles[at(b)].number;
  };
  std::size_t starts = 0, start = 0;
  for (std::size_t k = 0; k < fan.size(); ++k)
    if (std::none_of(fan.begin(), fan.end(), [&](LocalIndex t) { return leaves(t) == enters(fan[k]); })) {
      ++starts;
      start = k;
    }
  if (starts > 1)
    return FanKind::broken;
  if (starts == 0)
    start = static_cast<std::size_t>(std::min_element(fan.begin(), fan.end(), by_number) - fan.begin());
  std::swap(fan[0], fan[start]);
  for (std::size_t k = 1; k < fan.size(); ++k) {
    const auto next = std::find_if(fan.begin() + static_cast<std::ptrdiff_t>(k), fan.end(),
                                   [&](LocalIndex t) { return enters(t) == leaves(fan[k - 1]); });
    if (next == fan.end())
      return FanKind::broken;
    std::iter_swap(fan.begin() + static_cast<std::ptrdiff_t>(k), next);
  }
  if (starts == 1)
    return FanKind::open;
  return leaves(fan.back()) == enters(fan[0]) ? FanKind::closed : FanKind::broken;
}

void order_fans(Cells& cells, const comm::Communicator& comm) {
  std::vector<FanKind> kinds(at(cells.site_count));
  thread_loop(cells.site_count, 1024, [&](std::ptrdiff_t k, int) {
    const auto from = cells.fan_first[static_cast<std::size_t>(k)],
               to = cells.fan_first[static_cast<std::size_t>(k) + 1];
    kinds[static_cast<std::size_t>(k)] =
        order_fan(cells, static_cast<LocalIndex>(k),
                  std::span(cells.fans).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)));
  });
  comm::run_agreed(comm, [&] {
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (kinds[k] == FanKind::broken)
        throw FileError(
            fmt::format("the triangles around the point {}, counted from 0, at ({:.9g}, {:.9g}) are not one "
                        "fan, so it has no Voronoi cell. Expected all of them to follow each other around "
                        "the point, found {} triangles that do not; look at the mesh there",
                        cells.first_site + static_cast<GlobalId>(k), cells.points[k].x, cells.points[k].y,
                        cells.fan_first[k + 1] - cells.fan_first[k]));
  });
  cells.closed.resize(kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k)
    cells.closed[k] = kinds[k] == FanKind::closed;
}

} // namespace

void find_fans(Cells& cells, const comm::Communicator& comm) {
  list_fans(cells);
  order_fans(cells, comm);
}

} // namespace trime::dual
