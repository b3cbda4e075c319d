// SPDX-License-Identifier: BSD-3-Clause
// Estimates how many points a mesh will have at a factor of the relative size, without laying out its boundary.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

#include <optional>
#include <vector>

namespace trime::fitting {

/// @brief Estimates boundary sites from the integral of ds/h, and inner sites from the integral of h^-2 outside the
/// strip along a polygon that replaces the boundary. It does not count additional sites at corners and narrow places,
/// so it is too low by a few per cent for a boundary full of them.
class CountEstimate {
public:
  /// @param spacing distance between vertices of the polygon, which has no more vertices than the boundary
  /// @param coarsening factor on the width of the cells of the integral, see DensitySampler
  CountEstimate(const LayoutContext& context, double points, double spacing, double coarsening);

  /// Returns the estimate, or nothing if the shape is smaller than the spacing, or if the size at a place of the
  /// boundary is invalid (the layout then reports where). Collective.
  /// @throws GeometryError, see integrate_density
  std::optional<double> points(double factor);

  /// @brief Counts the boundary sites by strides of length h from now on, if these are far fewer than the length over h
  /// at this factor: simplified curves are about as long. Collective. @return whether it does
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
  sites::Stage reference_; // the polygon as if it were a mesh boundary, without points
  double corners_ = 0;     // corners of the boundary
  bool by_strides_ = false;
  std::vector<double> lengths_; // length of the curve from each vertex to its next
};

} // namespace trime::fitting
