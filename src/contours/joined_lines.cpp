// SPDX-License-Identifier: BSD-3-Clause
#include "contours/joined_lines.hpp"

#include "contours/date_line.hpp"
#include "contours/map_features.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace trime::contours {
namespace {

using geometry::Vec2;

/// [degrees] Only an edge that is shorter obviously crosses the date line once -180 is 180.
constexpr double obvious = 90;

/// Two places, the smaller one first: equal for edges, or ends of lines, in both directions.
using Pair = std::array<double, 4>;

Pair pair_of(Vec2 a, Vec2 b) {
  if (geometry::lexicographically_less(b, a))
    std::swap(a, b);
  return {a.x, a.y, b.x, b.y};
}

bool same_vertices(const OpenLine& a, const OpenLine& b) {
  const auto same = [](const FilePoint& p, const FilePoint& q) { return p.position == q.position; };
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same) ||
         std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.rbegin(), b.vertices.rend(), same);
}

std::string place_of(const Contour& contour, const OpenLine& line) {
  return place_of_line(contour, line.vertices.front().line, line.label);
}

/// Does an edge occur twice, in one line or in two?
bool has_repeated_edge(const std::vector<OpenLine>& lines) {
  std::vector<Pair> edges;
  for (const OpenLine& line : lines)
    for (std::size_t k = 1; k < line.vertices.size(); ++k)
      edges.push_back(pair_of(line.vertices[k - 1].position, line.vertices[k].position));
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
}

int line_or_feature_of(const OpenLine& line, const FilePoint& vertex) {
  return line.feature > 0 ? line.feature : vertex.line;
}

std::vector<std::vector<RingVertex>> rings_of_edges(const std::vector<OpenLine>& lines, Contour& contour) {
  std::vector<FileVertex> vertices;
  std::vector<FileSegment> segments;
  for (const OpenLine& line : lines)
    for (std::size_t k = 0; k < line.vertices.size(); ++k) {
      const FilePoint& vertex = line.vertices[k];
      const int index = static_cast<int>(vertices.size());
      if (k > 0)
        segments.push_back({index - 1, index, line.marker, vertex.line});
      vertices.push_back({vertex.position, line_or_feature_of(line, vertex), index + 1});
    }
  return rings_of_segments(vertices, segments, contour.source, contour.warnings);
}

/// The lines as edges of a graph, between the places where they end.
class LineWalk {
public:
  explicit LineWalk(const std::vector<OpenLine>& lines) : lines_(lines), nodes_(lines.size()), used_(lines.size(), 0) {
    std::map<std::pair<double, double>, std::size_t> numbers;
    for (std::size_t k = 0; k < lines.size(); ++k)
      for (const bool last : {false, true}) {
        const Vec2 p = last ? lines[k].vertices.back().position : lines[k].vertices.front().position;
        const std::size_t node = numbers.try_emplace({p.x, p.y}, numbers.size()).first->second;
        if (node == arms_.size())
          arms_.emplace_back();
        arms_[node].push_back(k);
        nodes_[k][last ? 1 : 0] = node;
      }
    next_.assign(arms_.size(), 0);
  }

  std::vector<std::vector<RingVertex>> rings() {
    std::vector<std::vector<RingVertex>> found;
    std::vector<std::size_t> place(arms_.size(), none); // on the path
    std::vector<Step> path;
    for (std::size_t first = 0; first < lines_.size(); ++first) {
      if (used_[first] != 0)
        continue;
      std::size_t here = nodes_[first][0], by = first;
      do { // the number of lines at each node is even: there is a way on until the first node is reached
        used_[by] = 1;
        place[here] = path.size();
        path.push_back({here, by});
        here = nodes_[by][nodes_[by][0] == here ? 1 : 0];
        if (place[here] != none) { // a ring is closed
          const auto begin = path.begin() + static_cast<std::ptrdiff_t>(place[here]);
          found.emplace_back();
          for (auto step = begin; step != path.end(); ++step) {
            append(*step, found.back());
            place[step->node] = none;
          }
          path.erase(begin, path.end());
        }
        by = unused_at(here);
      } while (!path.empty() && by != none);
    }
    return found;
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Step {
    std::size_t node, line; // which leaves it
  };

  std::size_t unused_at(std::size_t node) {
    const std::vector<std::size_t>& arms = arms_[node];
    for (std::size_t& k = next_[node]; k < arms.size(); ++k)
      if (used_[arms[k]] == 0)
        return arms[k];
    return none;
  }

  /// Appends the vertices of a line without the last one.
  void append(const Step& step, std::vector<RingVertex>& ring) const {
    const OpenLine& line = lines_[step.line];
    const std::size_t n = line.vertices.size();
    const bool forward = nodes_[step.line][0] == step.node;
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const FilePoint& vertex = line.vertices[forward ? k : n - 1 - k];
      ring.push_back({vertex.position, line_or_feature_of(line, vertex), line.marker});
    }
  }

  const std::vector<OpenLine>& lines_;
  std::vector<std::array<std::size_t, 2>> nodes_; // of each line
  std::vector<std::vector<std::size_t>> arms_;    // lines at each node, ascending
  std::vector<std::size_t> next_;                 // of them, the first one that may be unused
  std::vector<char> used_;
};

/// An end of a line on the meridian of 180 degrees.
struct MeridianEnd {
  FilePoint* vertex;
  const FilePoint* next;
  std::size_t line;
};

} // namespace

void drop_repeated_lines(std::vector<OpenLine>& lines, Contour& contour) {
  std::map<Pair, std::vector<std::size_t>> kept; // by the ends
  std::vector<OpenLine> left;
  for (OpenLine& line : lines) {
    std::vector<std::size_t>& alike = kept[pair_of(line.vertices.front().position, line.vertices.back().position)];
    const auto first =
        std::find_if(alike.begin(), alike.end(), [&](std::size_t k) { return same_vertices(left[k], line); });
    if (first != alike.end()) {
      contour.warnings.push_back(fmt::format("{}: this line is the same as an earlier one, at {}; it is left out",
                                             place_of(contour, line), place_of(contour, left[*first])));
      continue;
    }
    alike.push_back(left.size());
    left.push_back(std::move(line));
  }
  lines = std::move(left);
}

void join_ends_at_date_line(std::vector<OpenLine>& lines, Contour& contour) {
  std::map<std::pair<double, double>, int> count; // ends at each place
  std::vector<MeridianEnd> east, west;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::vector<FilePoint>& v = lines[k].vertices;
    for (const auto& [end, next] : {std::pair{&v.front(), &v[1]}, std::pair{&v.back(), &v[v.size() - 2]}}) {
      const Vec2 p = end->position;
      ++count[{p.x, p.y}];
      if (std::fabs(std::fabs(p.x) - date_line) <= on_meridian)
        (p.x > 0 ? east : west).push_back({end, next, k});
    }
  }
  const auto is_shared = [&](const MeridianEnd& end) {
    return count.at({end.vertex->position.x, end.vertex->position.y}) > 1;
  };
  std::erase_if(east, is_shared);
  std::erase_if(west, is_shared);
  std::stable_sort(east.begin(), east.end(), [](const MeridianEnd& a, const MeridianEnd& b) {
    return a.vertex->position.y < b.vertex->position.y;
  });
  for (const MeridianEnd& end : west) {
    const double latitude = end.vertex->position.y;
    const auto partner =
        std::lower_bound(east.begin(), east.end(), latitude - on_meridian,
                         [](const MeridianEnd& other, double y) { return other.vertex->position.y < y; });
    if (partner == east.end() || partner->vertex->position.y > latitude + on_meridian || partner->line == end.line ||
        std::fabs(end.next->position.x - end.vertex->position.x) > obvious)
      continue;
    end.vertex->position = partner->vertex->position;
    contour.joins_date_line = true;
  }
}

std::vector<std::vector<RingVertex>> rings_of_lines(const std::vector<OpenLine>& lines, Contour& contour) {
  return has_repeated_edge(lines) ? LineWalk(lines).rings() : rings_of_edges(lines, contour);
}

} // namespace trime::contours
