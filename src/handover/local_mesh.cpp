// SPDX-License-Identifier: BSD-3-Clause
#include "trime/handover/local_mesh.hpp"

#include "comm/agree.hpp"
#include "comm/outbox.hpp"
#include "handover/split_pairs.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace trime::handover {
namespace {

using comm::Outbox;
using comm::send;

using geometry::Vec2;

/// A triangle on its way between ranks.
struct Triangle {
  GlobalId id;
  std::array<GlobalId, 3> vertices; // lowest first
  std::int32_t region;
};
/// A boundary edge on its way between ranks.
struct Facet {
  GlobalId id, triangle; // the triangle that it belongs to, once that is known
  std::array<GlobalId, 2> ends;
  std::int32_t tag, part;
};
/// An edge on a curve or between regions, on its way between ranks.
struct InnerEdge {
  GlobalId id;
  std::array<GlobalId, 2> ends;
  std::array<std::int32_t, 4> numbers; // the curve; or the regions on the left and right, their pair and the curve
  std::array<GlobalId, 2> triangles{-1, -1}; // on the left and on the right, once they are known
};
/// The data that a ghost gets from its owner.
struct PointValues {
  Vec2 position;
  std::int32_t boundary;
};

constexpr auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };

/// Sends the messages and appends what arrives.
template <class T>
void send_to(const comm::Communicator& comm, const Outbox<T>& outbox, std::vector<T>& list) {
  for (const comm::Message& message : send(comm, outbox)) {
    const std::vector<T> values = comm::from_bytes<T>(message.data);
    list.insert(list.end(), values.begin(), values.end());
  }
  std::sort(list.begin(), list.end(), by_id);
}

class LocalMeshMaker {
public:
  LocalMeshMaker(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, Overlap overlap)
      : comm_(comm), mesh_(mesh), overlap_(overlap), firsts_(comm.all_gather(mesh.point_slab.first)) {}

  LocalMesh make() {
    take_home();
    share_triangles();
    join_facets();
    curve_edges_ = share_inner_edges(listed_curve_edges(), mesh_.curve_slab);
    interfaces_ = share_inner_edges(listed_interfaces(), mesh_.interface_slab);
    if (overlap_ == Overlap::triangles)
      share_facets();
    else
      foreign_.clear();
    place_points();
    place_triangles();
    place_facets();
    place_curve_edges();
    place_interfaces();
    fetch_ghosts();
    return std::move(made_);
  }

private:
  bool is_owned(GlobalId point) const {
    return point >= mesh_.point_slab.first && point < mesh_.point_slab.first + std::ssize(mesh_.points);
  }
  int owner(GlobalId point) const { // ranks without points start where the next one does
    return is_owned(point)
               ? comm_.rank()
               : static_cast<int>(std::upper_bound(firsts_.begin(), firsts_.end(), point) - firsts_.begin()) - 1;
  }

  /// Triangles and facets to the owners of their lowest vertices, where a Mesher has them already.
  void take_home() {
    Outbox<Triangle> triangles_away;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Triangle triangle{mesh_.triangle_slab.first + static_cast<GlobalId>(t), mesh_.triangle_ids(t),
                              mesh_.region.empty() ? 1 : mesh_.region[t]};
      const int home = owner(triangle.vertices[0]);
      (home == comm_.rank() ? owned_ : triangles_away[home]).push_back(triangle);
    }
    send_to(comm_, triangles_away, owned_);
    Outbox<Facet> facets_away;
    for (std::size_t k = 0; k < mesh_.facets.size(); ++k) {
      const Facet facet{mesh_.facet_slab.first + static_cast<GlobalId>(k), 0, mesh_.facets[k], mesh_.facet_tags[k],
                        mesh_.facet_parts[k]};
      const int home = owner(std::min(facet.ends[0], facet.ends[1]));
      (home == comm_.rank() ? facets_ : facets_away[home]).push_back(facet);
    }
    send_to(comm_, facets_away, facets_);
  }

  /// Calls visit(rank) for each other rank that owns a vertex, once.
  template <class Visit>
  void for_each_other_owner(const Triangle& triangle, const Visit& visit) const {
    const int second = owner(triangle.vertices[1]), third = owner(triangle.vertices[2]);
    if (second != comm_.rank())
      visit(second);
    if (third != comm_.rank() && third != second)
      visit(third);
  }

  void share_triangles() {
    Outbox<Triangle> away;
    for (const Triangle& triangle : owned_)
      for_each_other_owner(triangle, [&](int rank) { away[rank].push_back(triangle); });
    send_to(comm_, away, foreign_);
  }

  /// Each facet to the owner of its triangle. All triangles at its lower end are known here.
  void join_facets() {
    std::sort(facets_.begin(), facets_.end(), [](const Facet& a, const Facet& b) { return a.ends < b.ends; });
    Outbox<Facet> away;
    std::vector<Facet> kept;
    std::size_t joined = 0;
    const auto join = [&](const Triangle& triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<GlobalId, 2> ends{triangle.vertices[k], triangle.vertices[(k + 1) % 3]};
        const GlobalId lower = std::min(ends[0], ends[1]);
        if (!is_owned(lower) || mesh_.boundary[static_cast<std::size_t>(lower - mesh_.point_slab.first)] == 0)
          continue;
        auto facet = std::lower_bound(facets_.begin(), facets_.end(), ends,
                                      [](const Facet& f, const std::array<GlobalId, 2>& e) { return f.ends < e; });
        if (facet == facets_.end() || facet->ends != ends)
          continue;
        facet->triangle = triangle.id;
        const int home = owner(triangle.vertices[0]);
        (home == comm_.rank() ? kept : away[home]).push_back(*facet);
        ++joined;
      }
    };
    std::for_each(owned_.begin(), owned_.end(), join);
    std::for_each(foreign_.begin(), foreign_.end(), join);
    comm::run_agreed(comm_, [&] {
      if (joined != facets_.size())
        throw InternalError(fmt::format("the mesh has {} boundary edges at the points of this rank, but {} of them "
                                        "belong to a triangle: it cannot be handed over",
                                        facets_.size(), joined));
    });
    facets_ = std::move(kept);
    send_to(comm_, away, facets_);
  }

  /// Facets go where their triangles went.
  void share_facets() {
    Outbox<Facet> away;
    for (const Facet& facet : facets_)
      for_each_other_owner(owned_[at(place(owned_, facet.triangle))], [&](int rank) { away[rank].push_back(facet); });
    send_to(comm_, away, foreign_facets_);
  }

  std::vector<InnerEdge> listed_curve_edges() const {
    std::vector<InnerEdge> edges;
    for (std::size_t k = 0; k < mesh_.curve_edges.size(); ++k)
      edges.push_back(
          {mesh_.curve_slab.first + static_cast<GlobalId>(k), mesh_.curve_edges[k], {mesh_.curve_numbers[k]}});
    return edges;
  }
  std::vector<InnerEdge> listed_interfaces() const {
    std::vector<InnerEdge> edges;
    for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k) {
      const auto [left, right] = mesh_.interface_regions[k];
      edges.push_back({mesh_.interface_slab.first + static_cast<GlobalId>(k),
                       mesh_.interfaces[k],
                       {left, right, mesh_.interface_pairs[k], mesh_.interface_curves[k]}});
    }
    return edges;
  }

  /// Edges inside to all ranks that hold a triangle of theirs. The owner of the lower end finds the triangles, since it
  /// knows all those around its points.
  std::vector<InnerEdge> share_inner_edges(const std::vector<InnerEdge>& listed, const mesh::Slab& slab) const {
    std::vector<InnerEdge> edges, shared;
    if (slab.total == 0)
      return edges;
    Outbox<InnerEdge> home;
    for (const InnerEdge& edge : listed)
      home[owner(std::min(edge.ends[0], edge.ends[1]))].push_back(edge);
    send_to(comm_, home, edges);
    std::sort(edges.begin(), edges.end(), [](const InnerEdge& a, const InnerEdge& b) { return a.ends < b.ends; });
    Outbox<InnerEdge> away;
    const std::vector<std::set<int>> holders = join_triangles(edges);
    for (std::size_t k = 0; k < edges.size(); ++k)
      for (const int holder : holders[k])
        away[holder].push_back(edges[k]);
    send_to(comm_, away, shared);
    std::stable_partition(shared.begin(), shared.end(),
                          [&](const InnerEdge& edge) { return find(owned_, edge.triangles[0]) >= 0; });
    return shared;
  }

  /// Sets the triangles of edges that are sorted by their ends. Returns the ranks that will hold one of these
  /// triangles.
  std::vector<std::set<int>> join_triangles(std::vector<InnerEdge>& edges) const {
    std::vector<char> has_edge(mesh_.points.size(), 0);
    for (const InnerEdge& edge : edges)
      has_edge[static_cast<std::size_t>(std::min(edge.ends[0], edge.ends[1]) - mesh_.point_slab.first)] = 1;
    std::vector<std::set<int>> holders(edges.size());
    std::size_t joined = 0;
    const auto join_side = [&](const Triangle& triangle, const std::array<GlobalId, 2>& ends, std::size_t side) {
      const auto edge =
          std::lower_bound(edges.begin(), edges.end(), ends,
                           [](const InnerEdge& e, const std::array<GlobalId, 2>& s) { return e.ends < s; });
      if (edge == edges.end() || edge->ends != ends)
        return;
      edge->triangles[side] = triangle.id;
      ++joined;
      std::set<int>& ranks = holders[static_cast<std::size_t>(edge - edges.begin())];
      for (std::size_t k = 0; k < (overlap_ == Overlap::triangles ? 3U : 1U); ++k)
        ranks.insert(owner(triangle.vertices[k]));
    };
    for (const std::vector<Triangle>* list : {&owned_, &foreign_})
      for (const Triangle& triangle : *list)
        for (std::size_t k = 0; k < 3; ++k) {
          const GlobalId from = triangle.vertices[k], to = triangle.vertices[(k + 1) % 3], lower = std::min(from, to);
          if (!is_owned(lower) || has_edge[static_cast<std::size_t>(lower - mesh_.point_slab.first)] == 0)
            continue;
          join_side(triangle, {from, to}, 0);
          join_side(triangle, {to, from}, 1);
        }
    comm::run_agreed(comm_, [&] {
      if (joined != 2 * edges.size())
        throw InternalError(
            fmt::format("the mesh has {} edges on curves or between regions at the points of this rank; "
                        "expected {} triangles next to them, found {}: it cannot be handed over",
                        edges.size(), 2 * edges.size(), joined));
    });
    return holders;
  }

  /// Returns the index of a triangle in a list, or -1.
  static LocalIndex find(const std::vector<Triangle>& list, GlobalId id) {
    const LocalIndex found = place(list, id);
    return found < std::ssize(list) && list[at(found)].id == id ? found : -1;
  }
  /// Returns the local index of a triangle, or -1.
  LocalIndex local_triangle(GlobalId id) const {
    const LocalIndex own = find(owned_, id), other = own < 0 ? find(foreign_, id) : -1;
    return own >= 0 ? own : other >= 0 ? made_.owned_triangles + other : -1;
  }

  /// Returns the index of a triangle in a list that has it.
  static LocalIndex place(const std::vector<Triangle>& list, GlobalId id) {
    const auto found = std::lower_bound(list.begin(), list.end(), id,
                                        [](const Triangle& triangle, GlobalId wanted) { return triangle.id < wanted; });
    return static_cast<LocalIndex>(found - list.begin());
  }

  void place_points() {
    made_.first_point = mesh_.point_slab.first;
    made_.total_points = mesh_.point_slab.total;
    made_.total_triangles = mesh_.triangle_slab.total;
    made_.owned_points = static_cast<LocalIndex>(mesh_.points.size());
    made_.points.assign(mesh_.points.begin(), mesh_.points.end());
    made_.boundary.assign(mesh_.boundary.begin(), mesh_.boundary.end());
    std::vector<GlobalId>& ghosts = made_.ghost_ids;
    for (const std::vector<Triangle>* list : {&owned_, &foreign_})
      for (const Triangle& triangle : *list)
        for (const GlobalId vertex : triangle.vertices)
          if (!is_owned(vertex))
            ghosts.push_back(vertex);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    for (const GlobalId ghost : ghosts)
      made_.ghost_owners.push_back(owner(ghost));
    const std::size_t most = std::max(mesh_.points.size() + ghosts.size(), owned_.size() + foreign_.size());
    TRIME_ASSERT(most <= std::size_t{std::numeric_limits<LocalIndex>::max()},
                 "a rank has {} points or triangles, more than a local index can count", most);
  }

  LocalIndex local(GlobalId point) const {
    if (is_owned(point))
      return static_cast<LocalIndex>(point - made_.first_point);
    const auto found = std::lower_bound(made_.ghost_ids.begin(), made_.ghost_ids.end(), point);
    return made_.owned_points + static_cast<LocalIndex>(found - made_.ghost_ids.begin());
  }

  void place_triangles() {
    made_.owned_triangles = static_cast<LocalIndex>(owned_.size());
    for (const std::vector<Triangle>* list : {&owned_, &foreign_})
      for (const auto& [id, vertices, region] : *list) {
        made_.triangles.push_back({local(vertices[0]), local(vertices[1]), local(vertices[2])});
        made_.triangle_ids.push_back(id);
        made_.regions.push_back(region);
      }
    if (std::all_of(made_.regions.begin(), made_.regions.end(), [](std::int32_t region) { return region == 1; }))
      made_.regions.clear();
  }

  void place_facets() {
    made_.owned_facets = static_cast<LocalIndex>(facets_.size());
    const auto add = [&](const Facet& facet, LocalIndex triangle) {
      made_.facets.push_back({local(facet.ends[0]), local(facet.ends[1])});
      made_.facet_triangles.push_back(triangle);
      made_.facet_tags.push_back(facet.tag);
      made_.facet_parts.push_back(facet.part);
    };
    for (const Facet& facet : facets_)
      add(facet, place(owned_, facet.triangle));
    for (const Facet& facet : foreign_facets_)
      add(facet, made_.owned_triangles + place(foreign_, facet.triangle));
  }

  void place_curve_edges() {
    for (const InnerEdge& edge : curve_edges_) {
      made_.curve_edges.push_back({local(edge.ends[0]), local(edge.ends[1])});
      made_.curve_numbers.push_back(edge.numbers[0]);
      made_.curve_triangles.push_back({local_triangle(edge.triangles[0]), local_triangle(edge.triangles[1])});
      made_.owned_curve_edges += is_owned_here(made_.curve_triangles.back()[0]);
    }
  }
  void place_interfaces() {
    for (const InnerEdge& edge : interfaces_) {
      made_.interfaces.push_back({local(edge.ends[0]), local(edge.ends[1])});
      made_.interface_regions.push_back({edge.numbers[0], edge.numbers[1]});
      made_.interface_pairs.push_back(edge.numbers[2]);
      made_.interface_curves.push_back(edge.numbers[3]);
      made_.interface_triangles.push_back({local_triangle(edge.triangles[0]), local_triangle(edge.triangles[1])});
      made_.owned_interfaces += is_owned_here(made_.interface_triangles.back()[0]);
    }
  }
  bool is_owned_here(LocalIndex triangle) const { return triangle >= 0 && triangle < made_.owned_triangles; }

  /// Owners learn who has ghosts of theirs, and answer by what these need.
  void fetch_ghosts() {
    std::map<int, Neighbour> neighbours;
    Outbox<GlobalId> questions;
    for (std::size_t k = 0; k < made_.ghost_ids.size(); ++k) {
      Neighbour& neighbour = neighbours[made_.ghost_owners[k]];
      if (neighbour.ghosts++ == 0)
        neighbour.first_ghost = made_.owned_points + static_cast<LocalIndex>(k);
      questions[made_.ghost_owners[k]].push_back(made_.ghost_ids[k]);
    }
    Outbox<PointValues> answers;
    for (const comm::Message& message : send(comm_, questions))
      for (const GlobalId id : comm::from_bytes<GlobalId>(message.data)) {
        const auto point = static_cast<std::size_t>(id - made_.first_point);
        neighbours[message.peer].send.push_back(static_cast<LocalIndex>(point));
        answers[message.peer].push_back({mesh_.points[point], mesh_.boundary[point]});
      }
    for (const comm::Message& message : send(comm_, answers)) // by rank, so in the order of the ghosts
      for (const PointValues& values : comm::from_bytes<PointValues>(message.data)) {
        made_.points.push_back(values.position);
        made_.boundary.push_back(values.boundary);
      }
    for (auto& [rank, neighbour] : neighbours) {
      neighbour.rank = rank;
      made_.neighbours.push_back(std::move(neighbour));
    }
  }

  const comm::Communicator& comm_;
  const mesh::DistributedMesh& mesh_;
  Overlap overlap_;
  std::vector<std::int64_t> firsts_;                // first point of each rank
  std::vector<Triangle> owned_, foreign_;           // by id
  std::vector<Facet> facets_, foreign_facets_;      // of these
  std::vector<InnerEdge> curve_edges_, interfaces_; // of both; those of owned triangles on the left come first
  LocalMesh made_;
};

} // namespace

LocalMesh make_local_mesh(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, Overlap overlap) {
  LocalMesh made = LocalMeshMaker(comm, mesh, overlap).make();
  share_split_pairs(comm, mesh, made);
  return made;
}

} // namespace trime::handover
