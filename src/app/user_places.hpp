// SPDX-License-Identifier: BSD-3-Clause
// Finds where a place in the container lies in the files of the user, because messages of other modules name places in
// the container.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trime::app {

/// A contour that was normalised: container coordinates = scale * file coordinates + shift.
struct NormalizedPart {
  std::string name; ///< name of the part
  std::string file;
  double scale = 1;
  geometry::Vec2 shift;
};

/// @brief Keeps the vertices of all contours, with their coordinates in the container and in their files.
class UserPlaces {
public:
  /// @param place the transformation of the vertices from the file into the container
  void add(const contours::Contour& contour, const contours::Normalization& place);
  /// Sets how a place in the container is converted to longitude and latitude; it may return nothing.
  void set_on_earth(std::function<std::optional<geometry::Vec2>(geometry::Vec2)> on_earth) {
    on_earth_ = std::move(on_earth);
  }

  /// @brief Returns the message with the file and line of the nearest contour vertex after each place: `[FILE:LINE]`.
  /// If set_on_earth was called and knows the place, the text is `[FILE:LINE: longitude x, latitude y]`, without FILE
  /// and LINE far from all contours. Otherwise, if the contour is normalised, the text is `[FILE:LINE: (x, y)]` with
  /// the place in coordinates of the file; if it is projected, x and y are those of the nearest vertex in the file.
  /// Nothing is added to other places that are far from all contours. Cost: O(vertices) for each place.
  std::string explain(const PlacedText& message) const;

  /// @brief Returns for each loop of the boundary the line of its file on which its ring begins, which is the line of
  /// the loop's first vertex that is also a vertex of a contour; 0 if there is no such vertex. Cost: O(vertices
  /// log(vertices)).
  std::vector<std::int32_t> ring_lines(const geometry::Boundary& boundary) const;

private:
  struct OneContour {
    contours::Contour named; ///< the contour without its rings, for messages
    contours::Normalization place;
    bool moved;
    geometry::Box box; ///< bounding box in the container
    std::vector<geometry::Vec2> vertices;
    std::vector<int> lines;
    std::vector<std::size_t> ring_ends; ///< for each ring, the index after its last vertex
    std::vector<geometry::Vec2>
        in_file; ///< coordinates of each vertex in the file; empty if the contour is not projected
  };
  std::string name_of(geometry::Vec2 place) const;

  std::vector<OneContour> contours_;
  std::function<std::optional<geometry::Vec2>(geometry::Vec2)> on_earth_; ///< may be empty
};

} // namespace trime::app
