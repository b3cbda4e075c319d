// SPDX-License-Identifier: BSD-3-Clause
// The shape that is meshed: parts joined by a region expression, its exact boundary, inside test and distance.
#pragma once

#include "trime/geometry/domain.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region.hpp"
#include "trime/tracing/shape.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace trime::shape {

/// Parts joined by a region. Its geometry does not change after construction; all queries are thread-safe.
class RegionShape final : public tracing::Shape {
public:
  /// @brief Parses the region and makes the boundary.
  /// @param parts parts with different names, without the name `domain`; see Region::parse for `region`
  /// @throws ConfigError for the region, or for names. GeometryError if the region is empty, leaves the container or
  /// has a boundary that touches itself. Also if a part sticks out of a periodic side by more than one period, or was
  /// made in another frame whose lattice or place does not fit this one.
  RegionShape(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame);

  /// The input of the mesher.
  const geometry::Domain& domain() const { return domain_; }
  const geometry::Frame& frame() const { return domain_.frame(); }
  const geometry::Boundary& boundary() const { return domain_.boundary(); }
  /// Points that meshes of this shape keep, see Domain::fixed_points. They are not part of the shape.
  void set_fixed_points(std::vector<geometry::FixedPoint> points) { domain_.set_fixed_points(std::move(points)); }
  /// The given parts, then the container under the name `domain`.
  const std::vector<Part>& parts() const { return parts_; }
  const Region& region() const { return region_; }

  /// @brief Returns whether p lies inside. Exact for lattice points; a point on the boundary may get either answer.
  bool inside(geometry::Vec2 p) const;
  /// @brief Returns the distance to the nearest point of the boundary, to within rounding.
  double distance_to_boundary(geometry::Vec2 p) const { return tree_.distance(p); }
  /// Negative inside.
  double signed_distance(geometry::Vec2 p) const override {
    return inside(p) ? -distance_to_boundary(p) : distance_to_boundary(p);
  }

private:
  std::vector<Part> parts_;
  std::vector<std::vector<geometry::Vec2>> shifts_; // shifts of the images of each part
  Region region_;
  geometry::Domain domain_;
  geometry::PieceTree tree_;
};

/// @brief Makes only the domain, for callers that need nothing else of the shape: frees the parts and everything that
/// was built to find the boundary. The domain has the same bits as that of a RegionShape.
/// @throws ConfigError, GeometryError as RegionShape
geometry::Domain domain_of(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame);

/// @brief Traces your own shape: returns the region that consists of it alone. See traced_part for cost and errors.
RegionShape traced(const tracing::Shape& shape, const geometry::Frame& frame, const std::string& name = "shape");

} // namespace trime::shape
