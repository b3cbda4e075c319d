// SPDX-License-Identifier: BSD-3-Clause
// The faces of a plane graph of segments.
#pragma once

#include "contours/ring_nesting.hpp"
#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"

#include <cstddef>
#include <vector>

namespace trime::contours {

/// @brief The faces between segments. Half-edge 2 k leads along segment k, half-edge 2 k + 1 back; the face of a
/// half-edge lies on its left. Each face is a cycle of half-edges. A cycle with a positive area runs around a bounded
/// face; one with a negative area is the outside of segments that hang together.
class SegmentFaces {
public:
  static constexpr std::size_t nowhere = Nesting::nowhere;

  /// @param segments between the first vertices at each place, as remove_open_chains leaves them; they do not cross
  /// @pre both lists outlive this object
  /// Cost: O(n log n).
  SegmentFaces(const std::vector<FileVertex>& vertices, const std::vector<FileSegment>& segments);

  /// Returns whether each half-edge has material on its left: everything that segments enclose, except the faces with
  /// a hole point, as in Triangle.
  std::vector<char> material(const std::vector<FilePoint>& holes) const;
  /// Returns the number of the face around each point, or `nowhere` for the outside of all segments.
  std::vector<std::size_t> around(const std::vector<FilePoint>& points) const;
  /// Returns the segments with the face on exactly one side: its border without what hangs in it.
  std::vector<FileSegment> border(std::size_t face) const;

private:
  int origin(std::size_t half) const { return half % 2 == 0 ? segments_[half / 2].from : segments_[half / 2].to; }
  geometry::Vec2 place(std::size_t half) const { return vertices_[static_cast<std::size_t>(origin(half))].position; }
  void link();
  void add_cycle(std::size_t first);
  void find_faces();

  const std::vector<FileVertex>& vertices_;
  const std::vector<FileSegment>& segments_;
  std::vector<std::size_t> before_; // the half-edge clockwise from each one, at the same vertex
  std::vector<std::size_t> cycle_;  // the cycle of each half-edge
  std::vector<RingVertices> cycles_;
  std::vector<double> areas_;                    // the area of each cycle
  std::vector<RingVertices> bounded_;            // the cycles with a positive area, which are the faces
  std::vector<std::size_t> face_;                // the face of each cycle; nowhere: the outside of all segments
  std::vector<std::vector<std::size_t>> halves_; // half-edges of each face
};

} // namespace trime::contours
