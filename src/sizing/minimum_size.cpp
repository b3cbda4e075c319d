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
