// SPDX-License-Identifier: BSD-3-Clause
#include "app/machine.hpp"

#include "app/build_info.hpp"
#include "core/processors.hpp"
#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "trime/io/mesh_file.hpp"

#include <unistd.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace trime::app {
namespace {

std::int64_t hash_text(const std::string& text) {
  std::uint64_t hash = text.size();
  for (const char c : text)
    hash = mix_bits(hash ^ static_cast<unsigned char>(c));
  return static_cast<std::int64_t>(hash >> 1);
}

/// How many ranks were started with this one, as its launcher says: mpirun of Open MPI, mpiexec of MPICH, srun; 0: none
/// says so. The variable of srun comes last: Open MPI lets it start its daemons.
int ranks_started() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* value = std::getenv(name); value != nullptr)
      return std::atoi(value);
  return 0;
}

/// [threads] 4096 of them took 1.4 GB on two cores, for a mesh of 1000 points; some systems start no more of them.
int most_threads(int cores) {
  constexpr int of_a_core = 16, of_any_rank = 64;
  return std::max(of_any_rank, of_a_core * cores);
}

} // namespace

Placement place_threads(int setup_threads, int mesh_threads, const comm::Communicator& comm) {
  const std::vector<int> processors = usable_processors();
  const comm::Communicator node = comm.node();
  const std::int64_t mine = hash_text(fmt::format("{}", fmt::join(processors, " ")));
  const std::vector<std::int64_t> places = node.all_gather(mine);
  Placement placement;
  placement.ranks = comm.size();
  placement.nodes = static_cast<int>(comm.sum(std::int64_t{node.is_root()}));
  placement.cores = static_cast<int>(processors.size());
  placement.sharing = static_cast<int>(std::count(places.begin(), places.end(), mine));
  const char* given = std::getenv("OMP_NUM_THREADS");
  const int all = given && *given ? thread_count() : std::max(1, placement.cores / placement.sharing);
  placement.threads = mesh_threads > 0 ? mesh_threads : all;
  placement.setup_threads = setup_threads > 0 ? setup_threads : all;
  placement.asked = std::max(placement.threads, placement.setup_threads);
  for (int* const threads : {&placement.threads, &placement.setup_threads})
    *threads = std::min(*threads, most_threads(placement.cores));
  placement.before = static_cast<int>(std::count(places.begin(), places.begin() + node.rank(), mine));
  return placement;
}

void use_threads(const Placement& placement, int threads) {
  set_thread_count(threads);
  if (threads * placement.sharing <= placement.cores)
    spread_threads(threads, placement.before * threads);
}

void report_placement(const Placement& placement, const comm::Communicator& comm, Log& log) {
  const int used = std::max(placement.threads, placement.setup_threads);
  std::array<std::int64_t, 2> sums{used > placement.cores, used * placement.sharing > placement.cores};
  std::array<double, 5> largest{static_cast<double>(placement.threads), static_cast<double>(-placement.threads),
                                static_cast<double>(used), -static_cast<double>(placement.cores / placement.sharing),
                                -static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN))};
  comm.sum_and_max(sums, largest);
  const auto [crowded, shared] = sums;
  const int most = static_cast<int>(largest[0]), fewest = static_cast<int>(-largest[1]),
            most_used = static_cast<int>(largest[2]), fitting = static_cast<int>(-largest[3]), // threads on every rank
      node_cores = static_cast<int>(-largest[4]);                                              // of the smallest node
  const std::string setup =
      placement.setup_threads == placement.threads ? "" : fmt::format(" ({} for the set-up)", placement.setup_threads);
  log.info("{} rank{} x {} thread{}{} on {} node{}", placement.ranks, placement.ranks == 1 ? "" : "s",
           fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most), most == 1 ? "" : "s", setup,
           placement.nodes, placement.nodes == 1 ? "" : "s");
  if (placement.asked > used)
    log.warning("{} threads were requested, but a rank uses only {}: at most 16 per core, or 64; the mesh is the same",
                placement.asked, used);
  if (const int started = ranks_started(); comm.size() == 1 && started > 1)
    log.warning("{} processes were launched, but each sees only itself and makes the whole mesh: mpiexec belongs to a "
                "different MPI than this program ({}); start the program with the mpiexec of that MPI, or see "
                "jobs/README.md for srun",
                started, comm::library_version());
  if (comm::is_simulated())
    return; // its cores are not those of this machine
  if (crowded > 0 && node_cores > 0 && most_used > node_cores)
    log.warning("{} of {} ranks have more threads than cores they may use (rank 0: {} threads, {} cores); the node has "
                "{} core{}: {}set --threads {}",
                crowded, placement.ranks, used, placement.cores, node_cores, node_cores == 1 ? "" : "s",
                placement.cores < node_cores ? "start with mpirun --bind-to none and " : "", node_cores);
  else if (crowded > 0)
    log.warning("{} of {} ranks have more threads than cores they may use (rank 0: {} threads, {} cores); start with "
                "mpirun --map-by slot:PE={} or --bind-to none, or set --threads",
                crowded, placement.ranks, used, placement.cores, most_used);
  else if (shared > 0)
    log.warning("{} of {} ranks share their cores with other ranks, and together they have more threads than cores; {}",
                shared, placement.ranks,
                fitting > 0 ? fmt::format("set --threads {} or start fewer ranks", fitting) : "start fewer ranks");
}

std::int64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0)
      return std::strtoll(line.c_str() + 6, nullptr, 10) * 1024;
  return 0;
}

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

std::string utc_time() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

BuildInfo build_info() {
#if defined(__clang__)
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "g++ " __VERSION__;
#endif
  return {TRIME_VERSION, TRIME_GIT_COMMIT, TRIME_BUILD_TYPE, compiler, comm::library_version(), io::hdf5_version()};
}

} // namespace trime::app
