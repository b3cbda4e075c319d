// SPDX-License-Identifier: BSD-3-Clause
// Messages with a size that only the sender knows: the receiver makes room for the head alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace trime::comm {

/// [bytes] The first part of a message with the size of all of it before: small enough for MPI to send it at once.
inline constexpr std::size_t head_bytes = 4096;
using HeadSize = std::uint64_t;
inline constexpr std::size_t most_in_head = head_bytes - sizeof(HeadSize);

/// The head of a message; what does not fit into it is sent by itself.
inline std::vector<std::byte> head_of(std::span<const std::byte> data) {
  const HeadSize size = data.size();
  std::vector<std::byte> head(sizeof size + std::min(data.size(), most_in_head));
  std::memcpy(head.data(), &size, sizeof size);
  std::copy_n(data.begin(), head.size() - sizeof size, head.begin() + sizeof size);
  return head;
}

/// Leaves what is in a received head of the message itself; returns how many bytes are still to come.
inline std::size_t open_head(std::vector<std::byte>& head) {
  HeadSize size = 0;
  std::memcpy(&size, head.data(), sizeof size);
  head.erase(head.begin(), head.begin() + sizeof size);
  head.resize(std::min<std::size_t>(size, most_in_head));
  return size - head.size();
}

/// The bytes that follow the head; may be empty.
inline std::span<const std::byte> rest_of(std::span<const std::byte> data) {
  return data.subspan(std::min(data.size(), most_in_head));
}

} // namespace trime::comm
