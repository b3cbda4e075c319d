// SPDX-License-Identifier: BSD-3-Clause
// A memory buffer for data that is copied to and from files.
#pragma once

#include "trime/core/types.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace trime::io {

/// @brief A buffer of uninitialised bytes, aligned to cache lines. Modulo the page size, its address differs by half a
/// page from the position in the file. If the two were almost equal, processors would mistake loads for loads of just
/// stored data, and copies between the buffer and the pages of the file would be ten times slower.
class SliceBuffer {
public:
  /// @param place position of the first byte in the file. The old content of the buffer is lost
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
