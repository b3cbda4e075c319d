// SPDX-License-Identifier: BSD-3-Clause
// A hash of the content of a checkpoint, by which damage is found.
#pragma once

#include "core/random.hpp"

#include <bit>
#include <cstdint>
#include <string>

namespace trime::checkpoint {

/// Hashes words in their order. Hashes of rows are added up, so they do not depend on which rank has which row.
class ContentHash {
public:
  explicit ContentHash(std::uint64_t seed) : value_(mix_bits(seed)) {}
  void add(std::int64_t word) { value_ = mix_bits(value_ ^ static_cast<std::uint64_t>(word)); }
  void add(double number) { add(std::bit_cast<std::int64_t>(number)); }
  void add(const std::string& text) {
    for (const char c : text)
      add(std::int64_t{static_cast<unsigned char>(c)});
    add(static_cast<std::int64_t>(text.size()));
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_;
};

} // namespace trime::checkpoint
