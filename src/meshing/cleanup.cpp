// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/cleanup.hpp"

#include "trime/core/random.hpp"
#include "trime/core/thread_loop.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double first_step = 0.1, last_step = 0.004; // of h
constexpr int most_trials = 200;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

double worst_alpha_around(Vec2 p, std::span<const Vec2> ring, double stop_at) {
  double worst = 1;
  for (std::size_t k = 0; k < ring.size() && worst < stop_at; ++k) {
    const Vec2 a = ring[k], b = ring[k + 1 == ring.size() ? 0 : k + 1];
    if (!(geometry::cross(a - p, b - p) > 0))
      return INFINITY;
    worst = std::max(worst, mesh::aspect_ratio(p, a, b));
  }
  return worst;
}

bool has_gap(std::span<const LocalIndex> ring) {
  return ring.size() < 3 || std::find(ring.begin(), ring.end(), delaunay::gap) != ring.end();
}

/// Positive, so that 0 can stand for "no candidate".
GlobalId hash_of(Vec2 p, int round) {
  const std::uint64_t bits = mix_bits(mix_bits(std::bit_cast<std::uint64_t>(p.x) + static_cast<std::uint64_t>(round)) ^
                                      std::bit_cast<std::uint64_t>(p.y));
  return static_cast<GlobalId>((bits >> 1) | 1);
}

/// The places of a ring around site i.
void collect_ring(const StarView& view, LocalIndex i, std::vector<Vec2>& places) {
  places.clear();
  for (const LocalIndex neighbour : view.stars.ring(i))
    places.push_back(view.points.position(neighbour));
}

/// Hash of each owned site that has a triangle above the threshold, else 0.
std::vector<GlobalId> candidates(const StarView& view, double threshold, int round) {
  std::vector<GlobalId> hashes(at(view.points.owned()), 0);
  thread_loop(view.points.owned(), 1024, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<LocalIndex>(item);
    if (view.points.boundary(i) != mesh::free_site || has_gap(view.stars.ring(i)))
      return;
    const Vec2 p = view.points.position(i);
    const auto ring = view.stars.ring(i);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = view.points.position(ring[k]), b = view.points.position(ring[k + 1 == ring.size() ? 0 : k + 1]);
      if (mesh::aspect_ratio(p, a, b) > threshold) {
        hashes[at(i)] = hash_of(p, round);
        return;
      }
    }
  });
  return hashes;
}

} // namespace

Vec2 max_min_place(Vec2 from, std::span<const Vec2> ring, double h) {
  constexpr double diagonal = 0.7071067811865476;
  constexpr std::array<Vec2, 8> directions{{{1, 0},
                                            {diagonal, diagonal},
                                            {0, 1},
                                            {-diagonal, diagonal},
                                            {-1, 0},
                                            {-diagonal, -diagonal},
                                            {0, -1},
                                            {diagonal, -diagonal}}};
  Vec2 best = from;
  double least = worst_alpha_around(from, ring, INFINITY);
  int trials = 0;
  for (double step = first_step * h; step >= last_step * h && trials < most_trials;) {
    Vec2 next = best;
    for (const Vec2 direction : directions) {
      const Vec2 trial = best + step * direction;
      const double worst = worst_alpha_around(trial, ring, least);
      ++trials;
      if (worst < least) {
        least = worst;
        next = trial;
      }
    }
    if (next == best)
      step *= 0.5;
    best = next;
  }
  return best;
}

CleanupCounts cleanup_round(const comm::Communicator& comm, Layout& layout, const geometry::Lattice& lattice,
                            double worst_alpha, int round) {
  SiteState& state = *layout.state;
  const StarView view = view_of(state, *layout.size);
  const mesh::BinnedPoints& points = state.points();
  const LocalIndex owned = points.owned();
  std::vector<GlobalId> hashes = candidates(view, worst_alpha, round);
  const std::vector<GlobalId> of_ghosts = state.halo().exchange(points, hashes);
  hashes.insert(hashes.end(), of_ghosts.begin(), of_ghosts.end());

  std::vector<mesh::Site> sites(at(owned));
  const std::vector<std::uint8_t> deleted(sites.size(), 0);
  std::vector<CleanupCounts> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  thread_loop(owned, 1024, [&](std::ptrdiff_t item, int thread) {
    const auto i = static_cast<LocalIndex>(item);
    mesh::Site& site = sites[at(i)] = points.site(i);
    site.lead = {};
    if (hashes[at(i)] == 0)
      return;
    CleanupCounts& counts = of_thread[static_cast<std::size_t>(thread)];
    ++counts.candidates;
    for (const LocalIndex neighbour : view.stars.ring(i))
      if (hashes[at(neighbour)] != 0 && hashes[at(neighbour)] < hashes[at(i)])
        return;
    std::vector<Vec2> ring;
    collect_ring(view, i, ring);
    const Vec2 place = lattice.snap(max_min_place(site.position, ring, view.size(i)));
    if (place == site.position || layout.guard->correct(place, view.size(i), lattice))
      return;
    site.position = place;
    ++counts.moved;
  });
  CleanupCounts all;
  for (const CleanupCounts& counts : of_thread) {
    all.candidates += counts.candidates;
    all.moved += counts.moved;
  }
  state.move_sites(sites, deleted);
  return {comm.sum(all.candidates), comm.sum(all.moved)};
}

} // namespace trime::meshing
