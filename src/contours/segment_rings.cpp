// SPDX-License-Identifier: BSD-3-Clause
#include "contours/segment_rings.hpp"

#include "contours/contour_text.hpp"
#include "contours/faults.hpp"
#include "contours/map_features.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <numeric>

namespace trime::contours {
namespace {

using geometry::Vec2;

constexpr int most_warnings = 5;

} // namespace

void RingBuilder::add(Vec2 p, int line, int marker) {
  check_coordinates(p, contour_.source, line, feature_);
  if (!ring_.points.empty() && ring_.points.back() == p) {
    tell_merged(p, line);
    ring_.markers.back() = marker;
    return;
  }
  ring_.points.push_back(p);
  ring_.lines.push_back(line);
  ring_.markers.push_back(marker);
}

void RingBuilder::end_ring() {
  if (ring_.points.empty() || is_spoiled_) {
    ring_ = {};
    is_spoiled_ = false;
    return;
  }
  if (ring_.points.size() > 1 && ring_.points.front() == ring_.points.back()) {
    ring_.points.pop_back();
    ring_.lines.pop_back();
    ring_.markers.pop_back();
  }
  if (const int distinct = distinct_vertices(); distinct < 3) {
    add_fault(contour_.faults, HasArea::no, [&]() -> Fault {
      return {place_of_line(contour_, ring_.lines[0], feature_),
              fmt::format("the ring that starts here at ({}, {}) has {} distinct {}", ring_.points[0].x,
                          ring_.points[0].y, distinct, distinct == 1 ? "vertex" : "vertices"),
              "expected at least 3", "the ring is left out"};
    });
    ring_ = {};
    return;
  }
  if (std::all_of(ring_.markers.begin(), ring_.markers.end(), [](int marker) { return marker == 0; }))
    ring_.markers = {};
  ring_.points.shrink_to_fit(); // they have grown by doubling
  ring_.lines.shrink_to_fit();
  ring_.markers.shrink_to_fit();
  ring_.polygon = polygon_;
  contour_.rings.push_back(std::move(ring_));
  ring_ = {};
}

void RingBuilder::finish() {
  end_ring();
  if (merged_ > most_warnings)
    contour_.warnings.push_back(
        fmt::format("{}: {} more repeated consecutive vertices merged", contour_.source, merged_ - most_warnings));
}

/// 1, 2, or 3 for three and more.
int RingBuilder::distinct_vertices() const {
  const std::vector<Vec2>& p = ring_.points;
  std::size_t other = 1;
  while (other < p.size() && p[other] == p[0])
    ++other;
  if (other >= p.size())
    return 1;
  for (std::size_t k = other + 1; k < p.size(); ++k)
    if (p[k] != p[0] && p[k] != p[other])
      return 3;
  return 2;
}

void RingBuilder::tell_merged(Vec2 p, int line) {
  if (++merged_ <= most_warnings)
    contour_.warnings.push_back(fmt::format("{}: vertex ({}, {}) repeats the one before it; the two are merged",
                                            place_of_line(contour_, line, feature_), p.x, p.y));
}

namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The first vertex at the place of each one.
std::vector<int> first_at_place(const std::vector<FileVertex>& vertices) {
  std::vector<int> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int v) { return vertices[at(v)].position; };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return geometry::lexicographically_less(place(a), place(b)); });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[at(order[k])] = k > 0 && place(order[k]) == place(order[k - 1]) ? first[at(order[k - 1])] : order[k];
  return first;
}

/// Among equal segments the first one stays.
void drop_useless(std::vector<FileSegment>& segments, const std::string& source, std::vector<std::string>& warnings) {
  const std::size_t before = segments.size();
  int line = 0;
  const auto told = [&](const FileSegment& s) { line = line == 0 ? s.line : std::min(line, s.line); };
  std::erase_if(segments, [&](const FileSegment& s) {
    if (s.from == s.to)
      told(s);
    return s.from == s.to;
  });
  std::vector<int> order(segments.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = [&](int k) { return std::minmax(segments[at(k)].from, segments[at(k)].to); };
  const auto pair_of = [&](int k) { return std::pair<int, int>(ends(k)); };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return pair_of(a) < pair_of(b); });
  std::vector<char> dropped(segments.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (pair_of(order[k]) == pair_of(order[k - 1])) {
      dropped[at(order[k])] = 1;
      told(segments[at(order[k])]);
    }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < segments.size(); ++k)
    if (dropped[k] == 0)
      segments[kept++] = segments[k];
  segments.resize(kept);
  if (kept < before)
    warnings.push_back(fmt::format("{}:{}: {} ignored, because {} no length or repeat{} another segment", source, line,
                                   before - kept == 1 ? "this segment is"
                                                      : fmt::format("this segment and {} more are", before - kept - 1),
                                   before - kept == 1 ? "it has" : "they have", before - kept == 1 ? "s" : ""));
}

/// Segments at each vertex.
class Web {
public:
  Web(const std::vector<FileVertex>& vertices, const std::vector<FileSegment>& segments)
      : vertices_(vertices), segments_(segments), first_(vertices.size() + 1, 0), used_(segments.size(), 0) {
    for (const FileSegment& s : segments) {
      ++first_[at(s.from) + 1];
      ++first_[at(s.to) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    next_.assign(first_.begin(), first_.end() - 1);
    arms_.resize(2 * segments.size());
    for (std::size_t k = 0; k < segments.size(); ++k)
      for (const int end : {segments[k].from, segments[k].to})
        arms_[at(next_[at(end)]++)] = static_cast<int>(k);
    next_.assign(first_.begin(), first_.end() - 1);
  }

  void check(const std::string& source) const {
    for (const FileSegment& s : segments_)
      for (const int v : {s.from, s.to})
        if (const int count = first_[at(v) + 1] - first_[at(v)]; count % 2 != 0) {
          const FileVertex& vertex = vertices_[at(v)];
          throw GeometryError(fmt::format(
              "{}:{}: {} segment{} vertex {} at ({}, {}); expected rings, with two segments at each vertex: {}", source,
              s.line, count, count == 1 ? " ends at" : "s meet at", vertex.number, vertex.position.x, vertex.position.y,
              count == 1 ? "close the ring, or remove the open line"
                         : "remove the line that leads into the area: lines inside are not kept"));
        }
  }

  std::vector<std::vector<RingVertex>> rings() {
    std::vector<std::vector<RingVertex>> found;
    std::vector<int> place(vertices_.size(), -1); // on the path
    struct Step {
      int vertex, segment; // which leaves it
    };
    std::vector<Step> path;
    for (std::size_t first = 0; first < segments_.size(); ++first) {
      if (used_[first] != 0)
        continue;
      int here = segments_[first].from, by = static_cast<int>(first);
      do { // the number of segments at each vertex is even: there is a way on until the first vertex is reached
        used_[at(by)] = 1;
        place[at(here)] = static_cast<int>(path.size());
        path.push_back({here, by});
        const FileSegment& s = segments_[at(by)];
        here = s.from == here ? s.to : s.from;
        if (place[at(here)] >= 0) { // a ring is closed
          std::vector<RingVertex>& ring = found.emplace_back();
          const auto begin = path.begin() + place[at(here)];
          for (auto step = begin; step != path.end(); ++step) {
            const FileVertex& v = vertices_[at(step->vertex)];
            ring.push_back({v.position, v.line, segments_[at(step->segment)].marker});
            place[at(step->vertex)] = -1;
          }
          path.erase(begin, path.end());
        }
        by = unused_at(here);
      } while (!path.empty() && by >= 0);
    }
    return found;
  }

private:
  int unused_at(int vertex) {
    for (int& k = next_[at(vertex)]; k < first_[at(vertex) + 1]; ++k)
      if (used_[at(arms_[at(k)])] == 0)
        return arms_[at(k)];
    return -1;
  }

  const std::vector<FileVertex>& vertices_;
  const std::vector<FileSegment>& segments_;
  std::vector<int> first_, next_, arms_;
  std::vector<char> used_;
};

/// The segments that are left if those with a free end are taken away again and again. @param segments between the
/// first vertices at each place
std::vector<FileSegment> without_free_ends(const std::vector<FileSegment>& segments, std::size_t vertices) {
  std::vector<std::vector<std::size_t>> arms(vertices);
  std::vector<int> degree(vertices, 0), free_ends;
  for (std::size_t k = 0; k < segments.size(); ++k)
    for (const int end : {segments[k].from, segments[k].to}) {
      arms[at(end)].push_back(k);
      ++degree[at(end)];
    }
  for (std::size_t v = 0; v < vertices; ++v)
    if (degree[v] == 1)
      free_ends.push_back(static_cast<int>(v));
  std::vector<char> gone(segments.size(), 0);
  for (std::size_t next = 0; next < free_ends.size(); ++next)
    for (const std::size_t k : arms[at(free_ends[next])])
      if (gone[k] == 0) {
        gone[k] = 1;
        for (const int end : {segments[k].from, segments[k].to})
          if (--degree[at(end)] == 1)
            free_ends.push_back(end);
      }
  std::vector<FileSegment> left;
  for (std::size_t k = 0; k < segments.size(); ++k)
    if (gone[k] == 0)
      left.push_back(segments[k]);
  return left;
}

} // namespace

void remove_open_chains(const std::vector<FileVertex>& vertices, std::vector<FileSegment>& segments,
                        const std::string& source, std::vector<std::string>& warnings) {
  const std::vector<int> first = first_at_place(vertices);
  std::vector<FileSegment> joined = segments;
  for (FileSegment& s : joined) {
    s.from = first[at(s.from)];
    s.to = first[at(s.to)];
  }
  drop_useless(joined, source, warnings);
  std::vector<FileSegment> left = without_free_ends(joined, vertices.size());
  if (const std::size_t gone = joined.size() - left.size(); gone > 0 && !left.empty()) {
    const auto place = std::mismatch(left.begin(), left.end(), joined.begin(), joined.end(),
                                     [](const FileSegment& a, const FileSegment& b) { return a.line == b.line; })
                           .second;
    const Vec2 p = vertices[at(place->from)].position;
    warnings.push_back(fmt::format("{}:{}: {} segment{} of open lines {} left out (the first one begins at ({}, {})); "
                                   "only closed rings bound the mesh",
                                   source, place->line, gone, gone == 1 ? "" : "s", gone == 1 ? "is" : "are", p.x,
                                   p.y));
    joined = std::move(left);
  }
  segments = std::move(joined);
}

std::vector<std::vector<RingVertex>> rings_of_segments(const std::vector<FileVertex>& vertices,
                                                       std::vector<FileSegment> segments, const std::string& source,
                                                       std::vector<std::string>& warnings) {
  const std::vector<int> first = first_at_place(vertices);
  for (FileSegment& s : segments) {
    s.from = first[at(s.from)];
    s.to = first[at(s.to)];
  }
  drop_useless(segments, source, warnings);
  Web web(vertices, segments);
  web.check(source);
  return web.rings();
}

} // namespace trime::contours
