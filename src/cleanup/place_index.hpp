// SPDX-License-Identifier: BSD-3-Clause
// Which of many places lie near another one.
#pragma once

#include "geometry/box_tree.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Canonical places in a tree, images across a periodic border included. However they lie, a search is
/// O(log n + found).
class PlaceIndex {
public:
  /// O(n log n). The periods and the places must outlive the object.
  PlaceIndex(const geometry::Periods& periods, std::span<const geometry::Vec2> places)
      : periods_(periods), places_(places), tree_(boxes_of(places)) {}

  /// @brief Calls visit(index) for each of the places whose nearest image lies within `reach` of `center`.
  /// @pre `center` canonical, reach below half a period
  template <class Visit>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit) const {
    for (const int i : {0, -1, 1})
      for (const int j : {0, -1, 1})
        if ((i == 0 || periods_.x > 0) && (j == 0 || periods_.y > 0))
          visit_image(center, center + geometry::Vec2{i * periods_.x, j * periods_.y}, reach, visit);
  }

private:
  static std::vector<geometry::Box> boxes_of(std::span<const geometry::Vec2> places) {
    std::vector<geometry::Box> boxes;
    for (const geometry::Vec2 place : places)
      boxes.push_back({place, place});
    return boxes;
  }
  template <class Visit>
  void visit_image(geometry::Vec2 center, geometry::Vec2 image, double reach, const Visit& visit) const {
    const geometry::Vec2 corner{reach, reach};
    tree_.for_each_meeting({image - corner, image + corner}, [&](std::size_t k) {
      if (geometry::squared_length(periods_.nearest_image(places_[k], center) - center) < reach * reach)
        visit(static_cast<std::uint32_t>(k));
    });
  }

  const geometry::Periods& periods_;
  const std::span<const geometry::Vec2> places_;
  const geometry::BoxTree tree_;
};

} // namespace trime::cleanup
