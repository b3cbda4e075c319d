// SPDX-License-Identifier: BSD-3-Clause
// Memory for large arrays: huge pages, and used again. Of the program only: a library must not choose for the program
// that uses it.
//
// Arrays of a point each are touched over and over, in an order that small pages slow down (a fifth of the time of a
// run of 10^6 points). They live for one stage only, or for one sorting: pages that go back to the system each time are
// cleared each time. What the C library keeps of large blocks would be a second copy in the peak of memory.
#include "app/large_arrays.hpp"

#include "app/page_pool.hpp"

#include <cstddef>
#include <cstdlib>
#include <new>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

// Sanitizers have no use for these, see below.
[[maybe_unused]] constexpr std::size_t large = std::size_t{256} << 10; // 64 small pages
[[maybe_unused]] constinit trime::app::PagePool pool;

} // namespace

namespace trime::app {

void prepare_large_arrays() {
#ifdef __GLIBC__
  constexpr int kept_at_the_top = 16 << 20;   // of the heap for small things
  constexpr int large_elsewhere = 4 << 20;    // arrays of libraries, which do not come from the pool
  mallopt(M_MMAP_THRESHOLD, large_elsewhere); // fixed, so that freed arrays never become part of the heap
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
  if (bytes >= large)
    if (void* memory = pool.allocate(bytes))
      return memory;
  for (;;) {
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1))
      return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler)
      throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  if (!pool.deallocate(memory))
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

#endif
