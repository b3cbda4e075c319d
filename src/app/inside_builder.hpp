// SPDX-License-Identifier: BSD-3-Clause
// Makes what is inside a shape, its curves and regions, from the sections [curve.NAME] and [region.NAME] of a config.
#pragma once

#include "app/options.hpp"
#include "sizing/region_size.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/shape/region_shape.hpp"

#include <vector>

namespace trime::app {

/// @brief Collects the curves and regions of a config in their order. Writes the warnings of their files to the log.
/// Every rank does the same.
class InsideBuilder {
public:
  /// @pre both arguments outlive this object
  InsideBuilder(const geometry::Frame& frame, Log& log) : frame_(frame), log_(log) {}

  /// @brief Adds the curve NAME, or the curves NAME.VALUE for each marker of its lines.
  /// @param contour the lines @param place moves them into the container
  /// @throws GeometryError
  void add_curve(const CurveOptions& curve, const contours::Contour& contour, const contours::Normalization& place);
  /// @brief Adds a region; if it has a file, one for each marker of its polygons.
  /// @param contour the polygons of the file, or empty @param place moves them into the container
  /// @throws GeometryError
  void add_region(const RegionOptions& region, const contours::Contour& contour, const contours::Normalization& place);

  shape::InnerParts parts;
  std::vector<sizing::RegionBound> bounds; ///< largest sizes in regions, as their files give them

private:
  void add_area_limits(const RegionOptions& region, const contours::Contour& contour, double scale);

  const geometry::Frame& frame_;
  Log& log_;
};

/// Says which curves and regions of a domain overlap, lie outside, or have no edges of their own.
void tell_of_inside(const geometry::Domain& domain, Log& log);

} // namespace trime::app
