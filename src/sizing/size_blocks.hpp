// SPDX-License-Identifier: BSD-3-Clause
// Asks a size field for many places at a time, because one call of a size in an interpreter takes as long as
// several hundred places.
#pragma once

#include "core/thread_loop.hpp"
#include "trime/sizing/size_field.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace trime::sizing {

/// [places] Number of sizes for which a thread asks together, if the size prefers blocks.
inline constexpr std::ptrdiff_t places_in_block = 8192;
/// [places] The same for other sizes: small enough to share the work among threads.
inline constexpr std::ptrdiff_t places_in_chunk = 256;

/// Calls body(begin, end) for blocks of the items [0, n), on any thread. Rethrows like thread_loop.
template <class Body>
void loop_over_blocks(const SizeField& size, std::ptrdiff_t n, const Body& body) {
  const std::ptrdiff_t block = size.prefers_blocks() ? places_in_block : places_in_chunk;
  thread_loop((n + block - 1) / block, 1,
              [&](std::ptrdiff_t k, int) { body(k * block, std::min(n, (k + 1) * block)); });
}

/// Returns the sizes at the places.
inline std::vector<double> sizes_at(const SizeField& size, std::span<const geometry::Vec2> places) {
  std::vector<double> values(places.size());
  size.sizes(places, values);
  return values;
}

/// Does the same with the check of checked_size: the first place with a bad size throws.
inline std::vector<double> checked_sizes_at(const SizeField& size, std::span<const geometry::Vec2> places) {
  std::vector<double> values = sizes_at(size, places);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!is_valid_size(values[k]))
      fail_for_size(places[k], values[k]);
  return values;
}

} // namespace trime::sizing
