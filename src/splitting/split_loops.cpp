// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/split_loops.hpp"

#include "comm/agree.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::splitting {
namespace {

using polygon::LoopSummary;

/// A boundary edge, as all ranks know it.
struct Edge {
  std::array<GlobalId, 2> ends;
  std::int32_t tag, part; // tag before the split, 0 for a side of a split curve
};
/// A point on the boundary.
struct PlacedPoint {
  GlobalId id;
  geometry::Vec2 place;
};

class LoopFinder {
public:
  LoopFinder(const comm::Communicator& comm, mesh::DistributedMesh& mesh, std::int32_t parts,
             const std::vector<LoopSummary>& before)
      : mesh_(mesh), parts_(parts), before_(before) {
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < mesh.facets.size(); ++k)
      edges.push_back({mesh.facets[k], mesh.facet_tags[k], mesh.facet_parts[k]});
    edges_ = comm::gather_everywhere(comm, std::move(edges));
    std::vector<PlacedPoint> points;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      if (mesh.boundary[i] != 0)
        points.push_back({mesh.point_slab.first + static_cast<GlobalId>(i), mesh.points[i]});
    points_ = comm::gather_everywhere(comm, std::move(points));
  }

  SplitLoops run() {
    follow_edges();
    SplitLoops found;
    std::set<std::int32_t> used;
    std::int32_t last = 0;
    for (const LoopSummary& loop : before_) {
      last = std::max(last, loop.tag);
      if (!changed_tags_.contains(loop.tag)) {
        used.insert(loop.tag);
        found.loops.push_back(loop);
      }
    }
    std::vector<std::int32_t> tag_of(loops_.size(), 0);
    for (std::size_t k = 0; k < loops_.size(); ++k) {
      const std::set<std::int32_t> old = old_tags(loops_[k]);
      if (!is_changed(loops_[k])) {
        tag_of[k] = *old.begin();
        continue;
      }
      const auto free = std::find_if(old.begin(), old.end(), [&](std::int32_t tag) { return !used.contains(tag); });
      tag_of[k] = free != old.end() ? *free : ++last;
      used.insert(tag_of[k]);
      for (const std::int32_t tag : old)
        found.new_tags[tag].insert(tag_of[k]);
      found.loops.push_back(summary_of(loops_[k], tag_of[k]));
    }
    std::sort(found.loops.begin(), found.loops.end(),
              [](const LoopSummary& a, const LoopSummary& b) { return a.tag < b.tag; });
    set_tags(tag_of);
    return found;
  }

private:
  using EdgeLoop = std::vector<std::size_t>; // numbers of its edges, in order

  bool is_side(std::size_t edge) const { return edges_[edge].part >= parts_; }
  bool is_changed(const EdgeLoop& loop) const {
    return std::any_of(loop.begin(), loop.end(), [this](std::size_t edge) { return is_side(edge); });
  }
  std::set<std::int32_t> old_tags(const EdgeLoop& loop) const {
    std::set<std::int32_t> tags;
    for (const std::size_t edge : loop)
      if (!is_side(edge))
        tags.insert(edges_[edge].tag);
    return tags;
  }

  /// Lists the loops by their lowest points. Since all copies are apart, one edge begins at each point.
  void follow_edges() {
    std::map<GlobalId, std::size_t> from;
    for (std::size_t k = 0; k < edges_.size(); ++k)
      if (!from.emplace(edges_[k].ends[0], k).second)
        throw InternalError(
            fmt::format("two boundary edges begin at point {} after curves were split", edges_[k].ends[0]));
    std::vector<char> seen(edges_.size(), 0);
    for (const auto& [point, first] : from) {
      EdgeLoop loop;
      for (std::size_t k = first; seen[k] == 0;) {
        seen[k] = 1;
        loop.push_back(k);
        const auto next = from.find(edges_[k].ends[1]);
        if (next == from.end())
          throw InternalError(
              fmt::format("no boundary edge goes on at point {} after curves were split", edges_[k].ends[1]));
        k = next->second;
      }
      if (loop.empty())
        continue;
      if (is_changed(loop))
        changed_tags_.merge(old_tags(loop));
      loops_.push_back(std::move(loop));
    }
  }

  geometry::Vec2 place(GlobalId id) const {
    const auto found = std::lower_bound(points_.begin(), points_.end(), id,
                                        [](const PlacedPoint& point, GlobalId wanted) { return point.id < wanted; });
    if (found == points_.end() || found->id != id)
      throw InternalError(fmt::format("point {} is the end of a boundary edge, but does not lie on the boundary", id));
    return found->place;
  }

  /// Twice the area on the left of a loop. The two sides of a crack enclose nothing, so they are left out: rounding
  /// cannot give a crack an area.
  double twice_area(const EdgeLoop& loop) const {
    std::map<std::array<double, 4>, int> sides; // of split curves, by their ends
    const auto ends_of = [this](std::size_t edge) {
      const geometry::Vec2 a = place(edges_[edge].ends[0]), b = place(edges_[edge].ends[1]);
      return std::array{a.x, a.y, b.x, b.y};
    };
    for (const std::size_t edge : loop)
      if (is_side(edge))
        ++sides[ends_of(edge)];
    const geometry::Vec2 origin = place(edges_[loop[0]].ends[0]);
    double area = 0;
    for (const std::size_t edge : loop) {
      const auto [ax, ay, bx, by] = ends_of(edge);
      if (!is_side(edge) || !sides.contains(std::array{bx, by, ax, ay}))
        area += geometry::cross(geometry::Vec2{ax, ay} - origin, geometry::Vec2{bx, by} - origin);
    }
    return area;
  }

  LoopSummary summary_of(const EdgeLoop& loop, std::int32_t tag) const {
    LoopSummary summary;
    summary.tag = tag;
    summary.kind = twice_area(loop) > 0 ? LoopSummary::Kind::outer : LoopSummary::Kind::hole;
    summary.edges = std::ssize(loop);
    for (const std::size_t edge : loop) {
      summary.length += geometry::length(place(edges_[edge].ends[1]) - place(edges_[edge].ends[0]));
      if (std::find(summary.parts.begin(), summary.parts.end(), edges_[edge].part) == summary.parts.end())
        summary.parts.push_back(edges_[edge].part);
    }
    return summary;
  }

  void set_tags(const std::vector<std::int32_t>& tag_of) {
    const auto first_facet = static_cast<std::size_t>(mesh_.facet_slab.first);
    const GlobalId first_point = mesh_.point_slab.first, end_point = first_point + std::ssize(mesh_.points);
    for (std::size_t k = 0; k < loops_.size(); ++k)
      for (const std::size_t edge : loops_[k]) {
        if (edge >= first_facet && edge - first_facet < mesh_.facets.size())
          mesh_.facet_tags[edge - first_facet] = tag_of[k];
        if (const GlobalId point = edges_[edge].ends[0]; point >= first_point && point < end_point)
          mesh_.boundary[static_cast<std::size_t>(point - first_point)] = tag_of[k];
      }
  }

  mesh::DistributedMesh& mesh_;
  const std::int32_t parts_;
  const std::vector<LoopSummary>& before_;
  std::vector<Edge> edges_; // of all ranks, in the order of the facets
  std::vector<PlacedPoint> points_;
  std::vector<EdgeLoop> loops_;
  std::set<std::int32_t> changed_tags_; // of loops that a split curve meets
};

} // namespace

SplitLoops find_split_loops(const comm::Communicator& comm, mesh::DistributedMesh& mesh, std::int32_t parts,
                            const std::vector<polygon::LoopSummary>& before) {
  LoopFinder finder(comm, mesh, parts, before);
  SplitLoops found;
  comm::run_agreed(comm, [&] { found = finder.run(); });
  return found;
}

} // namespace trime::splitting
