// SPDX-License-Identifier: BSD-3-Clause
// Divides the triangles around each point of a split curve into sectors, between the edges that are split and the
// boundary. Each sector gets a copy of the point.
#pragma once

#include "splitting/split_edges.hpp"

#include <span>
#include <vector>

namespace trime::splitting {

/// Asks for the copy of a point in the triangle on one side of the direction from the point to a neighbour.
struct Question {
  GlobalId point, neighbour;
  std::int32_t right; ///< 0: the triangle on the left, 1: on the right
};

/// A point that has become several copies, or an end of a split curve that has stayed one.
struct SplitPoint {
  GlobalId id;         ///< before the mesh was split
  std::int64_t copies; ///< 1 or more
  std::int64_t before; ///< additional copies of all points with lower ids
  geometry::Vec2 place;
};

/// @brief The sectors around all points of split curves. A rank finds those of the points that it holds, and answers
/// questions about them. A sector begins, counter-clockwise, at a neighbour. The sectors of a point are numbered
/// by the ids of these neighbours, ascending, so the numbers do not depend on the number of ranks.
class Sectors {
public:
  /// Finds the sectors. Cost: O(points on split curves and their triangles), and one pass over all triangles.
  /// Collective.
  /// @param mesh, edges outlive this object
  Sectors(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, const SplitEdges& edges);

  /// Returns the number of the copy for each question, in the same order. Collective.
  /// @throws InternalError on all ranks if there is no such triangle
  std::vector<std::int32_t> answer(const std::vector<Question>& questions) const;

  /// Returns the points of all ranks, ascending by id.
  std::span<const SplitPoint> points() const { return points_; }
  /// Returns the id of a copy of a point; of any point, if copy is 0. The copies follow each other, so that all ids
  /// stay in their order and all points on their ranks.
  GlobalId new_id(GlobalId old, std::int32_t copy = 0) const;
  /// Returns the additional copies of all points.
  std::int64_t additional() const;

private:
  /// A triangle at a split point, by its other two vertices, counter-clockwise.
  struct Corner {
    GlobalId point, next, last;
    std::int32_t copy = -1;
  };
  void find_corners();
  void number_sectors(std::span<Corner> around);
  void list_points();
  int owner(GlobalId point) const;
  std::int32_t copy_at(const Question& question) const;

  const comm::Communicator& comm_;
  const mesh::DistributedMesh& mesh_;
  const SplitEdges& edges_;
  std::vector<std::array<GlobalId, 2>> cuts_; // split edges from both of their ends, ascending
  std::vector<GlobalId> firsts_;              // first point of each rank
  std::vector<Corner> corners_;               // at the points of this rank, ascending by point and next
  std::vector<SplitPoint> points_;
};

} // namespace trime::splitting
