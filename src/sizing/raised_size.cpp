// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/raised_size.hpp"

#include "sizing/lowered_size.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {
namespace {

double largest_of(const std::vector<LeastSize>& places) {
  return std::ranges::max_element(places, {}, &LeastSize::size)->size;
}

std::vector<cones::Cone> cones_of(const std::vector<LeastSize>& places, double largest,
                                  const geometry::Periods& periods) {
  std::vector<SizeLimit> upside_down;
  for (const LeastSize& least : places)
    upside_down.push_back({least.place, largest - least.size});
  return limiting_cones(upside_down, periods);
}

} // namespace

RaisedSize::RaisedSize(const SizeField& field, const std::vector<LeastSize>& places, double gradation,
                       const geometry::Periods& periods)
    : field_(field), periods_(periods), largest_(largest_of(places)),
      cones_(cones_of(places, largest_, periods), gradation) {}

void RaisedSize::sizes(std::span<const geometry::Vec2> places, std::span<double> values) const {
  field_.sizes(places, values);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = raised(places[k], values[k]);
}

double RaisedSize::raised(geometry::Vec2 p, double size) const {
  if (!is_valid_size(size) || size >= largest_)
    return size;
  return std::fmax(size, largest_ - cones_.value(periods_.wrap(p), largest_ - size));
}

} // namespace trime::sizing
