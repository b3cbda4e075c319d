// SPDX-License-Identifier: BSD-3-Clause
// Estimates how many points a mesh will have if the size field is multiplied by a factor, without laying out its
// boundary.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

#include <optional>
#include <vector>

namespace trime::fitting {

/// @brief Estimates the number of points on the boundary from the integral of ds/h, and the number inside from the
/// integral of h^-2 outside the strip along a polygon that replaces the boundary. The estimate does not count
/// additional points at corners and in narrow places. So for a boundary with many of these it is a few per cent lower
/// than the number that a layout finds.
class CountEstimate {
public:
  /// @param spacing distance between vertices of the polygon, which has at most as many vertices as the boundary
  /// @param coarsening factor on the width of the cells of the integral, see DensitySampler
  CountEstimate(const LayoutContext& context, double points, double spacing, double coarsening);

  /// Returns the estimated number of points, or nothing if the shape is smaller than the spacing, or if the size at a
  /// place on the boundary is invalid (the layout then reports the place). Collective.
  /// @throws GeometryError, see integrate_density
  std::optional<double> points(double factor);

  /// @brief If strides of length h along the boundary are far fewer than its length over h at this factor, the estimate
  /// counts strides from now on: curves after simplification are about as long as the strides. Collective. @return
  /// whether it counts strides
  bool use_strides(double factor);

  /// Returns the share of the sites that lie on the boundary at this factor; 0 if it is not known. Collective.
  double boundary_share(double factor) const;

  /// @brief By how much the factor should rather be larger, a guess: where a good part of the boundary sites are
  /// corners, the size is lowered around many of them. Collective.
  double crowding(double factor) const;

private:
  std::optional<double> boundary_points(const sizing::SizeField& size) const;
  std::optional<double> integrated(const sizing::SizeField& size) const;
  std::optional<double> strides(const sizing::SizeField& size) const;

  const LayoutContext& context_;
  double points_, coarsening_;
  sites::Stage reference_; // the polygon, used as the boundary of a mesh without points
  double corners_ = 0;     // number of corners of the boundary
  bool by_strides_ = false;
  std::vector<double> lengths_; // length of the curve from each vertex to its next
};

} // namespace trime::fitting
