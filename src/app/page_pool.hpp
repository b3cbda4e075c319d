// SPDX-License-Identifier: BSD-3-Clause
// Allocates memory for large arrays, and reuses memory that was freed. Getting new pages from the system, which clears
// them, takes longer than most loops over the array.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>

namespace trime::app {

/// @brief Allocates blocks in one reserved range of addresses. The pages of a freed block are kept for the next block,
/// as long as used and kept pages together are no more than the largest number in use so far; so the pool never raises
/// the peak of memory. Asks the system for huge pages. A call costs O(blocks), so the pool does not suit small objects.
/// The range of addresses is never given back. Thread-safe.
class PagePool {
public:
  constexpr PagePool() = default;

  /// Returns a new block; null if the pool has no room for it, so that the caller must use other memory.
  void* allocate(std::size_t bytes);
  /// Frees a block. Returns false if the pointer does not belong to this pool.
  bool deallocate(void* block);

  /// Returns the bytes of blocks in use.
  std::size_t used() const { return used_; }
  /// Returns the bytes of pages that are kept for later blocks.
  std::size_t kept() const { return kept_; }

private:
  /// A used or free range of addresses. Ranges are ordered by address and have no gaps between them.
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
  std::size_t room_ = 0, top_ = 0;          // bytes that are reserved, and bytes that the ranges take up
  std::size_t granule_ = 0;                 // the size of each range is a multiple of this number of bytes
  bool tried_ = false;
  std::array<Range, most_ranges> ranges_{};
  std::size_t count_ = 0;
  std::size_t used_ = 0, kept_ = 0, most_used_ = 0;
};

} // namespace trime::app
