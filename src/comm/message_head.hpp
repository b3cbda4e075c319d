// SPDX-License-Identifier: BSD-3-Clause
// Splits a message into a head of bounded size and the rest, because only the sender knows the size of the whole.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace trime::comm {

/// [bytes] Largest size of a head. MPI sends messages of this size at once, without waiting for the receiver.
inline constexpr std::size_t head_bytes = 4096;
using HeadSize = std::uint64_t;
inline constexpr std::size_t most_in_head = head_bytes - sizeof(HeadSize);

/// Returns the head of a message: its size, and as many of its bytes as fit.
inline std::vector<std::byte> head_of(std::span<const std::byte> data) {
  const HeadSize size = data.size();
  std::vector<std::byte> head(sizeof size + std::min(data.size(), most_in_head));
  std::memcpy(head.data(), &size, sizeof size);
  std::copy_n(data.begin(), head.size() - sizeof size, head.begin() + sizeof size);
  return head;
}

/// Removes the size from a received head, so that only bytes of the message are left. Returns how many bytes follow.
inline std::size_t open_head(std::vector<std::byte>& head) {
  HeadSize size = 0;
  std::memcpy(&size, head.data(), sizeof size);
  head.erase(head.begin(), head.begin() + sizeof size);
  head.resize(std::min<std::size_t>(size, most_in_head));
  return size - head.size();
}

/// Returns the bytes that follow the head; there may be none.
inline std::span<const std::byte> rest_of(std::span<const std::byte> data) {
  return data.subspan(std::min(data.size(), most_in_head));
}

} // namespace trime::comm
