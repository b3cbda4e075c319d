// SPDX-License-Identifier: BSD-3-Clause
#include "app/short_waits.hpp"

#include <cstdlib>
#include <unistd.h>

namespace trime::app {

void shorten_waits([[maybe_unused]] char** argv) {
#if defined(__linux__) && !defined(TRIME_SIMULATE)
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr)
    return;
  setenv("GOMP_SPINCOUNT", "2000", 0); // about 10 us, which is what waking up takes
  setenv("KMP_BLOCKTIME", "0", 0);     // the same for LLVM's OpenMP, in milliseconds
  execv("/proc/self/exe", argv);       // returns only if it fails: then the threads spin
#endif
}

} // namespace trime::app
