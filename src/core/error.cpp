// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace trime {
namespace {

/// " on rank 3", as the launcher numbers the processes; empty without a launcher. MPI itself may be the cause of the
/// error, and this module does not know it.
std::string rank_text() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(name))
      return fmt::format(" on rank {}", rank);
  return "";
}

} // namespace

void assertion_failed(const char* expression, const char* file, int line, const std::string& values) {
  fmt::print(stderr,
             "TriMe-MPI: internal error{}: {}:{}: '{}' does not hold. {}\nPlease report this with the config or the "
             "program.\n",
             rank_text(), file, line, expression, values);
  std::fflush(stderr);
  std::abort();
}

} // namespace trime
