// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/split_curves.hpp"

#include "comm/agree.hpp"
#include "extraction/extraction.hpp"
#include "splitting/sectors.hpp"
#include "splitting/split_paths.hpp"

#include <algorithm>
#include <numeric>

namespace trime::splitting {
namespace {

using Ends = std::array<GlobalId, 2>;

/// Questions about the ends of edges. Only ends on split curves need an answer of their ranks.
class EndQuestions {
public:
  explicit EndQuestions(const SplitEdges& edges) : edges_(edges) {}

  /// Asks for the copies of both ends that lie on the left of an edge.
  void ask_left_of(const Ends& ends) {
    ask({ends[0], ends[1], 0});
    ask({ends[1], ends[0], 1});
  }
  void ask(const Question& question) {
    is_asked_.push_back(edges_.has_point(question.point) ? 1 : 0);
    points_.push_back(question.point);
    if (is_asked_.back() != 0)
      questions_.push_back(question);
  }
  /// Returns the new ids, in the order of the questions. Collective.
  std::vector<GlobalId> new_ids(const Sectors& sectors) const {
    const std::vector<std::int32_t> copies = sectors.answer(questions_);
    std::vector<GlobalId> ids;
    ids.reserve(points_.size());
    std::size_t answered = 0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      ids.push_back(sectors.new_id(points_[k], is_asked_[k] != 0 ? copies[answered++] : 0));
    return ids;
  }

private:
  const SplitEdges& edges_;
  std::vector<char> is_asked_;
  std::vector<GlobalId> points_;
  std::vector<Question> questions_;
};

/// Reorders a list: entry k of the result is entry order[k].
template <class List>
void reorder(List& list, const std::vector<std::size_t>& order) {
  if (list.empty())
    return;
  List sorted;
  sorted.reserve(list.size());
  for (const std::size_t k : order)
    sorted.push_back(list[k]);
  list = std::move(sorted);
}

/// Returns the order in which `comes_before(a, b)` holds for positions a and b.
template <class Before>
std::vector<std::size_t> order_by(std::size_t count, const Before& comes_before) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), comes_before);
  return order;
}

class Splitter {
public:
  Splitter(const comm::Communicator& comm, const SplitInput& input, mesh::DistributedMesh& mesh)
      : comm_(comm), input_(input), mesh_(mesh), edges_(split_edges(comm, mesh, input.kinds)),
        sectors_(comm, mesh, edges_) {}

  SplitLoops run() {
    find_sides();
    std::vector<Ends> facets = renamed_facets();
    std::vector<std::array<GlobalId, 3>> triangles = renamed_triangles();
    rename_inner_edges();
    copy_points();
    set_triangles(triangles);
    set_facets(std::move(facets));
    set_pairs();
    extraction::place_among_all(comm_, mesh_);
    return find_split_loops(comm_, mesh_, input_.parts, input_.loops);
  }

private:
  /// Both sides of the split edges, on all ranks.
  void find_sides() {
    EndQuestions questions(edges_);
    for (std::size_t k = edges_.first; k < edges_.last; ++k) {
      const auto [a, b] = edges_.all[k].ends;
      questions.ask_left_of({a, b});
      questions.ask_left_of({b, a});
    }
    const std::vector<GlobalId> ids = questions.new_ids(sectors_);
    std::vector<EdgeSides> here;
    for (std::size_t k = 0; k < ids.size(); k += 4)
      here.push_back({{ids[k], ids[k + 1]}, {ids[k + 3], ids[k + 2]}});
    sides_ = comm::gather_everywhere(comm_, std::move(here));
    for (std::size_t k = 0; k < edges_.all.size(); ++k)
      if (sides_[k].are_apart()) {
        const auto [a, b] = edges_.all[k].ends;
        apart_.push_back({std::min(a, b), std::max(a, b)});
      }
    std::sort(apart_.begin(), apart_.end());
  }
  bool is_apart(const Ends& edge) const {
    return std::binary_search(apart_.begin(), apart_.end(),
                              Ends{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
  }

  std::vector<Ends> renamed_facets() const {
    EndQuestions questions(edges_);
    for (const Ends& facet : mesh_.facets)
      questions.ask_left_of(facet);
    return pairs_of(questions.new_ids(sectors_));
  }
  static std::vector<Ends> pairs_of(const std::vector<GlobalId>& ids) {
    std::vector<Ends> pairs;
    for (std::size_t k = 0; k < ids.size(); k += 2)
      pairs.push_back({ids[k], ids[k + 1]});
    return pairs;
  }

  /// Vertices with another name stay in their order, since the copies of a point have no other point among them.
  std::vector<std::array<GlobalId, 3>> renamed_triangles() const {
    const std::vector<char> is_split = split_vertices(mesh_, edges_);
    std::vector<GlobalId> first_copy(is_split.size()); // by local vertex
    for (std::size_t v = 0; v < first_copy.size(); ++v)
      first_copy[v] = sectors_.new_id(mesh_.global_id(static_cast<LocalIndex>(v)));
    std::vector<std::array<GlobalId, 3>> triangles(mesh_.triangles.size());
    std::vector<Question> questions;
    std::vector<GlobalId*> asked;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const LocalIndex vertex = mesh_.triangles[t][k];
        triangles[t][k] = first_copy[at(vertex)];
        if (is_split[at(vertex)] != 0) {
          questions.push_back({mesh_.global_id(vertex), mesh_.global_id(mesh_.triangles[t][(k + 1) % 3]), 0});
          asked.push_back(&triangles[t][k]);
        }
      }
    const std::vector<std::int32_t> copies = sectors_.answer(questions);
    for (std::size_t k = 0; k < copies.size(); ++k)
      *asked[k] += copies[k];
    return triangles;
  }

  /// Edges on curves and interfaces that are not apart. Both of their triangles have the same copies.
  void rename_inner_edges() {
    std::vector<std::size_t> curves, interfaces;
    EndQuestions questions(edges_);
    for (std::size_t k = 0; k < mesh_.curve_edges.size(); ++k)
      if (!is_apart(mesh_.curve_edges[k])) {
        curves.push_back(k);
        questions.ask_left_of(mesh_.curve_edges[k]);
      }
    for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k)
      if (!is_apart(mesh_.interfaces[k])) {
        interfaces.push_back(k);
        questions.ask_left_of(mesh_.interfaces[k]);
      }
    const std::vector<Ends> renamed = pairs_of(questions.new_ids(sectors_));
    const auto middle = renamed.begin() + std::ssize(curves);
    mesh_.curve_edges.assign(renamed.begin(), middle);
    mesh_.interfaces.assign(middle, renamed.end());
    reorder(mesh_.curve_numbers, curves);
    reorder(mesh_.interface_regions, interfaces);
    reorder(mesh_.interface_pairs, interfaces);
    reorder(mesh_.interface_curves, interfaces);
  }

  /// Puts the copies of each point of this rank behind it. Points of split curves lie on the boundary.
  void copy_points() {
    const GlobalId first = mesh_.point_slab.first, end = first + std::ssize(mesh_.points);
    std::vector<std::size_t> originals;
    std::vector<char> is_split;
    std::size_t next = 0;
    const std::span<const SplitPoint> points = sectors_.points();
    while (next < points.size() && points[next].id < first)
      ++next;
    for (GlobalId id = first; id < end; ++id) {
      const bool is_here = next < points.size() && points[next].id == id;
      for (std::int64_t copy = 0; copy < (is_here ? points[next].copies : 1); ++copy)
        originals.push_back(static_cast<std::size_t>(id - first));
      is_split.resize(originals.size(), is_here ? 1 : 0);
      next += is_here ? 1 : 0;
    }
    reorder(mesh_.points, originals);
    reorder(mesh_.boundary, originals);
    reorder(mesh_.size, originals);
    reorder(mesh_.fixed, originals);
    mesh_.point_slab = {sectors_.new_id(first), mesh_.point_slab.total + sectors_.additional()};
    mark_boundary(is_split);
  }

  /// Marks the points of split edges as points on the boundary; their loops are found later.
  void mark_boundary(const std::vector<char>& is_split) {
    constexpr std::int32_t some_loop = -1;
    std::vector<GlobalId> on_sides;
    for (const EdgeSides& sides : sides_)
      if (sides.are_apart())
        on_sides.insert(on_sides.end(), {sides.left[0], sides.left[1], sides.right[0], sides.right[1]});
    std::sort(on_sides.begin(), on_sides.end());
    for (std::size_t i = 0; i < is_split.size(); ++i)
      if (is_split[i] != 0 && mesh_.boundary[i] == 0 &&
          std::binary_search(on_sides.begin(), on_sides.end(), mesh_.point_slab.first + static_cast<GlobalId>(i)))
        mesh_.boundary[i] = some_loop;
  }

  void set_triangles(std::vector<std::array<GlobalId, 3>>& triangles) {
    const std::vector<std::size_t> order =
        order_by(triangles.size(), [&](std::size_t a, std::size_t b) { return triangles[a] < triangles[b]; });
    reorder(triangles, order);
    reorder(mesh_.alpha, order);
    reorder(mesh_.beta, order);
    reorder(mesh_.region, order);
    mesh::assign_triangles(mesh_, triangles);
  }

  /// Adds both sides of the edges that this rank has listed, and sorts all facets by their lower and higher ends.
  void set_facets(std::vector<Ends> facets) {
    mesh_.facets = std::move(facets);
    comm::run_agreed(comm_, [&] { // the size field is the user's
      for (std::size_t k = edges_.first; k < edges_.last; ++k) {
        const EdgeSides& sides = sides_[k];
        if (!sides.are_apart())
          continue;
        const auto [a, b] = edges_.all[k].ends;
        const auto size = static_cast<float>(input_.asked.size(0.5 * (place_of(a) + place_of(b))));
        for (const Ends& facet : {sides.left, Ends{sides.right[1], sides.right[0]}}) {
          mesh_.facets.push_back(facet);
          mesh_.facet_tags.push_back(0);
          mesh_.facet_parts.push_back(input_.parts + edges_.all[k].curve);
          mesh_.facet_sizes.push_back(size);
        }
      }
    });
    const auto key = [&](std::size_t k) {
      const auto [a, b] = mesh_.facets[k];
      return Ends{std::min(a, b), std::max(a, b)};
    };
    const std::vector<std::size_t> order =
        order_by(mesh_.facets.size(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    reorder(mesh_.facets, order);
    reorder(mesh_.facet_tags, order);
    reorder(mesh_.facet_parts, order);
    reorder(mesh_.facet_sizes, order);
  }
  /// The place of a point by its old id.
  geometry::Vec2 place_of(GlobalId id) const {
    const std::span<const SplitPoint> points = sectors_.points();
    return std::lower_bound(points.begin(), points.end(), id,
                            [](const SplitPoint& point, GlobalId wanted) { return point.id < wanted; })
        ->place;
  }

  /// Each rank keeps an equal share of the pairs, which all of them know.
  void set_pairs() {
    const std::vector<SplitPair> pairs = split_pairs(edges_.all, sides_);
    const std::int64_t total = std::ssize(pairs);
    mesh_.split_slab = {total * comm_.rank() / comm_.size(), total};
    for (std::int64_t k = mesh_.split_slab.first; k < total * (comm_.rank() + 1) / comm_.size(); ++k) {
      const SplitPair& pair = pairs[static_cast<std::size_t>(k)];
      mesh_.split_pairs.push_back(pair.points);
      mesh_.split_curves.push_back(pair.curve);
      mesh_.split_paths.push_back(pair.path);
    }
  }

  const comm::Communicator& comm_;
  const SplitInput& input_;
  mesh::DistributedMesh& mesh_;
  const SplitEdges edges_;
  const Sectors sectors_; // of the mesh before the split
  std::vector<EdgeSides> sides_;
  std::vector<Ends> apart_; // edges that become two, by their old ids, ascending
};

} // namespace

bool any_split(const std::vector<geometry::CurveKind>& kinds) {
  return std::any_of(kinds.begin(), kinds.end(), [](const geometry::CurveKind& kind) { return kind.split; });
}

SplitLoops split_curves(const comm::Communicator& comm, const SplitInput& input, mesh::DistributedMesh& mesh) {
  return Splitter(comm, input, mesh).run();
}

mesh::Check split_check(const mesh::DistributedMesh& mesh, const std::vector<polygon::LoopSummary>& loops) {
  const auto outer = std::count_if(loops.begin(), loops.end(), [](const polygon::LoopSummary& loop) {
    return loop.kind == polygon::LoopSummary::Kind::outer;
  });
  const std::int64_t expected = 2 * outer - std::ssize(loops);
  const std::int64_t triangles = mesh.triangle_slab.total;
  const std::int64_t edges = (3 * triangles + mesh.facet_slab.total) / 2;
  const std::int64_t found = mesh.point_slab.total - edges + triangles;
  return {"split_euler_characteristic", static_cast<double>(expected), static_cast<double>(found), expected == found,
          "points - edges + triangles after curves were split: outer loops - holes; the other checks are those of the "
          "mesh before"};
}

} // namespace trime::splitting
