// SPDX-License-Identifier: BSD-3-Clause
// Where a place of the container lies in the files of the user: messages of all modules speak of the container.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::app {

/// A contour that was normalised: container = scale * user + shift.
struct NormalizedPart {
  std::string name; ///< name of the part
  std::string file;
  double scale = 1;
  geometry::Vec2 shift;
};

/// @brief The vertices of all contours, in the container and in their files. Empty at first.
class UserPlaces {
public:
  /// @param place what the vertices undergo on their way into the container
  void add(const contours::Contour& contour, const contours::Normalization& place);

  /// @brief The message with `[FILE:LINE]`, the nearest vertex, behind each of its places; with `[FILE:LINE: (x, y)]`,
  /// in the coordinates of the file, if the contour is normalised; if it is projected, these are
  /// the coordinates of that vertex.
  ///
  /// Places that are far from all contours stay as they are, and so does the whole without contours. O(vertices) for
  /// each place.
  std::string explain(const PlacedText& message) const;

  /// @brief For each loop of the boundary the line of the file on which its ring begins: that of the first vertex of
  /// the loop that is one of a contour; 0 if none is. O(vertices log(vertices))
  std::vector<std::int32_t> ring_lines(const geometry::Boundary& boundary) const;

private:
  struct OneContour {
    std::string file;
    contours::Normalization place;
    bool moved;
    geometry::Box box; ///< in the container
    std::vector<geometry::Vec2> vertices;
    std::vector<int> lines;
    std::vector<std::size_t> ring_ends;  ///< the vertex behind the last of each ring
    std::vector<geometry::Vec2> in_file; ///< place in the file of each vertex; empty if not projected
  };
  std::string name_of(geometry::Vec2 place) const;

  std::vector<OneContour> contours_;
};

} // namespace trime::app
