// SPDX-License-Identifier: BSD-3-Clause
// The connected parts of the inside and of the outside.
#pragma once

#include "generalise/curve_map.hpp"

#include <vector>

namespace trime::generalise {

/// @brief Triangles that lie on the same side and share edges, down to single triangles. The region around the shape
/// is the one that holds the corners of the box.
class Regions {
public:
  /// @param labels by triangle: 1 inside. O(triangles)
  Regions(const CurveMap& map, const std::vector<char>& labels);

  LocalIndex count() const { return static_cast<LocalIndex>(perimeter_.size()); }
  LocalIndex of(LocalIndex triangle) const { return region_[at(triangle)]; }
  LocalIndex around() const { return region_[at(around_)]; }
  /// Length of its rim over the local h.
  double perimeter(LocalIndex region) const { return perimeter_[at(region)]; }
  /// Does its rim hold a vertex that the user has asked for?
  bool holds_kept(LocalIndex region) const { return holds_kept_[at(region)] != 0; }

private:
  LocalIndex around_; // a triangle there
  std::vector<LocalIndex> region_;
  std::vector<double> perimeter_;
  std::vector<char> holds_kept_;
};

/// Makes holes inside whose perimeter is below GeneraliseRules::smallest_hole. Returns how many.
/// @param regions of these labels
std::int64_t fill_small_holes(const CurveMap& map, const Regions& regions, std::vector<char>& labels);

} // namespace trime::generalise
