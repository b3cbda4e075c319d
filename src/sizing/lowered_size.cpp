// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/lowered_size.hpp"

#include "cones/cone_cells.hpp"

namespace trime::sizing {
namespace {

using cones::Cone;
using cones::ConeCells;
using cones::ConeTree;

/// With the images next to the container: a nearest one is among them.
std::vector<Cone> cones_of(const std::vector<SizeLimit>& limits, const geometry::Periods& periods) {
  std::vector<Cone> cones;
  const int nx = periods.x > 0 ? 1 : 0, ny = periods.y > 0 ? 1 : 0;
  for (const SizeLimit& limit : limits)
    for (int j = -ny; j <= ny; ++j)
      for (int i = -nx; i <= nx; ++i)
        cones.push_back({periods.wrap(limit.place) + geometry::Vec2{i * periods.x, j * periods.y}, limit.size});
  return cones;
}

} // namespace

LoweredSize::LoweredSize(const SizeField& field, const std::vector<SizeLimit>& limits, double gradation,
                         const geometry::Periods& periods)
    : field_(field), periods_(periods), cones_(std::make_unique<const ConeTree>(cones_of(limits, periods), gradation)),
      cells_(std::make_unique<const ConeCells>(*cones_, gradation)) {}

LoweredSize::~LoweredSize() = default;

double LoweredSize::size(geometry::Vec2 p) const {
  const double size = field_.size(p);
  return is_valid_size(size) ? lowered(p, size) : size;
}

std::size_t LoweredSize::memory_bytes() const {
  return cones_->memory_bytes() + cells_->memory_bytes();
}

double LoweredSize::lowered(geometry::Vec2 p, double field_size) const {
  return cells_->value(periods_.wrap(p), field_size);
}

} // namespace trime::sizing
