// SPDX-License-Identifier: BSD-3-Clause
// Finds the region of a shape on each side of a piece of the arrangement, and measures the regions.
#pragma once

#include "shape/region_state.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/shape/region_shape.hpp"

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace trime::shape {

/// @brief Decides to which region of a division the sides of pieces belong. The areas follow from the pieces by Green's
/// theorem, so no face of the arrangement is ever searched. Cost: O(occurrences of the parts of a side).
class RegionSides {
public:
  /// @param part_names without the domain, which follows them; then come Division::parts
  /// @throws ConfigError if an expression cannot be parsed, with the name of the region
  RegionSides(const Division& division, std::span<const std::string> part_names);

  bool any() const { return !expressions_.empty(); }
  /// Returns the indices of all parts that occur in the regions, ascending, each once.
  std::vector<int> parts() const;

  /// @brief Returns the region of a side, 0 for the rest, and counts the area under the piece for it.
  /// @param parts indices of the parts that contain the side @param twice_area twice the area between the piece and a
  /// fixed place, positive if the side lies on the left @param place a place on the piece, for messages
  int at(std::span<const int> parts, bool is_in_shape, double twice_area, geometry::Vec2 place);

  /// @brief Checks the areas. The domain must not be used before that.
  /// @param least area below which a region counts as empty @param text expression of the shape
  /// @throws GeometryError if a region has no area in the shape, with the reason, or if the division must cover the
  /// shape and does not
  void check(double least, const std::string& text) const;

  /// @brief Returns the names and areas; the pairs are those of the arcs, and those that
  /// would touch if narrow wedges were cut. `text` is the name of the rest if it has
  /// none.
  /// @param least area that is not more than rounding errors
  geometry::Regions regions(const std::vector<geometry::InnerArc>& arcs, const geometry::Boundary& boundary,
                            double least, const std::string& text) const;

private:
  struct Area {
    double twice = 0;
    geometry::Vec2 place;
  };
  const std::string& name(std::size_t region) const { return division_.regions[region - 1].name; }
  [[noreturn]] void report_empty(std::size_t region, double least, const std::string& text) const;

  const Division& division_;
  std::vector<Region> expressions_;
  std::vector<RegionState> states_;
  std::vector<std::vector<std::size_t>> regions_of_; ///< by part: the regions in whose expressions it occurs, from 1
  std::vector<double> areas_, given_, outside_;      ///< by region: of what it has, of the expression, and outside
  geometry::Vec2 place_of_rest_;                     ///< on the boundary of the rest
  std::map<std::array<std::size_t, 2>, Area> overlaps_;
  std::vector<std::size_t> candidates_, holders_; ///< regions at the present side
};

} // namespace trime::shape
