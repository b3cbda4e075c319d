// SPDX-License-Identifier: BSD-3-Clause
#include "decomposition/selection.hpp"

#include "core/random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace trime::decomposition {

std::uint64_t selection_key(double value, geometry::Vec2 place) {
  const auto leading = static_cast<std::uint64_t>(std::clamp(value, 0.0, 1.0) * 0xffffffffp0);
  const std::uint64_t hash =
      mix_bits(mix_bits(std::bit_cast<std::uint64_t>(place.x)) ^ std::bit_cast<std::uint64_t>(place.y));
  return (leading << 32) | (hash >> 32);
}

std::uint64_t selection_threshold(const comm::Communicator& comm, std::span<const std::uint64_t> keys, std::int64_t k) {
  std::uint64_t threshold = 0; // its leading bytes are found one after the other
  std::int64_t left = std::max<std::int64_t>(0, k);
  for (int shift = 56; shift >= 0; shift -= 8) {
    std::array<std::int64_t, 256> counts{};
    const std::uint64_t known = shift == 56 ? 0 : ~std::uint64_t{0} << (shift + 8);
    for (const std::uint64_t key : keys)
      if ((key & known) == threshold)
        ++counts[(key >> shift) & 0xff];
    comm.sum(counts);
    std::uint64_t byte = 0;
    while (byte < 256 && counts[byte] <= left)
      left -= counts[byte++];
    if (byte == 256) { // only for the first byte: every key may be taken
      return std::numeric_limits<std::uint64_t>::max();
    }
    threshold |= byte << shift;
  }
  return threshold;
}

} // namespace trime::decomposition
