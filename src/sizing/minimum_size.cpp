// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/minimum_size.hpp"

#include <algorithm>

namespace trime::sizing {

MinimumSize::Smallest MinimumSize::at(geometry::Vec2 p) const {
  Smallest smallest{0, fields_.front()->size(p)};
  for (std::size_t k = 1; k < fields_.size() && is_valid_size(smallest.size); ++k) {
    const double size = fields_[k]->size(p);
    if (!is_valid_size(size) || size < smallest.size)
      smallest = {k, size};
  }
  return smallest;
}

void MinimumSize::smallest_fields(std::span<const geometry::Vec2> places, std::span<std::size_t> fields,
                                  std::span<double> values) const {
  fields_.front()->sizes(places, values);
  std::ranges::fill(fields, 0);
  std::vector<double> sizes(places.size());
  for (std::size_t k = 1; k < fields_.size(); ++k) {
    fields_[k]->sizes(places, sizes);
    for (std::size_t place = 0; place < places.size(); ++place)
      if (is_valid_size(values[place]) && (!is_valid_size(sizes[place]) || sizes[place] < values[place])) {
        fields[place] = k;
        values[place] = sizes[place];
      }
  }
}

void MinimumSize::sizes(std::span<const geometry::Vec2> places, std::span<double> values) const {
  std::vector<std::size_t> fields(places.size());
  smallest_fields(places, fields, values);
}

bool MinimumSize::prefers_blocks() const {
  return std::ranges::any_of(fields_, [](const SizeField* field) { return field->prefers_blocks(); });
}

bool MinimumSize::jumps() const {
  return std::ranges::any_of(fields_, [](const SizeField* field) { return field->jumps(); });
}

std::size_t MinimumSize::memory_bytes() const {
  std::size_t bytes = 0;
  for (const SizeField* field : fields_)
    bytes += field->memory_bytes();
  return bytes;
}

} // namespace trime::sizing
