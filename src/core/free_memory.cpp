// SPDX-License-Identifier: BSD-3-Clause
#include "core/free_memory.hpp"

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fmt/format.h>

namespace trime {

std::string out_of_memory_text() {
  return fmt::format("out of memory; use fewer points or more nodes: the mesh needs about {:.0f} bytes per point, and "
                     "each rank needs memory for the shape and the size field",
                     bytes_per_point);
}

void return_free_memory() {
#if defined(__GLIBC__) && !defined(TRIME_SHARED_HEAP)
  malloc_trim(0);
#endif
}

} // namespace trime
