// SPDX-License-Identifier: BSD-3-Clause
#include "contours/open_lines.hpp"

#include "contours/rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trime::contours {
namespace {

using geometry::Vec2;

/// The places where lines end, and the lines at each place.
class Ends {
public:
  explicit Ends(const std::vector<LineEnds>& lines) : lines_(lines), nodes_(lines.size()) {
    std::vector<std::size_t> order(2 * lines.size()); // end 2 k is the first one of line k
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return geometry::lexicographically_less(end(a).position, end(b).position);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k == 0 || end(order[k]).position != end(order[k - 1]).position)
        arms_.emplace_back();
      arms_.back().push_back(order[k] / 2);
      nodes_[order[k] / 2][order[k] % 2] = arms_.size() - 1;
    }
    left_.assign(lines.size(), 1);
    for (const std::vector<std::size_t>& arms : arms_)
      degree_.push_back(arms.size());
  }

  /// Returns the lines that hang together with a line, ascending.
  std::vector<std::size_t> group_of(std::size_t first, std::vector<char>& seen) const {
    std::vector<std::size_t> group{first};
    seen[first] = 1;
    for (std::size_t next = 0; next < group.size(); ++next)
      for (const std::size_t node : nodes_[group[next]])
        for (const std::size_t line : arms_[node])
          if (seen[line] == 0) {
            seen[line] = 1;
            group.push_back(line);
          }
    std::sort(group.begin(), group.end());
    return group;
  }

  /// Takes lines with a free end out, again and again, and returns those that are out.
  std::vector<std::size_t> take_free(const std::vector<std::size_t>& group) {
    std::vector<std::size_t> out, again = group;
    while (!again.empty()) {
      const std::size_t line = again.back();
      again.pop_back();
      const auto [a, b] = nodes_[line];
      if (left_[line] == 0 || (degree_[a] != 1 && degree_[b] != 1))
        continue;
      left_[line] = 0;
      out.push_back(line);
      for (const std::size_t node : nodes_[line]) {
        if (--degree_[node] == 1) // the last line has a free end now
          again.insert(again.end(), arms_[node].begin(), arms_[node].end());
      }
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  /// Calls visit(line, end, degree) for both ends of each line.
  template <class Visit>
  void for_each_end(const std::vector<std::size_t>& group, const Visit& visit) const {
    for (const std::size_t line : group)
      for (std::size_t k = 0; k < 2; ++k)
        visit(line, end(2 * line + k), degree_[nodes_[line][k]]);
  }

private:
  const FilePoint& end(std::size_t k) const { return k % 2 == 0 ? lines_[k / 2].first : lines_[k / 2].last; }

  const std::vector<LineEnds>& lines_;
  std::vector<std::array<std::size_t, 2>> nodes_; // of each line
  std::vector<std::vector<std::size_t>> arms_;    // lines at each node
  std::vector<std::size_t> degree_;               // of each node, without the lines that are out
  std::vector<char> left_;
};

/// Returns whether the group has two free ends that are near each other.
bool is_nearly_closed(const std::vector<LineEnds>& lines, const std::vector<std::size_t>& group,
                      const std::vector<Vec2>& free_ends) {
  if (free_ends.size() != 2)
    return false;
  geometry::Box box;
  for (const std::size_t line : group)
    box = geometry::united(box, lines[line].box);
  return length(free_ends[0] - free_ends[1]) <= ContourRules::nearly_closed * std::hypot(box.width(), box.height());
}

} // namespace

std::vector<OpenGroup> open_groups(const std::vector<LineEnds>& lines) {
  Ends ends(lines);
  std::vector<OpenGroup> groups;
  std::vector<char> seen(lines.size(), 0);
  for (std::size_t first = 0; first < lines.size(); ++first) {
    if (seen[first] != 0)
      continue;
    const std::vector<std::size_t> group = ends.group_of(first, seen);
    OpenGroup found{};
    std::vector<Vec2> free_ends;
    bool is_open = false;
    const auto note = [&](std::size_t line, const FilePoint& end) {
      if (!is_open || end.line < found.end.line) {
        found.line = line;
        found.end = end;
      }
      is_open = true;
    };
    ends.for_each_end(group, [&](std::size_t line, const FilePoint& end, std::size_t degree) {
      if (degree != 1)
        return;
      free_ends.push_back(end.position);
      note(line, end);
    });
    found.nearly_closed = is_nearly_closed(lines, group, free_ends);
    found.left_out = ends.take_free(group);
    ends.for_each_end(group, [&](std::size_t line, const FilePoint& end, std::size_t degree) {
      if (degree % 2 != 0 && !found.branches) {
        is_open = false;
        note(line, end);
        found.branches = true;
      }
    });
    if (found.branches)
      found.left_out = group;
    if (is_open)
      groups.push_back(std::move(found));
  }
  return groups;
}

Fault fault_of(const OpenGroup& group, const std::string& where) {
  const Vec2 p = group.end.position;
  constexpr const char* expected =
      "expected polygons, or lines that end where they start or where another line ends; found";
  if (group.branches)
    return {where,
            fmt::format("{} an odd number of lines that end at ({}, {}), so that it is not clear which of them are the "
                        "boundary",
                        expected, p.x, p.y),
            "remove the lines inside the area, or make polygons", ""};
  const std::string what = fmt::format("{} a line whose end at ({}, {}) no other line shares{}", expected, p.x, p.y,
                                       group.nearly_closed ? ", although it comes back to near its start" : "");
  if (group.nearly_closed)
    return {where, what, "close the ring, or make it a polygon", ""};
  return {where, what, "close the ring, or make it a polygon",
          group.left_out.size() == 1
              ? std::string("the line is left out")
              : fmt::format("the {} lines that hang together with it are left out", group.left_out.size())};
}

} // namespace trime::contours
