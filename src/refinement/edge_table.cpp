// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/edge_table.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>

namespace trime::refinement {

EdgeTable::EdgeTable(const handover::LocalMesh& mesh) : mesh_(mesh), first_(mesh.points.size() + 1, 0) {
  list_edges();
  join_triangles();
}

/// Lists the higher ends at each lower end, first with those that two triangles have.
void EdgeTable::list_edges() {
  const auto for_each_side = [&](const auto& visit) {
    for (const std::array<LocalIndex, 3>& triangle : mesh_.triangles)
      for (std::size_t j = 0; j < 3; ++j) {
        const LocalIndex a = triangle[j], b = triangle[(j + 1) % 3];
        is_lower(a, b) ? visit(a, b) : visit(b, a);
      }
  };
  std::vector<LocalIndex> begin(first_.size(), 0);
  for_each_side([&](LocalIndex low, LocalIndex) { ++begin[at(low) + 1]; });
  for (std::size_t p = 1; p < begin.size(); ++p)
    begin[p] += begin[p - 1];
  std::vector<LocalIndex> ends(at(begin.back())), next(begin.begin(), begin.end() - 1);
  for_each_side([&](LocalIndex low, LocalIndex high) { ends[at(next[at(low)]++)] = high; });
  thread_loop(std::ssize(mesh_.points), 1024, [&](std::ptrdiff_t item, int) {
    const auto p = static_cast<std::size_t>(item);
    const auto from = ends.begin() + begin[p], to = ends.begin() + begin[p + 1];
    std::sort(from, to, [&](LocalIndex a, LocalIndex b) { return is_lower(a, b); });
    first_[p + 1] = static_cast<LocalIndex>(std::unique(from, to) - from);
  });
  for (std::size_t p = 1; p < first_.size(); ++p)
    first_[p] += first_[p - 1];
  lower_.resize(at(first_.back()));
  upper_.resize(at(first_.back()));
  thread_loop(std::ssize(mesh_.points), 1024, [&](std::ptrdiff_t item, int) {
    const auto p = static_cast<std::size_t>(item);
    std::copy_n(ends.begin() + begin[p], first_[p + 1] - first_[p], upper_.begin() + first_[p]);
    std::fill(lower_.begin() + first_[p], lower_.begin() + first_[p + 1], static_cast<LocalIndex>(item));
  });
}

void EdgeTable::join_triangles() {
  edges_.resize(mesh_.triangles.size());
  thread_loop(std::ssize(mesh_.triangles), 1024, [&](std::ptrdiff_t item, int) {
    const auto t = static_cast<std::size_t>(item);
    for (std::size_t j = 0; j < 3; ++j)
      edges_[t][j] = find(mesh_.triangles[t][j], mesh_.triangles[t][(j + 1) % 3]);
  });
  triangles_.assign(at(size()), {-1, -1});
  for (std::size_t t = 0; t < edges_.size(); ++t)
    for (const LocalIndex edge : edges_[t]) {
      std::array<LocalIndex, 2>& of_edge = triangles_[at(edge)];
      if (of_edge[0] < 0)
        of_edge[0] = static_cast<LocalIndex>(t);
      else
        of_edge[1] = of_edge[1] == -1 ? static_cast<LocalIndex>(t) : -2;
    }
}

LocalIndex EdgeTable::find(LocalIndex a, LocalIndex b) const {
  const LocalIndex low = is_lower(a, b) ? a : b, high = low == a ? b : a;
  for (LocalIndex edge = first_[at(low)]; edge < first_[at(low) + 1]; ++edge)
    if (upper_[at(edge)] == high)
      return edge;
  return -1;
}

} // namespace trime::refinement
