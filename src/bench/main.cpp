// SPDX-License-Identifier: BSD-3-Clause
// trime_bench: kernels of the mesher, and CGAL's Delaunay triangulation as the yardstick. Start it with
// OMP_NUM_THREADS=1 for figures of one core.
#include "trime/comm/communicator.hpp"

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  trime::comm::Environment environment(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
