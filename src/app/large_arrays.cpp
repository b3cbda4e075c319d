// SPDX-License-Identifier: BSD-3-Clause
// Memory for large arrays: huge pages, and back to the system at once. Of the program only: a library must not choose
// for the program that uses it.
//
// Arrays of a point each are touched over and over, in an order that small pages slow down (a fifth of the time of a
// run of 10^6 points), and they live for one stage only: what the C library keeps of them for later is a second copy in
// the peak of memory.
#include "app/large_arrays.hpp"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

constexpr std::size_t large = std::size_t{4} << 20;

#ifdef MADV_HUGEPAGE
/// A wish only: systems may not have huge pages, or none to spare. Sanitizers have no use for it, see below.
[[maybe_unused]] void ask_for_huge_pages(void* memory, std::size_t bytes) {
  constexpr std::uintptr_t page = 4096;
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}
#else
[[maybe_unused]] void ask_for_huge_pages(void*, std::size_t) {}
#endif

} // namespace

namespace trime::app {

void prepare_large_arrays() {
#ifdef __GLIBC__
  constexpr int kept_at_the_top = 16 << 20;           // of the heap for small things
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(large)); // fixed, so that freed arrays never become part of the heap
  mallopt(M_TRIM_THRESHOLD, kept_at_the_top);
#endif
}

} // namespace trime::app

// Sanitizers have operators of their own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define TRIME_SANITIZED
#endif
#endif
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(TRIME_SANITIZED)

void* operator new(std::size_t bytes) {
  for (;;) {
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) {
      if (bytes >= large)
        ask_for_huge_pages(memory, bytes);
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (!handler)
      throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif
