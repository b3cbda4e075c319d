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

/// A triangle at a site, with the corners that follow the site in it.
struct FanTriangle {
  LocalIndex enters, leaves;
  LocalIndex triangle;
};

FanTriangle fan_triangle(const Cells& cells, LocalIndex site, LocalIndex t) {
  const CellTriangle& triangle = cells.triangles[at(t)];
  return {triangle.corner_behind(site, 1), triangle.corner_behind(site, 2), t};
}

/// Says how the triangles around a site hang together; `whole` is a closed fan in one region.
enum class FanKind : std::uint8_t { open, closed, whole, broken };

/// Puts the triangles of one site into their order. @param triangles a buffer
FanKind order_fan(const Cells& cells, LocalIndex site, std::span<LocalIndex> fan, std::vector<FanTriangle>& triangles) {
  if (fan.empty())
    return FanKind::broken;
  triangles.clear();
  for (const LocalIndex t : fan)
    triangles.push_back(fan_triangle(cells, site, t));
  std::size_t starts = 0, start = 0;
  for (std::size_t k = 0; k < fan.size(); ++k)
    if (std::none_of(triangles.begin(), triangles.end(),
                     [&](const FanTriangle& t) { return t.leaves == triangles[k].enters; })) {
      ++starts;
      start = k;
    }
  if (starts > 1)
    return FanKind::broken;
  const auto by_number = [&](LocalIndex a, LocalIndex b) {
    return cells.triangles[at(a)].number < cells.triangles[at(b)].number;
  };
  if (starts == 0)
    start = static_cast<std::size_t>(std::min_element(fan.begin(), fan.end(), by_number) - fan.begin());
  std::swap(triangles[0], triangles[start]);
  for (std::size_t k = 1; k < fan.size(); ++k) {
    const auto next = std::find_if(triangles.begin() + static_cast<std::ptrdiff_t>(k), triangles.end(),
                                   [&](const FanTriangle& t) { return t.enters == triangles[k - 1].leaves; });
    if (next == triangles.end())
      return FanKind::broken;
    std::iter_swap(triangles.begin() + static_cast<std::ptrdiff_t>(k), next);
  }
  std::transform(triangles.begin(), triangles.end(), fan.begin(), [](const FanTriangle& t) { return t.triangle; });
  if (starts == 1)
    return FanKind::open;
  if (triangles.back().leaves != triangles[0].enters)
    return FanKind::broken;
  const auto region = [&](LocalIndex t) { return cells.triangles[at(t)].region; };
  const bool is_whole = std::all_of(fan.begin(), fan.end(), [&](LocalIndex t) { return region(t) == region(fan[0]); });
  return is_whole ? FanKind::whole : FanKind::closed;
}

void order_fans(Cells& cells, const comm::Communicator& comm) {
  std::vector<FanKind> kinds(at(cells.site_count));
  PerThread<std::vector<FanTriangle>> triangles;
  thread_loop(cells.site_count, 1024, [&](std::ptrdiff_t k, int thread) {
    const auto from = cells.fan_first[static_cast<std::size_t>(k)],
               to = cells.fan_first[static_cast<std::size_t>(k) + 1];
    kinds[static_cast<std::size_t>(k)] =
        order_fan(cells, static_cast<LocalIndex>(k),
                  std::span(cells.fans).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)),
                  triangles[thread]);
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
  cells.divided.resize(kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    cells.closed[k] = kinds[k] != FanKind::open;
    cells.divided[k] = kinds[k] != FanKind::whole;
  }
}

} // namespace

void find_fans(Cells& cells, const comm::Communicator& comm) {
  list_fans(cells);
  order_fans(cells, comm);
}

} // namespace trime::dual
