// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace trime {

void assertion_failed(const char* expression, const char* file, int line, const std::string& values) {
  fmt::print(stderr, "trime_mpi: internal error: {}:{}: '{}' does not hold. {}\nPlease report this with the config.\n",
             file, line, expression, values);
  std::fflush(stderr);
  std::abort();
}

} // namespace trime
