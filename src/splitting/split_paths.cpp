// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/split_paths.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace trime::splitting {
namespace {

using Start = std::tuple<std::int32_t, GlobalId, GlobalId>; // curve, copies on the left and on the right

/// Follows the edges from start to end.
class PathFinder {
public:
  PathFinder(const std::vector<SplitEdge>& edges, const std::vector<EdgeSides>& sides) : edges_(edges), sides_(sides) {
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (sides[k].are_apart() && is_pair(k, 0))
        from_.emplace(at(k, 0), k);
  }

  std::vector<SplitPair> run() {
    std::vector<char> has_previous(edges_.size(), 0);
    for (std::size_t k = 0; k < edges_.size(); ++k)
      if (const auto next = after(k); next != from_.end())
        has_previous[next->second] = 1;
    done_.assign(edges_.size(), 0);
    std::vector<std::vector<SplitPair>> paths;
    for (const bool rings : {false, true})
      for (std::size_t k = 0; k < edges_.size(); ++k)
        if (done_[k] == 0 && sides_[k].are_apart() && (rings || has_previous[k] == 0))
          paths.push_back(follow(k));
    std::stable_sort(paths.begin(), paths.end(),
                     [](const auto& a, const auto& b) { return a.front().curve < b.front().curve; });
    std::vector<SplitPair> pairs;
    for (std::size_t path = 0; path < paths.size(); ++path)
      for (SplitPair& pair : paths[path]) {
        pair.path = static_cast<std::int32_t>(path);
        pairs.push_back(pair);
      }
    return pairs;
  }

private:
  using Edges = std::map<Start, std::size_t>;

  Start at(std::size_t edge, std::size_t end) const {
    return {edges_[edge].curve, sides_[edge].left[end], sides_[edge].right[end]};
  }
  bool is_pair(std::size_t edge, std::size_t end) const { return sides_[edge].left[end] != sides_[edge].right[end]; }
  Edges::const_iterator after(std::size_t edge) const {
    return is_pair(edge, 1) ? from_.find(at(edge, 1)) : from_.end();
  }

  std::vector<SplitPair> follow(std::size_t first) {
    std::vector<SplitPair> path;
    const auto add = [&](std::size_t edge, std::size_t end) {
      if (is_pair(edge, end))
        path.push_back({{sides_[edge].left[end], sides_[edge].right[end]}, edges_[edge].curve, 0});
    };
    add(first, 0);
    for (std::size_t k = first;;) {
      done_[k] = 1;
      const auto next = after(k);
      if (next != from_.end() && next->second == first) // a ring, whose first pair is listed already
        break;
      add(k, 1);
      if (next == from_.end())
        break;
      k = next->second;
    }
    return path;
  }

  const std::vector<SplitEdge>& edges_;
  const std::vector<EdgeSides>& sides_;
  Edges from_; // by the copies at their first ends
  std::vector<char> done_;
};

} // namespace

std::vector<SplitPair> split_pairs(const std::vector<SplitEdge>& edges, const std::vector<EdgeSides>& sides) {
  return PathFinder(edges, sides).run();
}

} // namespace trime::splitting
