// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/lowered_size.hpp"

#include "cones/cone_cells.hpp"

#include <utility>

namespace trime::sizing {

using cones::Cone;
using cones::ConeCells;
using cones::ConeTree;

std::vector<Cone> limiting_cones(const std::vector<SizeLimit>& limits, const geometry::Periods& periods) {
  std::vector<Cone> cones;
  const int nx = periods.x > 0 ? 1 : 0, ny = periods.y > 0 ? 1 : 0;
  for (const SizeLimit& limit : limits)
    for (int j = -ny; j <= ny; ++j)
      for (int i = -nx; i <= nx; ++i)
        cones.push_back({periods.wrap(limit.place) + geometry::Vec2{i * periods.x, j * periods.y}, limit.size});
  return cones;
}

/// The limits with one gradation. The cells refer to the tree.
struct LoweredSize::Set {
  std::unique_ptr<const ConeTree> tree;
  std::unique_ptr<const ConeCells> cells;
};

LoweredSize::LoweredSize(const SizeField& field, std::initializer_list<GradedLimits> sets,
                         const geometry::Periods& periods)
    : field_(field), periods_(periods) {
  for (const GradedLimits& set : sets) {
    if (set.limits.empty())
      continue;
    auto tree = std::make_unique<const ConeTree>(limiting_cones(set.limits, periods), set.gradation);
    auto cells = std::make_unique<const ConeCells>(*tree, set.gradation);
    sets_.push_back({std::move(tree), std::move(cells)});
  }
}

LoweredSize::~LoweredSize() = default;

double LoweredSize::size(geometry::Vec2 p) const {
  const double size = field_.size(p);
  return is_valid_size(size) ? lowered(p, size) : size;
}

void LoweredSize::sizes(std::span<const geometry::Vec2> places, std::span<double> values) const {
  field_.sizes(places, values);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (is_valid_size(values[k]))
      values[k] = lowered(places[k], values[k]);
}

std::size_t LoweredSize::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Set& set : sets_)
    bytes += set.tree->memory_bytes() + set.cells->memory_bytes();
  return bytes;
}

double LoweredSize::lowered(geometry::Vec2 p, double field_size) const {
  const geometry::Vec2 canonical = periods_.wrap(p);
  double least = field_size;
  for (const Set& set : sets_)
    least = set.cells->value(canonical, least);
  return least;
}

} // namespace trime::sizing
