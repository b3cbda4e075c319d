// SPDX-License-Identifier: BSD-3-Clause
#include "start/refinement.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "decomposition/selection.hpp"
#include "placing/density_sampler.hpp"
#include "placing/rules.hpp"
#include "sizing/size_blocks.hpp"
#include "start/rules.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

namespace trime::start {
namespace {

// [h] Sites that are too many are taken out where they lie nearest to the boundary; farther than this a hash
// decides, so that none need be searched.
constexpr double farthest_from_boundary = 4;

using decomposition::selection_key;
using decomposition::selection_threshold;
using geometry::Vec2;
using sites::Fan;
using sites::inside_fan;
using sites::SiteState;
using sites::Stage;
using sites::StageView;

/// Calls make(i, list) for all owned sites, over threads; the lists joined in the order of the sites' tiles.
template <class T, class Make>
std::vector<T> gather_by_tile(const mesh::BinnedPoints& points, const Make& make) {
  const LocalIndex first_tile = points.first_tile();
  std::vector<std::vector<T>> of_tile(static_cast<std::size_t>(points.last_tile() - first_tile));
  thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int) {
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i)
      make(i, of_tile[static_cast<std::size_t>(t)]);
  });
  std::size_t count = 0;
  for (const std::vector<T>& list : of_tile)
    count += list.size();
  std::vector<T> all;
  all.reserve(count);
  for (std::vector<T>& list : of_tile) {
    all.insert(all.end(), list.begin(), list.end());
    release(list);
  }
  return all;
}

/// @brief Does the same for sites that are cheap to make: makes them twice, so that all find their places in one list
/// at once.
/// @param make make(i, put) calls put(position) for each site; the same ones each time
template <class Make>
mesh::SiteList place_by_tile(const mesh::BinnedPoints& points, const Make& make) {
  const LocalIndex first_tile = points.first_tile(), tiles = points.last_tile() - first_tile;
  std::vector<std::size_t> before(static_cast<std::size_t>(tiles) + 1, 0);
  const auto for_each_site = [&](std::ptrdiff_t t, const auto& put) {
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i)
      make(i, put);
  };
  thread_loop(tiles, 1, [&](std::ptrdiff_t t, int) {
    std::size_t count = 0;
    for_each_site(t, [&](Vec2) { ++count; });
    before[static_cast<std::size_t>(t) + 1] = count;
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  mesh::SiteList all(before.back());
  thread_loop(tiles, 1, [&](std::ptrdiff_t t, int) {
    mesh::Site* next = all.data() + before[static_cast<std::size_t>(t)];
    for_each_site(t, [&](Vec2 position) { *next++ = {position}; });
  });
  return all;
}

/// Does the boundary of the stage leave room for a site with this size?
bool is_far_enough(const Stage& stage, Vec2 p, double size) {
  const double free = placing::PlacingRules::density_strip * size;
  return stage.guard->distance(p, free) >= free;
}

/// Keeps the items for which keep[k] is set.
template <class List>
void keep_marked(List& items, const std::vector<std::uint8_t>& keep) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < items.size(); ++k)
    if (keep[k])
      items[kept++] = items[k];
  items.resize(kept);
}

/// Marks those of the sites for which is_clear returns true.
void mark_clear(const Stage& next, std::span<const mesh::Site> sites, std::uint8_t* marks) {
  std::vector<Vec2> inside;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    marks[k] = next.guard->inside(sites[k].position);
    if (marks[k])
      inside.push_back(sites[k].position);
  }
  const std::vector<double> sizes = sizing::checked_sizes_at(*next.size, inside);
  for (std::size_t k = 0, its = 0; k < sites.size(); ++k)
    if (marks[k])
      marks[k] = is_far_enough(next, inside[its], sizes[its]), ++its;
}

/// A possible new site and its place in the order of urgency.
struct NewSite {
  Vec2 place;
  std::uint64_t key;
};

/// Key of the triangle p, q, r: the smaller, the larger it is for its place.
std::uint64_t urgency(Vec2 p, Vec2 q, Vec2 r, Vec2 place, const sizing::SizeField& size) {
  const Vec2 u = q - p, v = r - p;
  const double radius = geometry::length(u) * geometry::length(v) * geometry::length(v - u) /
                        std::fmax(2 * geometry::cross(u, v), 1e-300);
  return selection_key(1 / (1 + radius / size.size(place)), place);
}

} // namespace

bool is_clear(const Stage& next, Vec2 p) {
  return next.guard->inside(p) && is_far_enough(next, p, sizing::checked_size(*next.size, p));
}

mesh::SiteList inner_sites(const SiteState& state) {
  const mesh::BinnedPoints& points = state.points();
  return place_by_tile(points, [&](LocalIndex i, const auto& put) {
    if (points.boundary(i) == mesh::free_site)
      put(points.position(i));
  });
}

mesh::SiteList split_edges(const StageView& view) {
  const mesh::BinnedPoints& points = view.state.points();
  const geometry::Periods& periods = view.polygon.periods;
  return place_by_tile(points, [&](LocalIndex i, const auto& put) {
    if (points.boundary(i) == mesh::free_site)
      put(points.position(i));
    const Fan fan = inside_fan(view, i);
    if (!fan.complete)
      return;
    const Vec2 p = points.position(i);
    // The first and the last edge of an open fan are chords.
    for (std::size_t k = fan.closed ? 0 : 1; k < fan.triangles; ++k) {
      const Vec2 q = points.position(fan.neighbour(k));
      if (periods.less(p, q))
        put(periods.wrap(view.lattice.snap(p + 0.5 * (q - p))));
    }
  });
}

void insert_in_triangles(const StageView& view, const Stage& next, std::int64_t count, mesh::SiteList& sites) {
  const mesh::BinnedPoints& points = view.state.points();
  const geometry::Periods& periods = view.polygon.periods;
  const auto add_candidates = [&](LocalIndex i, std::vector<NewSite>& list) {
    const Fan fan = inside_fan(view, i);
    const Vec2 p = points.position(i);
    for (std::size_t k = 0; k < fan.triangles; ++k) {
      const Vec2 q = points.position(fan.neighbour(k)), r = points.position(fan.neighbour(k + 1));
      if (!periods.less(p, q) || !periods.less(p, r))
        continue;
      const Vec2 middle = periods.wrap(view.lattice.snap(p + (1.0 / 3) * ((q - p) + (r - p))));
      if (is_clear(next, middle))
        list.push_back({middle, urgency(p, q, r, middle, *next.size)});
    }
  };
  std::vector<NewSite> candidates;
  comm::run_agreed(view.state.comm(), [&] { candidates = gather_by_tile<NewSite>(points, add_candidates); });
  std::vector<std::uint64_t> keys(candidates.size());
  std::transform(candidates.begin(), candidates.end(), keys.begin(), [](const NewSite& c) { return c.key; });
  const std::uint64_t threshold = selection_threshold(view.state.comm(), keys, count);
  for (const NewSite& candidate : candidates)
    if (candidate.key < threshold)
      sites.push_back({candidate.place});
}

void clear_strip(const Stage& next, mesh::SiteList& sites) {
  std::vector<std::uint8_t> keep(sites.size());
  comm::run_agreed(next.state->comm(), [&] {
    sizing::loop_over_blocks(*next.size, std::ssize(sites), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      mark_clear(next, std::span(sites).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)),
                 keep.data() + begin);
    });
  });
  keep_marked(sites, keep);
}

std::int64_t trim(const comm::Communicator& comm, const Stage& next, std::int64_t most, mesh::SiteList& sites) {
  const std::int64_t excess = comm.sum(static_cast<std::int64_t>(sites.size())) - most;
  if (excess <= 0)
    return 0;
  std::vector<std::uint64_t> keys(sites.size());
  comm::run_agreed(comm, [&] {
    sizing::loop_over_blocks(*next.size, std::ssize(sites), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      std::vector<Vec2> places;
      for (std::ptrdiff_t k = begin; k < end; ++k)
        places.push_back(sites[static_cast<std::size_t>(k)].position);
      const std::vector<double> sizes = sizing::checked_sizes_at(*next.size, places);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double reach = farthest_from_boundary * sizes[k];
        keys[static_cast<std::size_t>(begin) + k] =
            selection_key(next.guard->distance(places[k], reach) / reach, places[k]);
      }
    });
  });
  const std::uint64_t threshold = selection_threshold(comm, keys, excess);
  std::vector<std::uint8_t> keep(sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k)
    keep[k] = keys[k] >= threshold;
  const std::size_t before = sites.size();
  keep_marked(sites, keep);
  return comm.sum(static_cast<std::int64_t>(before - sites.size()));
}

} // namespace trime::start
