// SPDX-License-Identifier: BSD-3-Clause
// Composes and takes apart messages. A message whose size only the sender knows begins with a head, which holds the
// size and the first bytes; the receiver provides room for the head alone. A Parcel holds several lists in one message.
#pragma once

#include "trime/comm/communicator.hpp"

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

/// Returns the head of a message: its size, followed by as many of its bytes as fit.
inline std::vector<std::byte> head_of(std::span<const std::byte> data) {
  const HeadSize size = data.size();
  std::vector<std::byte> head(sizeof size + std::min(data.size(), most_in_head));
  std::memcpy(head.data(), &size, sizeof size);
  std::copy_n(data.begin(), head.size() - sizeof size, head.begin() + sizeof size);
  return head;
}

/// Removes the size from a received head, so that only bytes of the message are left. Returns how many bytes of the
/// message follow the head.
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

/// @brief Holds several lists of trivially copyable values. Lists are taken out in the order in which they were added.
/// An empty parcel gives empty lists.
class Parcel {
public:
  Parcel() = default;
  /// Takes a received message, whose lists can then be taken out.
  explicit Parcel(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  void add(const std::vector<T>& list) {
    const std::uint64_t count = list.size();
    append(std::as_bytes(std::span(&count, 1)));
    append(std::as_bytes(std::span<const T>(list)));
  }
  /// Takes out the next list.
  /// @pre T is the type with which the list was added
  template <class T>
  std::vector<T> take() {
    if (next_ == bytes_.size())
      return {};
    const std::uint64_t count = from_bytes<std::uint64_t>(cut(sizeof(std::uint64_t))).front();
    return from_bytes<T>(cut(static_cast<std::size_t>(count) * sizeof(T)));
  }
  /// Returns the message to be sent.
  std::vector<std::byte> release() { return std::move(bytes_); }

private:
  void append(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
  std::span<const std::byte> cut(std::size_t size) {
    const std::size_t begin = next_;
    next_ += size;
    return std::span<const std::byte>(bytes_).subspan(begin, size);
  }

  std::vector<std::byte> bytes_;
  std::size_t next_ = 0; // position of the byte that is taken next
};

} // namespace trime::comm
