// SPDX-License-Identifier: BSD-3-Clause
#include "app/program.hpp"

#include "app/checkpoint_keeper.hpp"
#include "app/command_line.hpp"
#include "app/config.hpp"
#include "app/convert.hpp"
#include "app/depth.hpp"
#include "app/file_roles.hpp"
#include "app/machine.hpp"
#include "app/old_mesh.hpp"
#include "app/option_table.hpp"
#include "app/provenance.hpp"
#include "app/refine.hpp"
#include "app/run_report.hpp"
#include "app/run_summary.hpp"
#include "app/shape_builder.hpp"
#include "app/size_builder.hpp"
#include "boundary/feature_rule.hpp"
#include "boundary/fixed_points.hpp"
#include "core/processors.hpp"
#include "core/state_fields.hpp"
#include "core/thread_loop.hpp"
#include "fitting/expected_points.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "formats/degrees.hpp"
#include "formats/open_boundary.hpp"
#include "io/report_file.hpp"
#include "polygon/polygon.hpp"
#include "record/acceptance_record.hpp"
#include "sites/rules.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/record/describe.hpp"

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

/// Each rank takes about an equal share of the points.
void check_share(double points, int ranks) {
  constexpr auto most = static_cast<double>(sites::SiteRules::most_owned);
  if (points / ranks > most)
    throw ConfigError(fmt::format(
        "about {:.3g} points are too many for {} rank{}: a rank can own at most {:.3g}; start at least {:.0f} ranks",
        points, ranks, ranks == 1 ? "" : "s", most, std::ceil(points / most)));
}

/// Refuses before the output directory is made. The mesher counts the points of its start and checks them again.
void check_limit(const meshing::MeshOptions& options, double points) {
  // [limit] The estimate does not simplify the boundary as the run does: at a coast of fractals it was twice as high.
  constexpr double surely_more = 10;
  if (!options.absolute_sizes || !options.points || points <= surely_more * static_cast<double>(*options.points))
    return;
  fitting::FitOptions limit;
  limit.point_limit = options.points;
  fitting::check_point_limit(limit, points);
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
std::string estimate(const RunOptions& options, double points, const geometry::Boundary& boundary,
                     const Placement& placement, bool with_decomposition) {
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

/// Warns of bad triangles where curves come near each other.
void warn_of_bad_triangles(const mesh::QualitySummary& quality, Log& log) {
  if (quality.bad_triangles == 0 || quality.worst_triangles.empty())
    return;
  const mesh::BadTriangle& worst = quality.worst_triangles.front();
  const std::string corner =
      worst.corner_degrees > 0 ? fmt::format(", next to a corner of {:.3g} degrees", worst.corner_degrees) : "";
  log.warning("{} triangle{} an alpha above 2, the worst {:.3g} at {}{}: curves or interfaces come near each other "
              "there. Let them meet, move them apart, or ask for smaller triangles there",
              quality.bad_triangles, quality.bad_triangles == 1 ? " has" : "s have", worst.alpha, Place(worst.place, 6),
              corner);
}

/// Prints the warnings that a run would print about the boundary.
void print_warnings(const boundary::FeatureReport& features, const std::vector<std::string>& part_names, Log& log) {
  constexpr boundary::Occasion occasion = boundary::Occasion::outlook;
  for (const PlacedText& warning :
       {boundary::loss_warning(features, occasion), boundary::body_warning(features, part_names, occasion)})
    if (!warning.text().empty())
      log.warning("{}", warning.formatted());
}

/// Prints the resolution that keeps everything, as the user would ask for it.
void print_advice(const meshing::Outlook& outlook, Log& log) {
  if (outlook.keeping_factor > 0)
    log.summary("sizes that are {:.3g} times smaller keep everything", 1 / outlook.keeping_factor);
  else if (outlook.tried_factor > 0)
    log.summary("sizes that are {:.3g} times smaller do not keep everything yet; smaller ones were not tried",
                1 / outlook.tried_factor);
  else if (outlook.keeping_points == 0)
    log.summary("no size was found that keeps everything");
  else if (outlook.is_tried)
    log.summary("{:.0f} points keep everything; that was tried", outlook.keeping_points);
  else
    log.summary("more than {:.0f} points are needed to keep everything; no number of points was found that does",
                outlook.keeping_points);
  if (outlook.keeping_edge_length > 0)
    log.summary("edge_length = {:g} keeps everything; that was tried", outlook.keeping_edge_length);
}

/// Prints what --dry-run finds out about the boundary.
void print_outlook(const meshing::Outlook& outlook, const std::vector<std::string>& part_names, Log& log) {
  for (const PlacedText& line : boundary::describe(outlook.features))
    log.summary("boundary: {}", line.formatted());
  print_warnings(outlook.features, part_names, log);
  if (outlook.keeps_all)
    log.summary("no part of the shape is simplified at this size");
  else
    print_advice(outlook, log);
}

/// Throws as the run would.
void check_fixed_points(const shape::RegionShape& shape, Log& log) {
  const geometry::Lattice& lattice = shape.frame().lattice();
  const std::vector<geometry::FixedPoint>& points = shape.domain().fixed_points();
  const boundary::FixedPoints checked(shape.boundary(), shape.frame().container(), points, lattice, log);
  for (const geometry::FixedPoint& point : points) {
    const geometry::Vec2 p = shape.boundary().periods.wrap(lattice.snap(point.position));
    if (std::binary_search(checked.inside().begin(), checked.inside().end(), p, geometry::lexicographically_less) &&
        !shape.inside(p))
      throw GeometryError(fmt::format("{}: the fixed point {} lies outside the shape, {:.6g} from its "
                                      "boundary",
                                      point.label, Place(p), shape.distance_to_boundary(p)));
  }
}

/// Some places of the shape at which formulas are tried before a mesh is made: vertices of the boundary, and places of
/// a grid inside.
std::vector<geometry::Vec2> sample_places(const shape::RegionShape& shape) {
  constexpr std::int64_t most_vertices = 64;
  constexpr int across = 32; // places of the grid along each side
  std::vector<geometry::Vec2> places;
  const std::int64_t step = 1 + polygon::piece_count(shape.boundary()) / most_vertices;
  std::int64_t number = 0;
  for (const geometry::Loop& loop : shape.boundary().loops)
    for (const geometry::Piece& piece : loop.pieces)
      if (number++ % step == 0)
        places.push_back(piece.start);
  const geometry::Box box =
      shape.boundary().loops.empty() ? shape.frame().container() : shape.boundary().bounding_box();
  for (int k = 0; k < across * across; ++k) {
    const geometry::Vec2 p{box.min.x + (k % across + 0.5) / across * box.width(),
                           box.min.y + (k / across + 0.5) / across * box.height()};
    if (shape.inside(p))
      places.push_back(p);
  }
  return places;
}

/// Holds what a command line and its config ask for.
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

  bool is_run() const { return line.action == Action::mesh; }
};

formats::SeriesOptions series_options(const Job& job, const ShapeInput& input) {
  const geometry::Boundary& boundary = input.boundary();
  formats::SeriesOptions options = job.options.output;
  options.file.part_markers = input.domain().part_markers();
  options.file.run_files = job.files;
  formats::Names& names = options.names;
  names.parts = boundary.part_names;
  const geometry::Regions regions = record::named(input.domain().regions(), job.options.geometry);
  names.regions = regions.names;
  names.curves = input.domain().curves().names;
  names.curve_kinds = input.domain().curves().kinds;
  for (std::size_t pair = 0; pair < regions.pairs.size(); ++pair)
    names.interfaces.push_back(regions.pair_name(pair));
  names.period = {boundary.periods.x, boundary.periods.y};
  names.crs = input.map.crs;
  formats::open_parts(names); // refuses unknown names, on all ranks
  formats::check_degrees(names);
  return options;
}

io::MeshFileOptions checkpoint_options(const Job& job) {
  io::MeshFileOptions options = job.options.output.file;
  options.run_files = job.files;
  return options;
}

/// The switches of the environment must be the same on all ranks, since they decide where ranks work together;
/// launchers do not pass them to all ranks. Rank 0 decides. Collective.
sweep::StarTests of_root(const sweep::StarTests& tests, const comm::Communicator& comm) {
  const std::string of_root = comm.broadcast(
      std::string{tests.verify ? '1' : '0', tests.by_emptiness ? '1' : '0', tests.sleepless ? '1' : '0'});
  return {of_root[0] == '1', of_root[1] == '1', of_root[2] == '1'};
}

/// Sets the threads of the set-up.
Placement set_up_threads(const Job& job) {
  const Placement placement = place_threads(job.options.setup_threads, job.options.mesh_threads, job.comm);
  use_threads(placement, placement.setup_threads);
  report_placement(placement, job.comm, job.log);
  return placement;
}

/// Edges that are longer than the shape are probably in another unit than the coordinates. Another warning speaks of
/// degrees.
void warn_of_length(const RunOptions& options, const ShapeInput& input, Log& log) {
  const geometry::Box box = input.boundary().bounding_box();
  const double extent = std::fmax(box.width(), box.height());
  const GivenLength given = length_of(options);
  if (given.length > extent && extent > 0 && !input.map.may_be_degrees)
    log.warning("{} = {:g} is longer than the whole shape ({:.3g}); is it in the unit of the coordinates?", given.key,
                given.length, extent);
}

/// The shape with its fixed points. Messages name the user's places from here on.
ShapeInput read_input(const Job& job) {
  const RunOptions& options = job.options;
  for (const std::string& warning : options.warnings)
    job.log.warning("{}", warning);
  check_file_roles(options, job.line, job.comm);
  ShapeInput input = [&] {
    const auto timing = job.timers.scope("shape");
    return read_shape(options, job.is_run() ? ShapeUse::boundary : ShapeUse::queries, job.comm, job.log, job.places);
  }();
  const geometry::Box& box = input.domain().frame().container();
  if (options.container_is_automatic && box.max != geometry::unit_square.max)
    job.log.info(
        "container: x from {:.9g} to {:.9g}, y from {:.9g} to {:.9g}, chosen around the shape because [domain] "
        "sets no sides",
        box.min.x, box.max.x, box.min.y, box.max.y);
  job.log.set_rewriter([&places = job.places](const PlacedText& message) { return places.explain(message); });
  warn_of_length(options, input, job.log);
  input.set_fixed_points(read_fixed_points(options, input, job.comm));
  boundary::check_choice_of_component(input.boundary(), placed_options(options, input, job.comm).features);
  return input;
}

/// The data that formulas use. Collective.
std::vector<BuiltField> read_data(const Job& job, const ShapeInput& input) {
  if (job.options.fields.empty())
    return {};
  const auto timing = job.timers.scope("size field");
  std::vector<BuiltField> fields = read_fields(job.options, input, job.comm);
  for (const BuiltField& field : fields) {
    job.log.info("field {}: {}", field.name, description_of(field));
    if (!field.warning.empty())
      job.log.warning("{}", field.warning);
  }
  if (job.options.scale_is_automatic && job.options.sizing.uses_data)
    job.log.summary("scale = absolute, since the formula of the size uses data: its values are lengths");
  return fields;
}

/// The mesh from which the run starts, if the config names one. Collective.
std::optional<OldMesh> read_start(const Job& job) {
  if (job.options.start_file.empty())
    return std::nullopt;
  const auto timing = job.timers.scope("start");
  return read_old_mesh(job.options.start_file, job.comm);
}

/// One mesh, from the config to its files. All functions are collective.
class MeshRun {
public:
  /// Prepares: reads all input and checks that the output can be written.
  explicit MeshRun(const Job& job)
      : job_(job), placement_(set_up_threads(job)), input_(read_input(job)), fields_(read_data(job, input_)),
        old_(read_start(job)),
        keeper_({job.comm, checkpoint_options(job), job.signals, job.timers, job.log}, job.options.checkpoint,
                job.line.time_limit, {program_name(), job.options.resolved + hashes_of(fields_) + hash_of(old_)}),
        saved_(keeper_.find(job.line.restart)), // before directories are made
        series_(series_options(job, input_), job.comm), mesh_(placed_options(job.options, input_, job.comm)) {
    size_ = [&] {
      const auto timing = job.timers.scope("size field");
      return build_size(job.options, input_.domain(), job.comm, input_.bounds, fields_);
    }();
    if (!job.options.depth.text.empty())
      depth_.emplace(build_formula(job.options.depth, input_.domain(), fields_));
    points_ = meshing::Mesher(job.comm, input_.domain(), *size_.field, mesh_, job.log, job.timers).expected_points();
    if (job.is_run())
      check_limit(mesh_, points_);
    check_output();
    if (placement_.threads != placement_.setup_threads)
      use_threads(placement_, placement_.threads);
  }

  /// Prints what a run would do.
  ExitCode preview();
  /// Makes the mesh and its files.
  ExitCode run();

private:
  const geometry::Boundary& boundary() const { return input_.boundary(); }
  void check_output();
  meshing::MeshResult make_mesh(const Provenance& provenance);
  io::Metadata describe(const Provenance& provenance, const meshing::MeshResult& result, const SizeSummary& sizes,
                        const Measurements& measured) const;
  io::WrittenFiles publish(const Provenance& provenance, const meshing::MeshResult& result, const SizeSummary& sizes);
  void add_depths(meshing::MeshResult& result);
  void judge(meshing::MeshResult& result);
  SizeSummary summarize(const meshing::MeshResult& result);
  void print_results(const RunFacts& facts) const;

  const Job& job_;
  const Placement placement_;
  const ShapeInput input_;
  const std::vector<BuiltField> fields_;
  const std::optional<OldMesh> old_; // where the sites start
  CheckpointKeeper keeper_;
  const std::optional<meshing::SavedRun> saved_; // where the run goes on
  formats::MeshSeries series_;
  const meshing::MeshOptions mesh_; // with places in the container
  BuiltSize size_;
  std::optional<DistanceFormula> depth_;          // of the points, if the config asks for depths
  double points_ = 0;                             // about as many as the mesh will have
  record::SizeShares shares_;                     // of several sizes, in the final mesh
  std::optional<DepthSummary> depths_;            // of the final mesh, if the config asks for depths
  std::optional<record::CourantSummary> courant_; // of the final mesh, if the config has a time step
  std::vector<acceptance::Verdict> verdicts_;     // on the final mesh, by the rules of models
};

void MeshRun::check_output() {
  if (job_.options.write)
    for (const std::string& warning : job_.is_run() ? series_.check(points_) : series_.look(points_))
      job_.log.warning("{}", warning);
  if (!job_.line.report.empty())
    io::check_report_file(job_.line.report, job_.comm);
}

ExitCode MeshRun::preview() {
  const bool is_dry_run = job_.line.action == Action::dry_run;
  check_fixed_points(*input_.shape, job_.log);
  if (depth_)
    try_depth(*depth_, sample_places(*input_.shape), job_.log);
  job_.log.summary("{}", estimate(job_.options, points_, boundary(), placement_, is_dry_run));
  check_share(points_, placement_.ranks);
  Log quiet(LogLevel::error, job_.comm.is_root()); // its warnings were printed before
  const meshing::Mesher mesher(job_.comm, input_.domain(), *size_.field, mesh_, quiet, job_.timers);
  const meshing::Outlook outlook = mesher.outlook(is_dry_run ? meshing::Advice::yes : meshing::Advice::no);
  if (is_dry_run)
    print_outlook(outlook, boundary().part_names, job_.log);
  else
    print_warnings(outlook.features, boundary().part_names, job_.log);
  return ExitCode::done;
}

/// The mesher with what is written while it runs.
meshing::MeshResult MeshRun::make_mesh(const Provenance& provenance) {
  meshing::Mesher mesher(job_.comm, input_.domain(), *size_.field, mesh_, job_.log, job_.timers);
  mesher.on_snapshot([&](const meshing::Snapshot& snapshot) { // timed by the mesher
    series_.write_step(
        {snapshot.retriangulation, snapshot.mesh, snapshot.quality, describe_step(provenance, snapshot)});
  });
  if (old_)
    mesher.start_from(old_->points());
  if (saved_) {
    mesher.go_on_from(*saved_);
    int triangulations = 0;
    StateFields::restoring(saved_->state.numbers).field("triangulations", triangulations);
    if (job_.options.write)
      for (const std::string& warning : series_.go_on_after(triangulations))
        job_.log.warning("{}", warning);
  }
  mesher.keep_checkpoints(keeper_);
  return mesher.run();
}

/// Gives the points their depths if the config asks for them.
void MeshRun::add_depths(meshing::MeshResult& result) {
  if (!depth_)
    return;
  const auto timing = job_.timers.scope("depth");
  depths_ = add_depth(*depth_, result, job_.comm, job_.log);
  if (job_.options.courant.time_step > 0 && result.checks.back().passed)
    courant_ = record::courant_numbers(job_.options.courant, result.mesh, job_.comm);
}

/// Measures the mesh by the rules of the models that the config names.
void MeshRun::judge(meshing::MeshResult& result) {
  if (job_.options.accept.empty())
    return;
  const auto timing = job_.timers.scope("accept");
  verdicts_ = record::judge_mesh(
      {job_.options.accept, input_.domain().frame().periods(), formats::open_parts(series_options(job_, input_).names)},
      result, job_.comm);
}

/// Summarises the size of the mesh, and how often each of several sizes is the smallest one. Collective.
SizeSummary MeshRun::summarize(const meshing::MeshResult& result) {
  const auto timing = job_.timers.scope("size field");
  shares_ = record::shares_of_sizes(size_.combined(), result.mesh, job_.comm);
  const std::string shares = text_of(shares_);
  return summarize_size(shares.empty() ? size_.description : fmt::format("{}: {}", size_.description, shares),
                        result.mesh, job_.comm);
}

io::Metadata MeshRun::describe(const Provenance& provenance, const meshing::MeshResult& result,
                               const SizeSummary& sizes, const Measurements& measured) const {
  io::Metadata metadata = describe_run(provenance, result, sizes, measured);
  if (!shares_.names.empty())
    metadata.groups.push_back(record::group_of(shares_));
  if (depths_)
    metadata.groups.push_back(group_of(*depths_));
  if (courant_)
    metadata.groups.push_back(record::group_of(*courant_));
  if (!verdicts_.empty())
    metadata.groups.push_back(record::accept_group(verdicts_));
  return metadata;
}

io::WrittenFiles MeshRun::publish(const Provenance& provenance, const meshing::MeshResult& result,
                                  const SizeSummary& sizes) {
  const io::Metadata metadata = describe(provenance, result, sizes, gather_measurements(job_.timers, job_.comm));
  const auto timing = job_.timers.scope("output");
  return series_.write_final({final_retriangulation(result), result.mesh, result.quality, metadata});
}

/// Prints the summary or the report of a finished run, and what its formats and options ask for.
void MeshRun::print_results(const RunFacts& facts) const {
  if (job_.options.log_level <= LogLevel::info)
    job_.log.info("{}", run_report(facts.result, facts.size, facts.measured, facts.files, input_.normalized));
  else
    job_.log.summary("{}", run_summary(facts));
  for (const formats::Format format :
       {formats::Format::adcirc, formats::Format::schism, formats::Format::telemac, formats::Format::fvcom})
    if (job_.options.write && job_.options.output.wants(format))
      job_.log.summary("{}: {}", formats::info_of(format).word,
                       formats::open_boundary_text(series_options(job_, input_).names, facts.part_edges));
  if (courant_)
    job_.log.summary("{}", record::text_of(*courant_));
  record::print_verdicts(verdicts_, job_.options.mesh.split_ears, job_.log);
  print_cells(series_.cells(), job_.log);
  for (const std::string& warning : series_.warnings())
    job_.log.warning("{}", warning);
  if (!is_complete(facts.result))
    job_.log.warning("{}", incompleteness(facts.result, job_.options.write));
  else if (!input_.domain().curves().empty())
    warn_of_bad_triangles(facts.result.quality, job_.log);
}

ExitCode MeshRun::run() {
  check_share(points_, placement_.ranks);
  const Provenance provenance{job_.line,
                              job_.options,
                              job_.config_text,
                              placement_,
                              boundary(),
                              input_.normalized,
                              input_.map,
                              old_,
                              job_.comm.is_root(),
                              {boundary().part_names,
                               input_.domain().part_markers(),
                               record::named(input_.domain().regions(), job_.options.geometry),
                               {boundary().periods.x, boundary().periods.y},
                               input_.map.crs,
                               input_.domain().curves().names,
                               job_.places.ring_lines(boundary()),
                               input_.domain().curves().kinds,
                               job_.options.output.names.open_boundary}};
  meshing::MeshResult result = make_mesh(provenance);
  add_depths(result);
  judge(result);
  const SizeSummary sizes = summarize(result);
  keeper_.go_to_the_end();
  const io::WrittenFiles files = job_.options.write ? publish(provenance, result, sizes) : io::WrittenFiles{};
  const Measurements measured = gather_measurements(job_.timers, job_.comm);
  const ExitCode code = mesh::all_passed(series_.cells().checks) ? exit_code(result) : ExitCode::incomplete;
  const std::vector<std::int64_t> edges =
      edges_of_parts(result.mesh, boundary().part_names.size(), input_.domain().curves().names.size(), job_.comm);
  print_results({provenance, result, sizes, measured, files, edges});
  if (!job_.line.report.empty()) // last, since it holds all warnings
    io::write_report_file(job_.line.report, describe(provenance, result, sizes, measured),
                          {static_cast<int>(code), files.paths, job_.log.warnings()}, job_.comm);
  keeper_.remove_all();
  return code;
}

} // namespace

ExitCode run_program(int argc, const char* const* argv, const comm::Communicator& comm, const Process& process) {
  TimerTable timers(&comm.counters());
  const CommandLine line = parse_command_line(argc, argv);
  if (line.action == Action::help || line.action == Action::help_config || line.action == Action::version) {
    print(comm, line.action == Action::help      ? line.help
                : line.action == Action::version ? version_text()
                                                 : help_config());
    return ExitCode::done;
  }
  if (line.action == Action::info) {
    print(comm, info(line.files[0], line.prints_all, comm));
    return ExitCode::done;
  }
  if (line.action == Action::convert) {
    Log log(LogLevel::info, comm.is_root());
    return convert(line, process.files, comm, log);
  }
  if (line.action == Action::refine) {
    Log log(LogLevel::info, comm.is_root());
    return refine(line, process.files, comm, log);
  }
  const std::string config_text = read_shared(line.config, comm);
  RunOptions options = parse_config(config_text, line.config, line.overrides);
  if (line.action == Action::print_config) {
    print(comm, options.resolved);
    return ExitCode::done;
  }
  Log log(options.log_level, comm.is_root());
  log.set_progress_interval(options.log_interval);
  if (line.action == Action::mesh)
    timers.on_section([&log](const std::string& name) { log.phase(name == "measure" ? "sweeps" : name); });
  options.mesh.star_tests = of_root(options.mesh.star_tests, comm);
  const Job job{comm, line, config_text, options, process.files, process.signals, process.places, log, timers};
  MeshRun run(job);
  return job.is_run() ? run.run() : run.preview();
}

} // namespace trime::app
