// SPDX-License-Identifier: BSD-3-Clause
#include "app/boundary_check.hpp"

#include <algorithm>
#include <limits>

namespace trime::app {
namespace {

/// What one rank asks another for: place and size of a point.
struct Site {
  geometry::Vec2 position;
  double size = 0;
};

/// Rank whose slab holds a point; `firsts` are the starts of the slabs by rank, those of empty ranks included.
int owner_of(GlobalId point, const std::vector<std::int64_t>& firsts) {
  return static_cast<int>(std::upper_bound(firsts.begin(), firsts.end(), point) - firsts.begin()) - 1;
}

/// Points by global id, asked from the ranks that hold them. @note Collective.
class SiteLookup {
public:
  SiteLookup(const mesh::DistributedMesh& mesh, std::vector<GlobalId> wanted, const comm::Communicator& comm)
      : ids_(std::move(wanted)) {
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    const std::vector<comm::Message> questions = comm.exchange_any(ask(comm.all_gather(mesh.point_slab.first)));
    std::vector<comm::Message> answers;
    for (const comm::Message& question : questions) {
      std::vector<Site> sites;
      for (const GlobalId id : comm::from_bytes<GlobalId>(question.data)) {
        const auto k = static_cast<std::size_t>(id - mesh.point_slab.first);
        sites.push_back({mesh.points.at(k), static_cast<double>(mesh.size.at(k))});
      }
      answers.push_back({question.peer, comm::to_bytes(std::span<const Site>(sites))});
    }
    for (const comm::Message& answer : comm.exchange_any(answers)) { // by peer, so in the order of the ids
      const std::vector<Site> sites = comm::from_bytes<Site>(answer.data);
      sites_.insert(sites_.end(), sites.begin(), sites.end());
    }
  }

  const Site& operator[](GlobalId id) const {
    return sites_.at(static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()));
  }

private:
  std::vector<comm::Message> ask(const std::vector<std::int64_t>& firsts) const {
    std::vector<comm::Message> questions;
    for (std::size_t begin = 0; begin < ids_.size();) {
      const int owner = owner_of(ids_[begin], firsts);
      std::size_t end = begin;
      while (end < ids_.size() && owner_of(ids_[end], firsts) == owner)
        ++end;
      questions.push_back({owner, comm::to_bytes(std::span<const GlobalId>(ids_).subspan(begin, end - begin))});
      begin = end;
    }
    return questions;
  }

  std::vector<GlobalId> ids_;
  std::vector<Site> sites_;
};

} // namespace

mesh::Checks check_boundary_distance(const mesh::DistributedMesh& mesh, const geometry::Shape& shape,
                                     const comm::Communicator& comm) {
  std::vector<GlobalId> wanted;
  for (const auto& facet : mesh.facets)
    wanted.insert(wanted.end(), facet.begin(), facet.end());
  const SiteLookup sites(mesh, std::move(wanted), comm);
  double at_vertices = 0, at_middles = 0, smallest = std::numeric_limits<double>::infinity();
  for (const auto& [first, second] : mesh.facets) {
    const Site &a = sites[first], &b = sites[second];
    const double size = 0.5 * (a.size + b.size);
    smallest = std::min(smallest, a.size);
    at_vertices = std::max(at_vertices, shape.distance_to_boundary(a.position) / a.size);
    at_middles = std::max(at_middles, shape.distance_to_boundary(0.5 * (a.position + b.position)) / size);
  }
  at_vertices = comm.max(at_vertices);
  at_middles = comm.max(at_middles);
  // An arc of length h between two of its points strays from their middle by h/2 at most; sites spread by quantiles and
  // insertion may lie a little more than h apart.
  constexpr double middle_limit = 0.75;
  // Sites lie on the lattice: in a container far larger than the shape its step is what limits them.
  const double vertex_limit = std::max(1e-6, shape.frame().step() / comm.min(smallest));
  return {{"boundary_vertex_distance", vertex_limit, at_vertices, at_vertices <= vertex_limit,
           "largest distance of a boundary vertex from the shape's boundary, over h (at most)"},
          {"boundary_edge_distance", middle_limit, at_middles, at_middles <= middle_limit,
           "largest distance of the middle of a boundary edge from the shape's boundary, over h (at most)"}};
}

} // namespace trime::app
