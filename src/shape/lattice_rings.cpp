// SPDX-License-Identifier: BSD-3-Clause
#include "shape/lattice_rings.hpp"

#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "geometry/predicates.hpp"
#include "geometry/segment_tree.hpp"
#include "shape/rules.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <optional>
#include <set>

namespace trime::shape {

namespace {

using geometry::Box;
using geometry::lexicographically_less;
using geometry::orient2d;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

bool in_box_of(const Segment& s, Vec2 p) {
  return p.x >= std::min(s.a.x, s.b.x) && p.x <= std::max(s.a.x, s.b.x) && p.y >= std::min(s.a.y, s.b.y) &&
         p.y <= std::max(s.a.y, s.b.y);
}

/// Edges of a ring without direction, ascending: equal for equal rings, whatever their starts and directions.
std::vector<std::array<double, 4>> edges_of(const LatticeRing& ring) {
  std::vector<std::array<double, 4>> edges;
  for (std::size_t k = 0; k < ring.points.size(); ++k) {
    Vec2 a = ring.points[k], b = ring.points[(k + 1) % ring.points.size()];
    if (lexicographically_less(b, a))
      std::swap(a, b);
    edges.push_back({a.x, a.y, b.x, b.y});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Equal for rings with equal vertices, in any order.
std::uint64_t hash_of(const LatticeRing& ring) {
  std::uint64_t sum = ring.points.size();
  for (const Vec2 p : ring.points) // + 0.0: one hash for both zeros
    sum += mix_bits(mix_bits(std::bit_cast<std::uint64_t>(p.x + 0.0)) ^ std::bit_cast<std::uint64_t>(p.y + 0.0));
  return sum;
}

} // namespace

Meeting meeting_of(const Segment& s, const Segment& t) {
  if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) || std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
      std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) || std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y))
    return Meeting::none;
  const int ta = orient2d(s.a, s.b, t.a), tb = orient2d(s.a, s.b, t.b);
  if (ta * tb > 0)
    return Meeting::none;
  const int sa = orient2d(t.a, t.b, s.a), sb = orient2d(t.a, t.b, s.b);
  if (sa * sb > 0)
    return Meeting::none;
  if (ta * tb < 0 && sa * sb < 0)
    return Meeting::crossing;
  const bool touching = (ta == 0 && in_box_of(s, t.a)) || (tb == 0 && in_box_of(s, t.b)) ||
                        (sa == 0 && in_box_of(t, s.a)) || (sb == 0 && in_box_of(t, s.b));
  return touching ? Meeting::touch : Meeting::none;
}

std::vector<Segment> segments_of(const std::vector<LatticeRing>& rings) {
  std::size_t count = 0;
  for (const LatticeRing& ring : rings)
    count += ring.points.size();
  std::vector<Segment> segments;
  segments.reserve(count);
  for (const LatticeRing& ring : rings)
    for (std::size_t k = 0; k < ring.points.size(); ++k)
      segments.push_back({ring.points[k], ring.points[(k + 1) % ring.points.size()]});
  return segments;
}

namespace {

/// Is a pair of neighbours of one ring left out? @param after the segment behind each one
bool are_neighbours(const std::vector<LocalIndex>& after, LocalIndex i, LocalIndex j) {
  return j == after[at(i)] || i == after[at(j)];
}

/// Appends the pairs of a bin that meet.
void add_meetings(const std::vector<LocalIndex>& after, std::span<const Segment> segments,
                  std::span<const LocalIndex> bin, std::vector<SegmentPair>& pairs) {
  for (std::size_t b = 1; b < bin.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (!are_neighbours(after, bin[a], bin[b]) &&
          meeting_of(segments[at(bin[a])], segments[at(bin[b])]) != Meeting::none)
        pairs.push_back({bin[a], bin[b]});
}

/// @brief Two segments that meet are together in a bin. Nothing where bins are crowded, or very many meet.
std::optional<std::vector<SegmentPair>> meetings_in_bins(const std::vector<LocalIndex>& after,
                                                         const SegmentGrid& grid) {
  const std::span<const Segment> segments = grid.segments();
  std::int64_t looks = 0;
  for (std::size_t bin = 0; bin < grid.bins(); ++bin)
    looks += std::ssize(grid.bin(bin)) * (std::ssize(grid.bin(bin)) - 1) / 2;
  if (looks > ShapeRules::enough_pairs * std::ssize(segments))
    return std::nullopt;
  std::atomic<bool> is_full = false; // some list: the same on any threads
  std::vector<SegmentPair> pairs = gather_in_order<SegmentPair>(
      static_cast<std::ptrdiff_t>(grid.bins()), ShapeRules::meeting_chunk, [&](std::ptrdiff_t k, auto& list) {
        const std::span<const LocalIndex> bin = grid.bin(static_cast<std::size_t>(k)); // ascending
        if (list.size() >= ShapeRules::most_meetings)
          is_full.store(true, std::memory_order_relaxed);
        else
          add_meetings(after, segments, bin, list);
      });
  if (is_full)
    return std::nullopt;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (pairs.size() >= ShapeRules::most_meetings) // the tree takes only the first of each chunk
    return std::nullopt;
  return pairs;
}

std::vector<SegmentPair> meetings_by_tree(const std::vector<LocalIndex>& after, std::span<const Segment> segments) {
  const LocalIndex n = static_cast<LocalIndex>(segments.size());
  const geometry::SegmentTree tree(segments);
  constexpr LocalIndex chunk = ShapeRules::meeting_chunk;
  const LocalIndex chunks = (n + chunk - 1) / chunk;
  std::vector<std::vector<SegmentPair>> found(at(chunks)); // what is found does not depend on the threads
  thread_loop(chunks, 1, [&](std::ptrdiff_t c, int) {
    std::vector<SegmentPair>& pairs = found[static_cast<std::size_t>(c)];
    const LocalIndex first = static_cast<LocalIndex>(c) * chunk, last = std::min(n, first + chunk);
    for (LocalIndex i = first; i < last && pairs.size() < ShapeRules::most_meetings; ++i) {
      const auto start = static_cast<std::ptrdiff_t>(pairs.size());
      tree.for_each_near(segments[at(i)], [&](LocalIndex j) {
        if (j > i && !are_neighbours(after, i, j) && meeting_of(segments[at(i)], segments[at(j)]) != Meeting::none)
          pairs.push_back({i, j});
        return true;
      });
      std::sort(pairs.begin() + start, pairs.end());
    }
  });
  std::vector<SegmentPair> all;
  for (const std::vector<SegmentPair>& pairs : found)
    all.insert(all.end(), pairs.begin(), pairs.end());
  return all;
}

} // namespace

std::vector<SegmentPair> find_meetings(const std::vector<LatticeRing>& rings, const SegmentGrid& grid) {
  std::vector<LocalIndex> after;
  after.reserve(grid.segments().size());
  for (LocalIndex first = 0; const LatticeRing& ring : rings) {
    for (LocalIndex k = 1; k <= std::ssize(ring.points); ++k)
      after.push_back(first + k % static_cast<LocalIndex>(ring.points.size()));
    first += static_cast<LocalIndex>(ring.points.size());
  }
  if (std::optional<std::vector<SegmentPair>> found = meetings_in_bins(after, grid))
    return std::move(*found);
  return meetings_by_tree(after, grid.segments());
}

std::vector<RepeatedRing> drop_repeated(std::vector<LatticeRing>& rings) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order; // equal ones side by side, the first in the file first
  for (std::size_t k = 0; k < rings.size(); ++k)
    order.emplace_back(hash_of(rings[k]), k);
  std::sort(order.begin(), order.end());
  std::vector<std::ptrdiff_t> first_of(rings.size(), -1); // the ring that a repeated one repeats
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t j = k; j-- > 0 && order[j].first == order[k].first;)
      if (first_of[order[j].second] < 0 && edges_of(rings[order[j].second]) == edges_of(rings[order[k].second]))
        first_of[order[k].second] = static_cast<std::ptrdiff_t>(order[j].second);
  std::vector<RepeatedRing> repeated;
  std::size_t kept = 0;
  std::vector<int> first_line;
  std::vector<std::set<int>> markers_of;
  for (const LatticeRing& ring : rings) {
    first_line.push_back(ring.lines[0]);
    markers_of.emplace_back(ring.markers.begin(), ring.markers.end());
  }
  for (std::size_t k = 0; k < rings.size(); ++k)
    if (const auto first = static_cast<std::size_t>(first_of[k]); first_of[k] >= 0)
      repeated.push_back({first_line[k], first_line[first], markers_of[k] != markers_of[first]});
    else if (kept++ != k)
      rings[kept - 1] = std::move(rings[k]);
  rings.resize(kept);
  return repeated;
}

} // namespace trime::shape
