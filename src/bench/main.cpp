// SPDX-License-Identifier: BSD-3-Clause
// trime_bench: kernels of the mesher, and CGAL's Delaunay triangulation as the yardstick. Start it with
// OMP_NUM_THREADS=1 for figures of one core, and with mpirun for the benchmarks of the halo; rank 0 prints.
#include "trime/comm/communicator.hpp"

#include <benchmark/benchmark.h>

namespace {

/// For the ranks that only take part.
class SilentReporter final : public benchmark::BenchmarkReporter {
public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>&) override {}
};

} // namespace

int main(int argc, char** argv) {
  trime::comm::Environment environment(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  if (trime::comm::Communicator::world().is_root()) {
    benchmark::RunSpecifiedBenchmarks();
  } else {
    SilentReporter silent;
    benchmark::RunSpecifiedBenchmarks(&silent);
  }
  benchmark::Shutdown();
  return 0;
}
