// SPDX-License-Identifier: BSD-3-Clause
#include "dual/merged.hpp"

#include "comm/outbox.hpp"

#include <algorithm>

namespace trime::dual {
namespace {

using geometry::Vec2;

constexpr double same_place = 1e-9; // of the length of an edge

/// Returns whether the circumcentre of a triangle at the boundary lies on the middle of its boundary edge. Both ends of
/// the edge find the same.
bool is_on_middle(const Cells& cells, const Surroundings& around, LocalIndex site, std::size_t spoke,
                  std::size_t triangle) {
  LocalIndex lower = site, upper = around.ends[spoke];
  const LocalIndex apex = around.ends[triangle == spoke ? around.spoke_behind(spoke, 1) : triangle];
  if (cells.number_of(upper) < cells.number_of(lower))
    std::swap(lower, upper);
  const auto arm = [&](LocalIndex point) {
    return difference(cells.points[at(point)], cells.points[at(lower)], cells.period);
  };
  const Vec2 edge = arm(upper), centre = circumcentre(edge, arm(apex));
  return squared_length(centre - 0.5 * edge) <= same_place * same_place * squared_length(edge);
}

/// Collects the corners of a cell with the numbers of merged vertices.
struct MergedCorners {
  const Cells& cells;
  const Surroundings& around;
  LocalIndex site_index;
  const std::vector<GlobalId>& lowest;
  const std::vector<CellCorner>& plain;
  std::vector<CellCorner> corners{};

  void add(GlobalId vertex) {
    CellCorner corner = plain[next++];
    corner.vertex = vertex;
    if (corners.empty() || corners.back().vertex != vertex)
      corners.push_back(corner);
  }
  void centre(std::size_t triangle) { add(lowest[at(around.triangles[triangle])]); }
  void middle(std::size_t spoke) {
    const std::size_t triangle = around.left(spoke) ? *around.left(spoke) : *around.right(spoke);
    const bool is_merged = is_on_middle(cells, around, site_index, spoke, triangle);
    add(is_merged ? lowest[at(around.triangles[triangle])] : plain[next].vertex);
  }
  void site() { add(plain[next].vertex); }

  std::size_t next = 0;
};

} // namespace

/// The lowest number that a rank knows for a triangle.
struct MergedVertices::Known {
  GlobalId triangle, lowest;
};

MergedVertices::MergedVertices(const Cells& cells, const CellVertices& vertices, const comm::Communicator& comm)
    : cells_(cells), vertices_(vertices) {
  comm::run_agreed(comm, [&] {
    for (const CellTriangle& triangle : cells.triangles)
      lowest_.push_back(triangle.number);
    find_pairs();
  });
  share(comm);
}

void MergedVertices::find_pairs() {
  Surroundings around;
  for (LocalIndex site = 0; site < cells_.site_count; ++site) {
    look_around(cells_, site, around);
    for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke) {
      const auto left = around.left(spoke), right = around.right(spoke);
      if (left && right &&
          squared_length(around.centres[*left] - around.centres[*right]) <=
              same_place * same_place * squared_length(around.arms[spoke]))
        pairs_.push_back({around.triangles[*left], around.triangles[*right]});
    }
  }
}

/// Lowers the numbers along all pairs of this rank. @return whether any of them changed
bool MergedVertices::join_pairs() {
  bool has_changed = false;
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const Pair& pair : pairs_) {
      GlobalId &a = lowest_[at(pair.first)], &b = lowest_[at(pair.second)];
      if (a != b) {
        a = b = std::min(a, b);
        has_changed = goes_on = true;
      }
    }
  }
  return has_changed;
}

/// Ranks send each other what changed until nothing does.
void MergedVertices::share(const comm::Communicator& comm) {
  std::vector<GlobalId> sent = lowest_;
  for (bool goes_on = join_pairs(); comm.max(std::int64_t{goes_on}) > 0;) {
    comm::Outbox<Known> away;
    for (std::size_t t = 0; t < lowest_.size(); ++t) {
      if (lowest_[t] == sent[t])
        continue;
      sent[t] = lowest_[t];
      std::array<int, 3> ranks{};
      for (std::size_t k = 0; k < 3; ++k) {
        ranks[k] = cells_.shares.rank_of(cells_.number_of(cells_.triangles[t].corners[k]));
        if (ranks[k] != comm.rank() && std::find(ranks.begin(), ranks.begin() + k, ranks[k]) == ranks.begin() + k)
          away[ranks[k]].push_back({cells_.triangles[t].number, lowest_[t]});
      }
    }
    goes_on = false;
    for (const comm::Message& message : comm::send(comm, away))
      for (const Known& known : comm::from_bytes<Known>(message.data)) {
        const auto found =
            std::lower_bound(cells_.triangles.begin(), cells_.triangles.end(), known.triangle,
                             [](const CellTriangle& triangle, GlobalId wanted) { return triangle.number < wanted; });
        GlobalId& here = lowest_[static_cast<std::size_t>(found - cells_.triangles.begin())];
        goes_on = goes_on || known.lowest < here;
        here = std::min(here, known.lowest);
      }
    goes_on = join_pairs() || goes_on;
  }
}

std::vector<CellCorner> MergedVertices::corners(const Surroundings& around, LocalIndex site,
                                                const CellPart& cell) const {
  const std::vector<CellCorner> plain = vertices_.corners(around, site, cell);
  MergedCorners merged{cells_, around, site, lowest_, plain};
  for_each_corner(around, cell, merged);
  while (merged.corners.size() > 1 && merged.corners.back().vertex == merged.corners.front().vertex)
    merged.corners.pop_back();
  return merged.corners;
}

} // namespace trime::dual
