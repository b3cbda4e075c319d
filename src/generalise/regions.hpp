// SPDX-License-Identifier: BSD-3-Clause
// Finds the connected parts of the inside and of the outside of a shape.
#pragma once

#include "generalise/curve_map.hpp"

#include <vector>

namespace trime::generalise {

/// @brief A region is a set of triangles on the same side of the curves that are connected by edges; it may be a single
/// triangle. One region surrounds the shape and contains the corners of the box.
class Regions {
public:
  /// Finds the regions. Cost: O(triangles).
  /// @param labels 1 for each triangle that lies inside the shape
  Regions(const CurveMap& map, const std::vector<char>& labels);

  LocalIndex count() const { return static_cast<LocalIndex>(perimeter_.size()); }
  LocalIndex of(LocalIndex triangle) const { return region_[at(triangle)]; }
  LocalIndex around() const { return region_[at(around_)]; }
  /// Returns the length of a region's boundary, in units of the local h.
  double perimeter(LocalIndex region) const { return perimeter_[at(region)]; }
  /// Returns whether the boundary of a region has a vertex that the user asked for.
  bool holds_kept(LocalIndex region) const { return holds_kept_[at(region)] != 0; }

private:
  LocalIndex around_; // a triangle of the region that surrounds the shape
  std::vector<LocalIndex> region_;
  std::vector<double> perimeter_;
  std::vector<char> holds_kept_;
};

/// Fills holes whose perimeter is below GeneraliseRules::smallest_hole. Returns the number of filled holes.
/// @param regions the regions that belong to `labels`
std::int64_t fill_small_holes(const CurveMap& map, const Regions& regions, std::vector<char>& labels);

} // namespace trime::generalise
