// SPDX-License-Identifier: BSD-3-Clause
// Packs several lists into one message.
#pragma once

#include "trime/comm/communicator.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::comm {

/// @brief Holds lists of trivially copyable values, which are taken out in the order in which they were added. An empty
/// parcel gives empty lists.
class Parcel {
public:
  Parcel() = default;
  /// Unpacks a message that has arrived.
  explicit Parcel(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  void add(const std::vector<T>& list) {
    const std::uint64_t count = list.size();
    append(std::as_bytes(std::span(&count, 1)));
    append(std::as_bytes(std::span<const T>(list)));
  }
  /// @pre T is the type that was added
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
  std::size_t next_ = 0; // byte that is taken next
};

} // namespace trime::comm
