// SPDX-License-Identifier: BSD-3-Clause
// Finds the connected parts of the inside and of the outside.
#pragma once

#include "generalise/curve_map.hpp"

#include <vector>

namespace trime::generalise {

/// @brief A region is a set of triangles on the same side that are connected by edges; it may be a single triangle. The
/// region around the shape contains the corners of the box.
class Regions {
public:
  /// @param labels 1 for each triangle that is inside. O(triangles)
  Regions(const CurveMap& map, const std::vector<char>& labels);

  LocalIndex count() const { return static_cast<LocalIndex>(perimeter_.size()); }
  LocalIndex of(LocalIndex triangle) const { return region_[at(triangle)]; }
  LocalIndex around() const { return region_[at(around_)]; }
  /// Returns the length of the rim of a region over the local h.
  double perimeter(LocalIndex region) const { return perimeter_[at(region)]; }
  /// Returns whether the rim of a region has a vertex that the user has asked for.
  bool holds_kept(LocalIndex region) const { return holds_kept_[at(region)] != 0; }

private:
  LocalIndex around_; // a triangle of the region around the shape
  std::vector<LocalIndex> region_;
  std::vector<double> perimeter_;
  std::vector<char> holds_kept_;
};

/// Fills holes whose perimeter is below GeneraliseRules::smallest_hole. Returns their number.
/// @param regions the regions of these labels
std::int64_t fill_small_holes(const CurveMap& map, const Regions& regions, std::vector<char>& labels);

} // namespace trime::generalise
