// SPDX-License-Identifier: BSD-3-Clause
#include "app/program.hpp"

#include "app/checkpoint_keeper.hpp"
#include "app/command_line.hpp"
#include "app/config.hpp"
#include "app/convert.hpp"
#include "app/machine.hpp"
#include "app/option_table.hpp"
#include "app/provenance.hpp"
#include "app/run_report.hpp"
#include "app/run_summary.hpp"
#include "app/shape_builder.hpp"
#include "app/size_builder.hpp"
#include "app/stop_file.hpp"
#include "boundary/fixed_points.hpp"
#include "core/free_memory.hpp"
#include "core/state_fields.hpp"
#include "core/thread_loop.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "io/report_file.hpp"
#include "polygon/simplification.hpp"
#include "sites/rules.hpp"
#include "trime/io/mesh_series.hpp"
#include "trime/meshing/mesher.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace trime::app {
namespace {

void print(const comm::Communicator& comm, const std::string& text) {
  if (comm.is_root())
    std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::string version_text() {
  const BuildInfo build = build_info();
  return fmt::format("trime_mpi {} (commit {}, {})\ncompiler {}\nMPI      {}\nHDF5     {}\n", build.version,
                     build.git_commit, build.build_type, build.compiler, build.mpi_library, build.hdf5_library);
}

/// In checkpoints, which serve the same program only.
std::string program_name() {
  const BuildInfo build = build_info();
  return fmt::format("trime_mpi {} (commit {})", build.version, build.git_commit);
}

/// Points that the options ask for.
double expected_points(const RunOptions& options, const geometry::Boundary& boundary) {
  return options.mesh.points ? static_cast<double>(*options.mesh.points)
                             : fitting::points_of_length(boundary, options.mesh.edge_length.value_or(1));
}

/// Each rank takes about an equal share of the points.
void check_share(double points, int ranks) {
  constexpr auto most = static_cast<double>(sites::SiteRules::most_owned);
  if (points / ranks > most)
    throw ConfigError(fmt::format(
        "about {:.3g} points are too many for {} rank{}: a rank can own at most {:.3g}; start {:.0f} or more", points,
        ranks, ranks == 1 ? "" : "s", most, std::ceil(points / most)));
}

/// Bytes at the peak.
struct MemoryEstimate {
  double of_rank, of_first; // rank 0 may simplify the boundary for all
  double of_all(int ranks) const { return of_first + (ranks - 1) * of_rank; }
};
MemoryEstimate estimate_memory(const RunOptions& options, double points, const geometry::Boundary& boundary,
                               int ranks) {
  const auto pieces = static_cast<double>(polygon::piece_count(boundary));
  const boundary::FeatureOptions& features = options.mesh.features;
  const bool simplifies = !features.keep_all && features.within > 0 && !boundary.periods.any();
  const double of_rank = points / ranks * bytes_per_point + points * bytes_per_point_on_each_rank +
                         pieces * bytes_per_piece + bytes_per_process;
  const double more = simplifies ? pieces * bytes_per_simplified_piece : 0;
  return {pieces < static_cast<double>(fitting::LayoutRules::many_pieces) ? of_rank + more : of_rank, of_rank + more};
}

/// Returns the output of --validate and --dry-run, in place of a mesh.
std::string estimate(const RunOptions& options, const geometry::Boundary& boundary, const Placement& placement,
                     bool with_decomposition) {
  const double points = expected_points(options, boundary);
  std::string text = fmt::format(
      "shape: area {:.6g}, boundary length {:.6g}, {} component{}, {} hole{}\n", boundary.area, boundary.length(),
      boundary.components(), boundary.components() == 1 ? "" : "s", boundary.holes(), boundary.holes() == 1 ? "" : "s");
  const MemoryEstimate memory = estimate_memory(options, points, boundary, placement.ranks);
  text += fmt::format(
      "about {:.0f} points, {:.0f} triangles, {:.1f} MiB of memory over all ranks, at most {:.1f} per rank\n", points,
      2 * points, memory.of_all(placement.ranks) / 0x1p20, memory.of_first / 0x1p20);
  if (with_decomposition)
    text += fmt::format("{} rank{} x {} threads: about {:.0f} points per rank, {:.0f} per thread\n", placement.ranks,
                        placement.ranks == 1 ? "" : "s", placement.threads, points / placement.ranks,
                        points / placement.ranks / placement.threads);
  return text + fmt::format("output: {} (not written)", options.output.file.path(".h5"));
}

/// A count with two digits that matter: 513.7 becomes 510.
double rounded(double count) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(std::max(count, 1.0))) - 1));
  return std::round(count / unit) * unit;
}

/// Prints what --dry-run finds out about the boundary.
void print_outlook(const meshing::Outlook& outlook, Log& log) {
  for (const std::string& line : boundary::describe(outlook.features))
    log.summary("boundary: {}", line);
  if (outlook.keeps_all) {
    log.summary("nothing of the shape is simplified at this size");
    return;
  }
  if (const std::string warning = boundary::loss_warning(outlook.features); !warning.empty())
    log.warning("{}", warning);
  log.summary("{} {:.0f} points ({} {:.2g}) keep everything", outlook.is_enough ? "about" : "more than about",
              rounded(outlook.keeping_points), outlook.is_enough ? "edge_length =" : "edge_length below",
              outlook.keeping_edge_length);
}

/// Throws as the run would.
void check_fixed_points(const meshing::MeshOptions& options, const shape::RegionShape& shape, Log& log) {
  const geometry::Lattice lattice(options.container);
  const boundary::FixedPoints checked(shape.boundary(), options.container, options.fixed_points, lattice, log);
  for (const boundary::FixedPoint& point : options.fixed_points) {
    const geometry::Vec2 p = shape.boundary().periods.wrap(lattice.snap(point.position));
    if (std::binary_search(checked.inside().begin(), checked.inside().end(), p, geometry::lexicographically_less) &&
        !shape.inside(p))
      throw GeometryError(fmt::format("{}: the fixed point ({:.9g}, {:.9g}) lies outside the shape, {:.6g} from its "
                                      "boundary",
                                      point.label, p.x, p.y, shape.distance_to_boundary(p)));
  }
}

/// Config, shape and what surrounds them, ready to be meshed.
struct Job {
  const comm::Communicator& comm;
  const CommandLine& line;
  const std::string& config_text;
  const RunOptions& options;
  io::RunFiles* files;
  SignalRequests& signals;
  UserPlaces& places;
  Log& log;
  TimerTable& timers;
};

/// The mesher with what is written while it runs.
meshing::MeshResult run_mesher(const Job& job, const Provenance& provenance, const sizing::SizeField& size,
                               const meshing::MeshOptions& options, io::MeshSeries& series, CheckpointKeeper& keeper,
                               const std::optional<meshing::SavedRun>& saved) {
  meshing::Mesher mesher(job.comm, provenance.boundary, size, options, job.log, job.timers);
  mesher.on_snapshot([&](const meshing::Snapshot& snapshot) { // timed by the mesher
    series.write_step({snapshot.retriangulation, snapshot.mesh, snapshot.quality, describe_step(provenance, snapshot)});
  });
  if (saved) {
    mesher.go_on_from(*saved);
    int triangulations = 0;
    StateFields::restoring(saved->state.numbers).field("triangulations", triangulations);
    if (job.options.write)
      for (const std::string& warning : series.go_on_after(triangulations))
        job.log.warning("{}", warning);
  }
  mesher.keep_checkpoints(keeper);
  return mesher.run();
}

io::SeriesOptions series_options(const Job& job, const ShapeInput& input) {
  const geometry::Boundary& boundary = input.boundary();
  io::SeriesOptions options = job.options.output;
  options.file.part_markers = input.part_markers();
  options.file.run_files = job.files;
  options.period = {boundary.periods.x, boundary.periods.y};
  return options;
}

/// The switches of the environment must be the same on all ranks, since they decide where ranks work together;
/// launchers do not pass them to all ranks. Rank 0 decides. Collective.
sweep::StarTests of_root(const sweep::StarTests& tests, const comm::Communicator& comm) {
  const std::string of_root = comm.broadcast(
      std::string{tests.verify ? '1' : '0', tests.by_emptiness ? '1' : '0', tests.sleepless ? '1' : '0'});
  return {of_root[0] == '1', of_root[1] == '1', of_root[2] == '1'};
}

ExitCode make_mesh(const Job& job) {
  const comm::Communicator& comm = job.comm;
  RunOptions options = job.options;
  options.mesh.star_tests = of_root(options.mesh.star_tests, comm);
  const bool is_run = job.line.action == Action::mesh;
  Log& log = job.log;
  TimerTable& timers = job.timers;
  const Placement placement = place_threads(options.setup_threads, options.mesh_threads, comm);
  use_threads(placement, placement.setup_threads);
  report_placement(placement, comm, log);
  for (const std::string& warning : options.warnings)
    log.warning("{}", warning);
  check_stop_file(options, job.line, comm);

  const ShapeInput input = [&] {
    const auto timing = timers.scope("shape");
    return read_shape(options, is_run ? ShapeUse::boundary : ShapeUse::queries, comm, log, job.places);
  }();
  if (const geometry::Box& box = input.container;
      options.container_is_automatic && box.max != geometry::unit_square.max)
    log.info("container: x from {:.9g} to {:.9g}, y from {:.9g} to {:.9g}, chosen around the shape because [domain] "
             "sets no sides",
             box.min.x, box.max.x, box.min.y, box.max.y);
  options.mesh.container = input.container;
  log.set_rewriter([&places = job.places](const std::string& message) { return places.explain(message); });
  const geometry::Boundary& boundary = input.boundary();
  meshing::MeshOptions mesh_options = options.mesh;
  mesh_options.fixed_points = read_fixed_points(options, input, comm);
  io::MeshFileOptions checkpoint_output = options.output.file;
  checkpoint_output.run_files = job.files;
  CheckpointKeeper keeper({comm, checkpoint_output, job.signals, timers, log}, options.checkpoint, job.line.time_limit,
                          {program_name(), options.resolved});
  const std::optional<meshing::SavedRun> saved = keeper.find(job.line.restart); // before directories are made
  io::MeshSeries series(series_options(job, input), comm);
  if (const double points = expected_points(options, boundary); options.write)
    for (const std::string& warning : is_run ? series.check(points) : series.look(points))
      log.warning("{}", warning);
  check_exports(options, comm);
  if (!job.line.report.empty())
    io::check_report_file(job.line.report, comm);
  const BuiltSize size = [&] {
    const auto timing = timers.scope("size field");
    return build_size(options, boundary, comm);
  }();
  if (placement.threads != placement.setup_threads)
    use_threads(placement, placement.threads);
  const bool is_dry_run = job.line.action == Action::dry_run;
  if (!is_run) {
    check_fixed_points(mesh_options, *input.shape, log);
    log.summary("{}", estimate(options, boundary, placement, is_dry_run));
  }
  check_share(expected_points(options, boundary), placement.ranks);
  if (!is_run) {
    Log quiet(LogLevel::error, comm.is_root());         // its warnings were printed before
    if (is_dry_run || mesh_options.features.keep_all) { // where nothing gives way the layout may fail
      const meshing::Outlook outlook =
          meshing::Mesher(comm, boundary, *size.field, mesh_options, quiet, timers).outlook();
      if (is_dry_run)
        print_outlook(outlook, log);
    }
    return ExitCode::done;
  }

  const Provenance provenance{job.line,
                              options,
                              job.config_text,
                              placement,
                              boundary,
                              input.normalized,
                              job.places.ring_lines(boundary),
                              input.map,
                              input.part_markers()};
  const meshing::MeshResult result = run_mesher(job, provenance, *size.field, mesh_options, series, keeper, saved);
  const SizeSummary sizes = summarize_size(size.description, result.mesh, comm);
  io::WrittenFiles files;
  keeper.go_to_the_end();
  if (options.write) {
    const io::Metadata metadata = describe_run(provenance, result, sizes, gather_measurements(timers, comm));
    const auto timing = timers.scope("output");
    files = series.write_final({final_retriangulation(result), result.mesh, result.quality, metadata});
    const formats::Names names{
        boundary.part_names, {options.geometry}, {boundary.periods.x, boundary.periods.y}, input.map.crs};
    for (const std::string& path : write_exports(options, result.mesh, names, job.files, comm))
      files.paths.push_back(path);
  }
  const Measurements measured = gather_measurements(timers, comm);
  if (!job.line.report.empty())
    io::write_report_file(job.line.report, describe_run(provenance, result, sizes, measured),
                          {static_cast<int>(exit_code(result)), files.paths}, comm);
  keeper.remove_all();
  const std::vector<std::int64_t> edges = edges_of_parts(result.mesh, boundary.part_names.size(), comm);
  if (options.log_level <= LogLevel::info)
    log.info("{}", run_report(result, sizes, measured, files, input.normalized));
  else
    log.summary("{}", run_summary({provenance, result, sizes, measured, files, edges}));
  if (!is_complete(result))
    log.warning("{}", incompleteness(result, options.write));
  return exit_code(result);
}

} // namespace

ExitCode run_program(int argc, const char* const* argv, const comm::Communicator& comm, io::RunFiles* files,
                     SignalRequests& signals, UserPlaces& places) {
  TimerTable timers(&comm.counters());
  const CommandLine line = parse_command_line(argc, argv);
  if (line.action == Action::help || line.action == Action::help_config || line.action == Action::version) {
    print(comm, line.action == Action::help      ? line.help
                : line.action == Action::version ? version_text()
                                                 : help_config());
    return ExitCode::done;
  }
  if (line.action == Action::info) {
    print(comm, info(line.files[0], comm));
    return ExitCode::done;
  }
  if (line.action == Action::convert) {
    Log log(LogLevel::info, comm.is_root());
    convert(line, files, comm, log);
    return ExitCode::done;
  }
  const std::string config_text = read_shared(line.config, comm);
  const RunOptions options = parse_config(config_text, line.config, line.overrides);
  if (line.action == Action::print_config) {
    print(comm, options.resolved);
    return ExitCode::done;
  }
  Log log(options.log_level, comm.is_root());
  log.set_progress_interval(options.log_interval);
  if (line.action == Action::mesh)
    timers.on_section([&log](const std::string& name) { log.phase(name == "measure" ? "sweeps" : name); });
  return make_mesh({comm, line, config_text, options, files, signals, places, log, timers});
}

} // namespace trime::app
