// SPDX-License-Identifier: BSD-3-Clause
// Which of many places lie near another one.
#pragma once

#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Canonical places along x. A search looks at those whose x is near, images across a periodic border included.
class PlaceIndex {
public:
  /// O(n log n). The periods must outlive the object.
  PlaceIndex(const geometry::Periods& periods, std::span<const geometry::Vec2> places) : periods_(periods) {
    for (const geometry::Vec2 place : places)
      along_x_.push_back({place, static_cast<std::uint32_t>(along_x_.size())});
    std::sort(along_x_.begin(), along_x_.end(), [](const Entry& a, const Entry& b) { return a.place.x < b.place.x; });
  }

  /// @brief Calls visit(index) for each of the places whose nearest image lies within `reach` of `center`.
  /// @pre `center` canonical, reach below half a period
  template <class Visit>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit) const {
    visit_strip(center, center.x, reach, visit);
    if (periods_.x > 0) {
      visit_strip(center, center.x - periods_.x, reach, visit);
      visit_strip(center, center.x + periods_.x, reach, visit);
    }
  }

private:
  struct Entry {
    geometry::Vec2 place;
    std::uint32_t index;
  };
  template <class Visit>
  void visit_strip(geometry::Vec2 center, double x, double reach, const Visit& visit) const {
    auto entry = std::lower_bound(along_x_.begin(), along_x_.end(), x - reach,
                                  [](const Entry& a, double low) { return a.place.x < low; });
    for (; entry != along_x_.end() && entry->place.x <= x + reach; ++entry)
      if (geometry::squared_length(periods_.nearest_image(entry->place, center) - center) < reach * reach)
        visit(entry->index);
  }

  const geometry::Periods& periods_;
  std::vector<Entry> along_x_;
};

} // namespace trime::cleanup
