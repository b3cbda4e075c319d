// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/cone_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trime::sizing {

using geometry::Vec2;

namespace {

/// Place along a Hilbert curve through a square of 2^16 by 2^16 cells.
std::uint32_t hilbert_place(std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t side = 1u << 16;
  std::uint32_t place = 0;
  for (std::uint32_t half = side / 2; half > 0; half /= 2) {
    const bool right = (x & half) != 0, above = (y & half) != 0;
    place = 4 * place + (right ? (above ? 2 : 3) : (above ? 1 : 0));
    if (!above) {
      if (right) {
        x = side - 1 - x;
        y = side - 1 - y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

/// In the order of a Hilbert curve through their box; cones in one of its cells keep their order.
std::vector<Cone> in_order(const std::vector<Cone>& cones) {
  geometry::Box box;
  for (const Cone& cone : cones)
    box.include(cone.apex);
  const double extent = std::max(box.width(), box.height());
  const double cells = extent > 1e-300 ? 65535 / extent : 0;
  std::vector<std::uint64_t> keys(cones.size());
  for (std::size_t k = 0; k < cones.size(); ++k) {
    const Vec2 place = cells * (cones[k].apex - box.min);
    keys[k] =
        (std::uint64_t{hilbert_place(static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y))} << 32) +
        k;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Cone> sorted(cones.size());
  for (std::size_t k = 0; k < cones.size(); ++k)
    sorted[k] = cones[static_cast<std::uint32_t>(keys[k])];
  return sorted;
}

} // namespace

ConeTree::ConeTree(const std::vector<Cone>& cones, double slope) : cones_(in_order(cones)), slope_(slope) {
  tree_ = BoxTree(cones_.size(), [&](std::size_t k) {
    return BoxTree::Item{{cones_[k].apex, cones_[k].apex}, cones_[k].height};
  });
  ConeLeaf none{};
  std::fill(std::begin(none.height), std::end(none.height), std::numeric_limits<double>::infinity());
  leaves_.resize((cones_.size() + BoxTree::width - 1) / BoxTree::width, none);
  for (std::size_t k = 0; k < cones_.size(); ++k) {
    ConeLeaf& leaf = leaves_[k / BoxTree::width];
    leaf.x[k % BoxTree::width] = cones_[k].apex.x;
    leaf.y[k % BoxTree::width] = cones_[k].apex.y;
    leaf.height[k % BoxTree::width] = cones_[k].height;
  }
}

LowestCone ConeTree::find(Vec2 p, double bound, double slack) const {
  LowestCone lowest{bound, -1};
  kernel_.lowest(tree_.levels(), leaves_.data(), slope_, p.x, p.y, 1 / (1 + slack), lowest);
  return lowest;
}

double ConeTree::value(Vec2 p, double bound, double slack) const {
  return find(p, bound, slack).value;
}

LocalIndex ConeTree::lowest(Vec2 p, double bound) const {
  return static_cast<LocalIndex>(find(p, bound, 0).cone);
}

void ConeTree::collect(Vec2 p, double bound, std::vector<LocalIndex>& found) const {
  const auto above = [&](const geometry::Box& box, double least) {
    return !(slope_ * std::sqrt(box.squared_distance(p)) + least <= bound);
  };
  visit_unless(above, [&](LocalIndex k) {
    if (cones_[k].value(p, slope_) <= bound)
      found.push_back(k);
  });
}

} // namespace trime::sizing
