// SPDX-License-Identifier: BSD-3-Clause
#include "app/page_pool.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace trime::app {
namespace {

constexpr std::size_t least_granule = std::size_t{16} << 10; // sizes of blocks are multiples of it, or of a page
constexpr std::size_t huge_page = std::size_t{2} << 20;      // ranges begin at one
constexpr std::size_t rooms = 4; // times the memory of the machine are reserved: free ranges may lie between blocks

} // namespace

/// Addresses alone: no memory until it is touched. Where that is not allowed, as with a limit of the address space,
/// there is no pool.
bool PagePool::reserve() {
  if (tried_)
    return begin_.load() != nullptr;
  tried_ = true;
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0)
    return false;
  granule_ = std::max(least_granule, static_cast<std::size_t>(page)); // both are powers of 2
  const std::size_t bytes = rooms * static_cast<std::size_t>(pages) * static_cast<std::size_t>(page);
  void* memory =
      mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
    return false;
  const std::size_t past = reinterpret_cast<std::uintptr_t>(memory) % huge_page;
  room_ = bytes;
  begin_ = static_cast<std::byte*>(memory) + (past > 0 ? huge_page - past : 0);
#ifdef MADV_HUGEPAGE
  madvise(begin_.load(), room_, MADV_HUGEPAGE); // a wish: systems may not have huge pages, or none to spare
#endif
  return true;
}

void* PagePool::allocate(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (!reserve() || bytes > room_)
    return nullptr;
  const std::size_t size = (bytes + granule_ - 1) / granule_ * granule_;
  std::size_t k = best_range(size, true);
  if (k == none)
    k = grow(size);
  if (k == none)
    k = best_range(size, false);
  if (k == none && append(size))
    k = count_ - 1;
  if (k == none)
    return nullptr;
  split(k, size);
  Range& range = ranges_[k];
  std::byte* block = begin_.load() + range.begin;
  if (range.has_pages)
    kept_ -= range.size;
  range.used = range.has_pages = true;
  used_ += range.size;
  most_used_ = std::max(most_used_, used_);
  if (used_ + kept_ > most_used_)
    return_pages(used_ + kept_ - most_used_);
  return block;
}

bool PagePool::deallocate(void* block) {
  const std::less<const std::byte*> before;
  const std::byte *at = static_cast<const std::byte*>(block), *begin = begin_;
  if (!begin || before(at, begin) || !before(at, begin + room_))
    return false;
  const std::lock_guard lock(mutex_);
  const std::size_t offset = static_cast<std::size_t>(at - begin);
  const auto range = std::lower_bound(ranges_.begin(), ranges_.begin() + static_cast<std::ptrdiff_t>(count_), offset,
                                      [](const Range& r, std::size_t other) { return r.begin < other; });
  range->used = false;
  used_ -= range->size;
  kept_ += range->size;
  join(static_cast<std::size_t>(range - ranges_.begin()));
  return true;
}

/// The smallest free range that is large enough.
std::size_t PagePool::best_range(std::size_t size, bool has_pages) const {
  std::size_t best = none;
  for (std::size_t k = 0; k < count_; ++k)
    if (const Range& r = ranges_[k];
        !r.used && r.has_pages == has_pages && r.size >= size && (best == none || r.size < ranges_[best].size))
      best = k;
  return best;
}

/// The largest kept range that can be made so large, by what is free behind it; it counts as one without pages then.
std::size_t PagePool::grow(std::size_t size) {
  const auto room_behind = [&](std::size_t k) {
    if (k + 1 == count_)
      return room_ - top_;
    return ranges_[k + 1].used || ranges_[k + 1].has_pages ? 0 : ranges_[k + 1].size;
  };
  std::size_t best = none;
  for (std::size_t k = 0; k < count_; ++k)
    if (const Range& r = ranges_[k];
        !r.used && r.has_pages && r.size + room_behind(k) >= size && (best == none || r.size > ranges_[best].size))
      best = k;
  if (best == none)
    return none;
  Range& range = ranges_[best];
  kept_ -= range.size;
  range.has_pages = false;
  const std::size_t more = size - range.size;
  range.size = size;
  if (best + 1 == count_) {
    top_ += more;
  } else {
    ranges_[best + 1].begin += more;
    ranges_[best + 1].size -= more;
    if (ranges_[best + 1].size == 0)
      erase(best + 1);
  }
  return best;
}

/// A range at the end.
bool PagePool::append(std::size_t size) {
  if (count_ + 2 > most_ranges || size > room_ - top_) // one more for a split elsewhere
    return false;
  ranges_[count_++] = {top_, size, false, false};
  top_ += size;
  return true;
}

/// Cuts what is more than `size` off a free range, if there is room for a range more.
void PagePool::split(std::size_t k, std::size_t size) {
  if (ranges_[k].size == size || count_ == most_ranges)
    return;
  std::copy_backward(ranges_.begin() + static_cast<std::ptrdiff_t>(k),
                     ranges_.begin() + static_cast<std::ptrdiff_t>(count_),
                     ranges_.begin() + static_cast<std::ptrdiff_t>(count_ + 1));
  ++count_;
  ranges_[k].size = size;
  ranges_[k + 1].begin += size;
  ranges_[k + 1].size -= size;
}

void PagePool::erase(std::size_t k) {
  const auto at = ranges_.begin() + static_cast<std::ptrdiff_t>(k);
  std::copy(at + 1, ranges_.begin() + static_cast<std::ptrdiff_t>(count_), at);
  --count_;
}

/// Joins a free range with neighbouring ones of its kind.
void PagePool::join(std::size_t k) {
  const auto alike = [&](std::size_t a, std::size_t b) {
    return !ranges_[a].used && !ranges_[b].used && ranges_[a].has_pages == ranges_[b].has_pages;
  };
  const auto absorb_next = [&](std::size_t at) {
    ranges_[at].size += ranges_[at + 1].size;
    erase(at + 1);
  };
  if (k + 1 < count_ && alike(k, k + 1))
    absorb_next(k);
  if (k > 0 && alike(k - 1, k))
    absorb_next(k - 1);
}

/// Gives kept pages back to the system, at least this number of bytes or all of them.
void PagePool::return_pages(std::size_t bytes) {
  std::size_t left = std::min(bytes, kept_);
  for (std::size_t k = count_; k-- > 0 && left > 0;) {
    if (k >= count_ || ranges_[k].used || !ranges_[k].has_pages)
      continue;
    split(k, std::min(ranges_[k].size, (left + granule_ - 1) / granule_ * granule_));
    Range& range = ranges_[k];
    madvise(begin_.load() + range.begin, range.size, MADV_DONTNEED);
    range.has_pages = false;
    kept_ -= range.size;
    left -= std::min(left, range.size);
    join(k);
  }
}

} // namespace trime::app
