// SPDX-License-Identifier: BSD-3-Clause
#include "trime/refinement/refine.hpp"

#include "comm/agree.hpp"
#include "comm/outbox.hpp"
#include "core/thread_loop.hpp"
#include "extraction/extraction.hpp"
#include "refinement/edge_table.hpp"
#include "refinement/inspection.hpp"
#include "refinement/middles.hpp"
#include "trime/core/error.hpp"
#include "trime/handover/local_mesh.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>

namespace trime::refinement {
namespace {

using comm::Outbox;
using comm::send;

using geometry::Vec2;
using Ids = std::array<GlobalId, 3>;

/// Throws on all ranks if the local indices of a rank do not suffice.
void check_room(const comm::Communicator& comm, const handover::LocalMesh& mesh, const EdgeTable& edges) {
  const std::int64_t points = std::int64_t{mesh.owned_points} + edges.owned();
  // The rank also holds those of its neighbours that touch its own; a quarter of the range is left to them.
  constexpr std::int64_t most = std::numeric_limits<LocalIndex>::max() / 4 * 3;
  const std::int64_t largest = comm.max(std::max(points, 4 * std::int64_t{mesh.owned_triangles}));
  if (largest > most)
    throw ConfigError(fmt::format("the refined mesh has {} triangles, too many for {} rank{}: a rank would hold {} "
                                  "points or triangles, but at most {} are possible; start at least {} ranks",
                                  4 * mesh.total_triangles, comm.size(), comm.size() == 1 ? "" : "s", largest, most,
                                  comm.size() * (largest / most + 1)));
}

/// An edge on a curve or between regions, with its numbers.
struct InnerEdge {
  std::array<GlobalId, 2> ends;
  std::array<std::int32_t, 4> numbers;
};

/// Divides triangles and edges with labels, and numbers the new points.
class Refiner {
public:
  Refiner(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, const Surroundings& surroundings)
      : comm_(comm), mesh_(mesh), local_(handover::make_local_mesh(comm, mesh)), edges_(local_),
        middles_(comm, surroundings.frame, local_, edges_, surroundings.curves) {
    check_room(comm, local_, edges_);
  }

  mesh::DistributedMesh make() {
    number_points();
    mesh::DistributedMesh made;
    place_points(made);
    divide_facets(made);
    divide_curves(made);
    divide_interfaces(made);
    divide_triangles(made);
    made.hash = static_cast<std::uint64_t>(comm_.sum(static_cast<std::int64_t>(mesh::partial_hash(made))));
    return made;
  }
  ExpectedCounts expected() const;
  BoundaryMiddles middle_counts() const { return middles_.counts(); }

private:
  /// Returns where in the slab the point of an owned edge follows its lower end.
  std::size_t slot_of_edge(LocalIndex edge) const { return at(edges_.lower(edge)) + 1 + at(edge); }
  std::size_t slot_of_point(LocalIndex point) const { return at(point) + at(edges_.before(point)); }
  GlobalId id_of_edge(LocalIndex edge) const {
    return edge < edges_.owned() ? first_ + static_cast<GlobalId>(slot_of_edge(edge))
                                 : foreign_edges_[at(edge - edges_.owned())];
  }
  void number_points();
  void ask_for_edges();
  void place_points(mesh::DistributedMesh& made) const;
  void interpolate_depths(mesh::DistributedMesh& made) const;
  std::vector<float> sizes_of_facets() const;
  void divide_facets(mesh::DistributedMesh& made) const;
  std::vector<InnerEdge> halves(const std::vector<InnerEdge>& edges) const;
  void divide_curves(mesh::DistributedMesh& made) const;
  void divide_interfaces(mesh::DistributedMesh& made) const;
  void divide_triangles(mesh::DistributedMesh& made) const;
  std::vector<LocalIndex> sorted(std::span<const Ids> triangles, std::size_t points) const;

  const comm::Communicator& comm_;
  const mesh::DistributedMesh& mesh_;
  const handover::LocalMesh local_;
  const EdgeTable edges_;
  const Middles middles_;
  GlobalId first_ = 0;                  // id of the first new point of this rank
  std::vector<GlobalId> ids_;           // new ids of the local points
  std::vector<double> sizes_, depths_;  // of the local points; without depths: 0
  std::vector<GlobalId> foreign_edges_; // ids of the points on edges of other ranks, from the first such edge on; -1 if
                                        // no triangle of this rank has the edge
};

void Refiner::number_points() {
  first_ = mesh_.point_slab.first + comm_.exclusive_scan(edges_.owned());
  constexpr std::size_t columns = 3;
  std::vector<double> values(columns * local_.points.size()); // ids below 2^53 are exact
  for (LocalIndex p = 0; p < local_.owned_points; ++p) {
    values[columns * at(p)] = static_cast<double>(first_ + static_cast<GlobalId>(slot_of_point(p)));
    values[columns * at(p) + 1] = mesh_.size[at(p)];
    values[columns * at(p) + 2] = mesh_.depth ? (*mesh_.depth)[at(p)] : 0;
  }
  handover::update_ghosts(comm_, local_, values, columns);
  for (std::size_t p = 0; p < local_.points.size(); ++p) {
    ids_.push_back(static_cast<GlobalId>(values[columns * p]));
    sizes_.push_back(values[columns * p + 1]);
    depths_.push_back(values[columns * p + 2]);
  }
  ask_for_edges();
}

/// The owner of its lower end numbers the point of an edge.
void Refiner::ask_for_edges() {
  std::vector<char> wanted(at(edges_.size() - edges_.owned()), 0);
  for (LocalIndex t = 0; t < local_.owned_triangles; ++t)
    for (const LocalIndex edge : edges_.of_triangle(t))
      if (edge >= edges_.owned())
        wanted[at(edge - edges_.owned())] = 1;
  Outbox<std::array<GlobalId, 2>> questions;
  std::map<int, std::vector<std::size_t>> asked;
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (wanted[k]) {
      const LocalIndex edge = edges_.owned() + static_cast<LocalIndex>(k);
      const int owner = local_.ghost_owners[at(edges_.lower(edge) - local_.owned_points)];
      questions[owner].push_back({local_.global_id(edges_.lower(edge)), local_.global_id(edges_.upper(edge))});
      asked[owner].push_back(k);
    }
  Outbox<GlobalId> answers;
  for (const comm::Message& message : send(comm_, questions))
    for (const auto& [low, high] : comm::from_bytes<std::array<GlobalId, 2>>(message.data)) {
      const auto lower = static_cast<LocalIndex>(low - local_.first_point);
      GlobalId found = -1;
      for (LocalIndex edge = edges_.before(lower); edge < edges_.before(lower + 1); ++edge)
        if (local_.global_id(edges_.upper(edge)) == high)
          found = id_of_edge(edge);
      answers[message.peer].push_back(found);
    }
  foreign_edges_.assign(wanted.size(), -1);
  for (const comm::Message& message : send(comm_, answers)) {
    const std::vector<GlobalId> ids = comm::from_bytes<GlobalId>(message.data);
    for (std::size_t k = 0; k < ids.size(); ++k)
      foreign_edges_[asked[message.peer][k]] = ids[k];
  }
}

void Refiner::place_points(mesh::DistributedMesh& made) const {
  const std::size_t n = at(local_.owned_points) + at(edges_.owned());
  made.point_slab = {first_, mesh_.point_slab.total + comm_.sum(std::int64_t{edges_.owned()})};
  made.points.resize(n);
  made.boundary.resize(n);
  made.size.resize(n);
  made.fixed.resize(n);
  thread_loop(local_.owned_points, 1024, [&](std::ptrdiff_t item, int) {
    const auto p = static_cast<LocalIndex>(item);
    const std::size_t slot = slot_of_point(p);
    made.points[slot] = mesh_.points[at(p)];
    made.boundary[slot] = mesh_.boundary[at(p)];
    made.size[slot] = 0.5F * mesh_.size[at(p)];
    made.fixed[slot] = mesh_.fixed[at(p)];
  });
  thread_loop(edges_.owned(), 1024, [&](std::ptrdiff_t item, int) {
    const auto edge = static_cast<LocalIndex>(item);
    const std::size_t slot = slot_of_edge(edge);
    const LocalIndex facet = middles_.facet(edge);
    made.points[slot] = middles_.place(edge);
    made.boundary[slot] = facet < 0 ? 0 : local_.facet_tags[at(facet)];
    made.size[slot] = static_cast<float>(0.25 * (sizes_[at(edges_.lower(edge))] + sizes_[at(edges_.upper(edge))]));
    made.fixed[slot] = 0;
  });
  if (mesh_.depth)
    interpolate_depths(made);
}

/// A new point has the mean depth of the ends of its edge: the depth stays the same function on the triangles.
void Refiner::interpolate_depths(mesh::DistributedMesh& made) const {
  UnsetVector<double>& depth = made.depth.emplace();
  depth.resize(made.points.size());
  for (LocalIndex p = 0; p < local_.owned_points; ++p)
    depth[slot_of_point(p)] = depths_[at(p)];
  for (LocalIndex edge = 0; edge < edges_.owned(); ++edge)
    depth[slot_of_edge(edge)] = 0.5 * (depths_[at(edges_.lower(edge))] + depths_[at(edges_.upper(edge))]);
}

/// Returns the sizes that the user asked for, by owned edge; 0 inside. They come to the owners of the lower ends. Each
/// rank must know where the points of all others begin.
std::vector<float> Refiner::sizes_of_facets() const {
  struct Sized {
    GlobalId low, high;
    float size;
    std::int32_t unused = 0;
  };
  const std::vector<std::int64_t> firsts = comm_.all_gather(mesh_.point_slab.first);
  Outbox<Sized> away;
  for (std::size_t k = 0; k < mesh_.facets.size(); ++k) {
    const auto [low, high] = std::minmax(mesh_.facets[k][0], mesh_.facets[k][1]);
    // Ranks without points start where the next one does.
    const auto owner = static_cast<int>(std::ranges::upper_bound(firsts, low) - firsts.begin()) - 1;
    away[owner].push_back({low, high, mesh_.facet_sizes[k]});
  }
  std::vector<float> sizes(at(edges_.owned()), 0);
  for (const comm::Message& message : send(comm_, away))
    for (const Sized& facet : comm::from_bytes<Sized>(message.data)) {
      const auto lower = static_cast<LocalIndex>(facet.low - local_.first_point);
      for (LocalIndex edge = edges_.before(lower); edge < edges_.before(lower + 1); ++edge)
        if (local_.global_id(edges_.upper(edge)) == facet.high)
          sizes[at(edge)] = facet.size;
    }
  return sizes;
}

/// Each facet becomes two, on the rank that owns its lower end: both have their lowest vertex there.
void Refiner::divide_facets(mesh::DistributedMesh& made) const {
  struct Half {
    std::array<GlobalId, 2> ends;
    std::int32_t tag, part;
    float size;
    GlobalId lower() const { return std::min(ends[0], ends[1]); }
    GlobalId upper() const { return std::max(ends[0], ends[1]); }
  };
  const std::vector<float> sizes = sizes_of_facets();
  std::vector<Half> halves;
  for (LocalIndex edge = 0; edge < edges_.owned(); ++edge)
    if (const LocalIndex facet = middles_.facet(edge); facet >= 0) {
      const auto [a, b] = local_.facets[at(facet)];
      const std::int32_t tag = local_.facet_tags[at(facet)], part = local_.facet_parts[at(facet)];
      halves.push_back({{ids_[at(a)], id_of_edge(edge)}, tag, part, 0.5F * sizes[at(edge)]});
      halves.push_back({{id_of_edge(edge), ids_[at(b)]}, tag, part, 0.5F * sizes[at(edge)]});
    }
  std::ranges::sort(halves, [](const Half& a, const Half& b) {
    return a.lower() != b.lower() ? a.lower() < b.lower() : a.upper() < b.upper();
  });
  for (const Half& half : halves) {
    made.facets.push_back(half.ends);
    made.facet_tags.push_back(half.tag);
    made.facet_parts.push_back(half.part);
    made.facet_sizes.push_back(half.size);
  }
  made.facet_slab = {comm_.exclusive_scan(std::ssize(halves)), 2 * mesh_.facet_slab.total};
}

/// Each edge inside becomes two, which meet in its middle, on the rank that owns its lower end. They are sorted by
/// their lower end, then by the other one.
std::vector<InnerEdge> Refiner::halves(const std::vector<InnerEdge>& edges) const {
  const std::vector<std::int64_t> firsts = comm_.all_gather(mesh_.point_slab.first);
  Outbox<InnerEdge> away;
  for (const InnerEdge& edge : edges) {
    const GlobalId low = std::min(edge.ends[0], edge.ends[1]);
    away[static_cast<int>(std::ranges::upper_bound(firsts, low) - firsts.begin()) - 1].push_back(edge);
  }
  std::vector<InnerEdge> halves;
  for (const comm::Message& message : send(comm_, away))
    for (const InnerEdge& given : comm::from_bytes<InnerEdge>(message.data)) {
      const auto [low, high] = std::minmax(given.ends[0], given.ends[1]);
      const auto lower = static_cast<LocalIndex>(low - local_.first_point);
      for (LocalIndex edge = edges_.before(lower); edge < edges_.before(lower + 1); ++edge)
        if (local_.global_id(edges_.upper(edge)) == high) {
          const GlobalId from = ids_[at(given.ends[0] == low ? lower : edges_.upper(edge))],
                         to = ids_[at(given.ends[0] == low ? edges_.upper(edge) : lower)];
          halves.push_back({{from, id_of_edge(edge)}, given.numbers});
          halves.push_back({{id_of_edge(edge), to}, given.numbers});
        }
    }
  std::ranges::sort(halves, {}, [](const InnerEdge& half) {
    return std::array{std::min(half.ends[0], half.ends[1]), std::max(half.ends[0], half.ends[1])};
  });
  return halves;
}

void Refiner::divide_curves(mesh::DistributedMesh& made) const {
  if (mesh_.curve_slab.total == 0)
    return;
  std::vector<InnerEdge> edges;
  for (std::size_t k = 0; k < mesh_.curve_edges.size(); ++k)
    edges.push_back({mesh_.curve_edges[k], {mesh_.curve_numbers[k]}});
  for (const InnerEdge& half : halves(edges)) {
    made.curve_edges.push_back(half.ends);
    made.curve_numbers.push_back(half.numbers[0]);
  }
  made.curve_slab = {comm_.exclusive_scan(std::ssize(made.curve_edges)), 2 * mesh_.curve_slab.total};
}

/// The halves have the same regions on both sides.
void Refiner::divide_interfaces(mesh::DistributedMesh& made) const {
  if (mesh_.interface_slab.total == 0)
    return;
  std::vector<InnerEdge> edges;
  for (std::size_t k = 0; k < mesh_.interfaces.size(); ++k) {
    const auto [left, right] = mesh_.interface_regions[k];
    edges.push_back({mesh_.interfaces[k], {left, right, mesh_.interface_pairs[k], mesh_.interface_curves[k]}});
  }
  for (const InnerEdge& half : halves(edges)) {
    made.interfaces.push_back(half.ends);
    made.interface_regions.push_back({half.numbers[0], half.numbers[1]});
    made.interface_pairs.push_back(half.numbers[2]);
    made.interface_curves.push_back(half.numbers[3]);
  }
  made.interface_slab = {comm_.exclusive_scan(std::ssize(made.interfaces)), 2 * mesh_.interface_slab.total};
}

/// Returns the canonical order of triangles. @pre their lowest vertices, which come first, are points of this rank
std::vector<LocalIndex> Refiner::sorted(std::span<const Ids> triangles, std::size_t points) const {
  std::vector<LocalIndex> begin(points + 1, 0), order(triangles.size());
  for (const Ids& ids : triangles)
    ++begin[static_cast<std::size_t>(ids[0] - first_) + 1];
  for (std::size_t p = 1; p < begin.size(); ++p)
    begin[p] += begin[p - 1];
  std::vector<LocalIndex> next(begin.begin(), begin.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    order[at(next[static_cast<std::size_t>(triangles[t][0] - first_)]++)] = static_cast<LocalIndex>(t);
  thread_loop(static_cast<std::ptrdiff_t>(points), 1024, [&](std::ptrdiff_t p, int) {
    std::sort(order.begin() + begin[static_cast<std::size_t>(p)],
              order.begin() + begin[static_cast<std::size_t>(p) + 1],
              [&](LocalIndex a, LocalIndex b) { return triangles[at(a)] < triangles[at(b)]; });
  });
  return order;
}

/// Each triangle becomes four, whose lowest vertices are points of this rank, too. The lowest vertex of the triangle
/// and the points on the two edges from it have the lowest new ids, and each of the four triangles has one of these
/// points.
void Refiner::divide_triangles(mesh::DistributedMesh& made) const {
  std::vector<Ids> all(4 * at(local_.owned_triangles));
  thread_loop(local_.owned_triangles, 512, [&](std::ptrdiff_t item, int) {
    const auto t = static_cast<LocalIndex>(item);
    std::array<GlobalId, 6> ids;
    for (std::size_t j = 0; j < 3; ++j) {
      ids[j] = ids_[at(local_.triangles[at(t)][j])];
      ids[3 + j] = id_of_edge(edges_.of_triangle(t)[j]);
    }
    std::size_t slot = 4 * static_cast<std::size_t>(item);
    for (const Children::Triangle& child : middles_.children(t).triangles()) {
      Ids& made_ids = all[slot++];
      for (std::size_t j = 0; j < 3; ++j)
        made_ids[j] = ids[static_cast<std::size_t>(child[j])];
      std::rotate(made_ids.begin(), std::ranges::min_element(made_ids), made_ids.end());
    }
  });
  const std::vector<LocalIndex> order = sorted(all, made.points.size());
  std::vector<Ids> in_order(all.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    in_order[k] = all[at(order[k])];
  if (!local_.regions.empty())
    for (const LocalIndex k : order)
      made.region.push_back(local_.regions[at(k / 4)]);
  release(all);
  mesh::assign_triangles(made, in_order);
  made.triangle_slab = {comm_.exclusive_scan(std::ssize(in_order)), 4 * mesh_.triangle_slab.total};
}

ExpectedCounts Refiner::expected() const {
  ExpectedCounts counts;
  std::array<std::int64_t, 3> sums{edges_.owned(), 0, 0};
  for (std::size_t i = 0; i < mesh_.fixed.size(); ++i)
    if (mesh_.fixed[i] != 0)
      ++sums[mesh_.boundary[i] != 0 ? 1 : 2];
  comm_.sum(sums);
  counts.points = mesh_.point_slab.total + sums[0];
  counts.triangles = 4 * mesh_.triangle_slab.total;
  counts.facets = 2 * mesh_.facet_slab.total;
  counts.euler_characteristic = mesh_.point_slab.total - sums[0] + mesh_.triangle_slab.total;
  counts.corners = sums[1];
  counts.fixed_inside = sums[2];
  counts.interfaces = 2 * mesh_.interface_slab.total;
  return counts;
}

} // namespace

Refined refine(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, const Surroundings& surroundings) {
  Refined refined;
  ExpectedCounts expected;
  {
    Refiner refiner(comm, mesh, surroundings);
    expected = refiner.expected();
    refined.middles = refiner.middle_counts();
    refined.mesh = refiner.make();
  }
  Inspection inspection = inspect(comm, surroundings.frame, expected, refined.mesh);
  refined.quality = std::move(inspection.quality);
  refined.checks = std::move(inspection.checks);
  if (surroundings.worst_alpha)
    refined.checks.push_back(extraction::worst_alpha_check(refined.quality, *surroundings.worst_alpha));
  if (surroundings.limits_edges)
    refined.checks.push_back(extraction::longest_edge_check(refined.quality));
  refined.loops = std::move(inspection.loops);
  refined.regions = std::move(inspection.regions);
  return refined;
}

} // namespace trime::refinement
