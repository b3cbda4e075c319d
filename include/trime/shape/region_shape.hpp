// SPDX-License-Identifier: BSD-3-Clause
// The shape that is meshed: parts joined by a region expression, its exact boundary, inside test and distance.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/shape/marked_boundary.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region.hpp"
#include "trime/tracing/shape.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trime::shape {

/// Parts joined by a region. Immutable after construction; all queries are thread-safe.
class RegionShape final : public tracing::Shape {
public:
  /// @brief Parses the region and makes the boundary.
  /// @param parts named differently, none of them `domain`; see Region::parse for `region`
  /// @throws ConfigError for the region, or for names. GeometryError if the region is empty, leaves the container or
  /// has a boundary that touches itself. Also if a part sticks out of a periodic side by more than one period.
  RegionShape(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame);

  const geometry::Frame& frame() const { return frame_; }
  const geometry::Boundary& boundary() const { return made_.boundary; }
  /// Markers that a contour file gives its segments: one for each of boundary().part_names, 0 where there is none.
  const std::vector<std::int32_t>& part_markers() const { return made_.part_markers; }
  /// The parts as given, then the container under the name `domain`.
  const std::vector<Part>& parts() const { return parts_; }
  const Region& region() const { return region_; }

  /// @brief Exact for lattice points; a point on the boundary may get either answer.
  bool inside(geometry::Vec2 p) const;
  /// @brief Distance to the nearest point of the boundary, to within rounding.
  double distance_to_boundary(geometry::Vec2 p) const { return tree_.distance(p); }
  /// Negative inside.
  double signed_distance(geometry::Vec2 p) const override {
    return inside(p) ? -distance_to_boundary(p) : distance_to_boundary(p);
  }

private:
  geometry::Frame frame_;
  std::vector<Part> parts_;
  std::vector<std::vector<geometry::Vec2>> shifts_; // of the images of each part
  Region region_;
  MarkedBoundary made_;
  geometry::PieceTree tree_;
};

/// @brief The boundary of the region alone, for those who ask nothing else of the shape: the parts and all that was
/// built to find it are freed. Bit for bit that of a RegionShape.
/// @throws ConfigError, GeometryError as RegionShape
MarkedBoundary boundary_of(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame);

/// @brief A shape of one's own, traced: the region that consists of it alone. See traced_part for cost and errors.
RegionShape traced(const tracing::Shape& shape, const geometry::Frame& frame, const std::string& name = "shape");

} // namespace trime::shape
