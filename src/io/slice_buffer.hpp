// SPDX-License-Identifier: BSD-3-Clause
// Memory for what is copied to and from files.
#pragma once

#include "trime/core/types.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace trime::io {

/// @brief Bytes, not set, that lie half a page off from their place in the file, counted modulo the page size. Where
/// the two differ by a few bytes only, processors take loads for loads of what was just stored, and copies between the
/// buffer and the pages of the file are ten times slower. Aligned to cache lines.
class SliceBuffer {
public:
  /// @param place of the first byte, from the begin of the file; forgets what the buffer held
  void resize(std::size_t bytes, std::uint64_t place) {
    memory_.resize(bytes + page);
    const std::uintptr_t wanted = (static_cast<std::uintptr_t>(place) + page / 2) / line * line;
    shift_ = (wanted - reinterpret_cast<std::uintptr_t>(memory_.data())) % page;
  }
  std::byte* data() { return memory_.data() + shift_; }
  const std::byte* data() const { return memory_.data() + shift_; }

  friend void swap(SliceBuffer& a, SliceBuffer& b) noexcept {
    std::swap(a.memory_, b.memory_);
    std::swap(a.shift_, b.shift_);
  }

private:
  static constexpr std::size_t page = 4096, line = 64;
  UnsetVector<std::byte> memory_;
  std::size_t shift_ = 0;
};

} // namespace trime::io
