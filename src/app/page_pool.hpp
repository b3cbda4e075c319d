// SPDX-License-Identifier: BSD-3-Clause
// Memory for large arrays that is used again: pages that the system has to find and clear cost more than what most
// loops do with them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>

namespace trime::app {

/// @brief Blocks of one reserved range of addresses. A freed block keeps its pages for the next one, as long as blocks
/// in use and kept pages together are no more than were ever in use at one time: so it never raises the peak of memory.
/// Asks the system for huge pages. O(blocks) a call, so not for small things. The addresses are never given back.
/// Thread-safe.
class PagePool {
public:
  constexpr PagePool() = default;

  /// A block, or null if there is no room for it here: then memory must come from elsewhere.
  void* allocate(std::size_t bytes);
  /// Frees a block. Returns false if the pointer is not one of its blocks.
  bool deallocate(void* block);

  /// Bytes of blocks in use; bytes of pages that are kept for others.
  std::size_t used() const { return used_; }
  std::size_t kept() const { return kept_; }

private:
  /// Ranges follow each other without a gap, by address.
  struct Range {
    std::size_t begin = 0, size = 0; // bytes
    bool used = false, has_pages = false;
  };
  static constexpr std::size_t most_ranges = 4096, none = most_ranges;

  bool reserve();
  std::size_t best_range(std::size_t size, bool has_pages) const;
  std::size_t grow(std::size_t size);
  bool append(std::size_t size);
  void erase(std::size_t k);
  void split(std::size_t k, std::size_t size);
  void join(std::size_t k);
  void return_pages(std::size_t bytes);

  std::mutex mutex_;
  std::atomic<std::byte*> begin_ = nullptr; // set once, after room_
  std::size_t room_ = 0, top_ = 0;          // bytes that are reserved; that the ranges take
  std::size_t granule_ = 0;                 // sizes of ranges are multiples of it
  bool tried_ = false;
  std::array<Range, most_ranges> ranges_{};
  std::size_t count_ = 0;
  std::size_t used_ = 0, kept_ = 0, most_used_ = 0;
};

} // namespace trime::app
