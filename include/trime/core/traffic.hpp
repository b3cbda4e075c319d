// SPDX-License-Identifier: BSD-3-Clause
// What a rank has sent and how often it has waited for all others. Plain data; counted in `comm`.
#pragma once

#include <cstdint>

namespace trime {

/// Since the communicator was made.
struct Traffic {
  std::int64_t messages = 0;    ///< sent to one rank; those of more than 1 GiB count once for each GiB
  std::int64_t bytes = 0;       ///< of these messages
  std::int64_t collectives = 0; ///< in which all ranks take part

  Traffic& operator+=(const Traffic& other) {
    messages += other.messages;
    bytes += other.bytes;
    collectives += other.collectives;
    return *this;
  }
  friend Traffic operator-(Traffic a, const Traffic& b) {
    return {a.messages - b.messages, a.bytes - b.bytes, a.collectives - b.collectives};
  }
};

} // namespace trime
