// SPDX-License-Identifier: BSD-3-Clause
#include "app/short_waits.hpp"

#include <array>
#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace trime::app {

void shorten_waits([[maybe_unused]] char** argv) {
#if defined(__linux__) && !defined(TRIME_SIMULATE)
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr)
    return;
  // By its path: through /proc/self/exe, the system would call the process "exe".
  std::array<char, 4096> path{};
  const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
  if (length <= 0 || length + 1 == static_cast<ssize_t>(path.size()))
    return;
  const std::string_view name(path.data(), static_cast<std::size_t>(length));
  if (name.substr(name.rfind('/') + 1).starts_with("ld-")) // the dynamic loader was called by hand
    return;
  // 2000 turns take about 10 us, as waking up does. LLVM's OpenMP counts milliseconds.
  if (setenv("GOMP_SPINCOUNT", "2000", 0) != 0 || setenv("KMP_BLOCKTIME", "0", 0) != 0)
    return;
  execv(path.data(), argv); // returns only if it fails: then the threads spin
#endif
}

} // namespace trime::app
