// SPDX-License-Identifier: BSD-3-Clause
#include "app/provenance.hpp"

#include "app/config.hpp"
#include "app/run_limit.hpp"
#include "trime/io/describe.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <numeric>

namespace trime::app {
namespace {

/// One value of each element as a column.
template <class T, class Element, class Value>
io::Column column(const std::string& name, const std::vector<Element>& elements, const Value& value) {
  std::vector<T> values;
  for (const Element& element : elements)
    values.push_back(static_cast<T>(std::invoke(value, element)));
  return {name, std::move(values)};
}

using Attributes = std::vector<io::Attribute>;

/// Program, machine and options: known before the run.
Attributes run_attributes(const Provenance& p) {
  const BuildInfo build = build_info();
  const char* job = std::getenv("SLURM_JOB_ID");
  return {{"format", std::string("trime_mpi-mesh")},
          {"format_version", std::int64_t{1}},
          {"program_version", build.version},
          {"git_commit", build.git_commit},
          {"build_type", build.build_type},
          {"compiler", build.compiler},
          {"mpi_library", build.mpi_library},
          {"hdf5_library", build.hdf5_library},
          {"created_utc", utc_time()},
          {"command_line", io::shortened(p.line.as_given, 1000)}, // whole among the texts
          {"host", host_name()},
          {"job_id", std::string(job ? job : "")},
          {"seed", p.options.mesh.seed},
          {"method", method_name(p.options.mesh.method)},
          {"crs", p.map.crs},                 // reference system of the coordinates; empty: none is known
          {"period_x", p.boundary.periods.x}, // 0: not periodic; else images of a triangle's corners count
          {"period_y", p.boundary.periods.y},
          {"mpi_ranks", std::int64_t{p.placement.ranks}},
          {"omp_threads", std::int64_t{p.placement.threads}},
          {"setup_threads", std::int64_t{p.placement.setup_threads}},
          {"nodes", std::int64_t{p.placement.nodes}}};
}

Attributes mesh_attributes(const mesh::DistributedMesh& mesh, int retriangulation) {
  return {{"points", mesh.point_slab.total},
          {"triangles", mesh.triangle_slab.total},
          {"retriangulation", std::int64_t{retriangulation}},
          {"mesh_hash", mesh.hash},
          {"mesh_hash_hex", fmt::format("{:016x}", mesh.hash)}};
}

Attributes result_attributes(const meshing::MeshResult& result, const SizeSummary& size, const Measurements& measured) {
  const auto points = static_cast<double>(std::max<GlobalId>(result.mesh.point_slab.total, 1));
  return {{"iterations", std::int64_t{result.history.empty() ? 0 : result.history.back().sweep}},
          {"stop_reason", sweep::to_string(result.stop_reason)},
          {"requested_points", result.requested_points},
          {"count_reason", result.count_reason},
          {"start_reason", result.start_reason},
          {"edge_length", result.edge_length},
          {"sizing", io::shortened(size.description, 1000)},
          {"smallest_size", size.smallest},
          {"largest_size", size.largest},
          {"corners", result.corners},
          {"components", std::int64_t{result.components}},
          {"holes", std::int64_t{result.holes}},
          {"shape_area", result.shape_area},
          {"cleanup_patches", result.cleanup.patches},
          {"cleanup_better", result.cleanup.better},
          {"cleanup_moved", result.cleanup.moved},
          {"cleanup_inserted", result.cleanup.inserted},
          {"cleanup_deleted", result.cleanup.deleted},
          {"cleanup_on_boundary", result.cleanup.on_boundary},
          {"cleanup_left", result.cleanup.left},
          {"dropped_islands", result.features.dropped_islands},
          {"dropped_lakes", result.features.dropped_lakes},
          {"dropped_area", result.features.dropped_area},
          {"corners_left_out", result.features.corners_left_out},
          {"largest_deviation", result.features.largest_deviation},
          {"segments_halved", result.features.segments_halved},
          {"size_limits", result.features.size_limits},
          {"lowest_size_share", result.features.lowest_size_share},
          {"narrow_cut", result.features.cut},
          {"narrow_closed", result.features.closed},
          {"narrow_widened", result.features.widened},
          {"holes_filled", result.features.filled},
          {"vertices_smoothed", result.features.smoothed},
          {"coarseness", result.features.coarseness},
          {"lost_share", result.features.lost_share},
          {"added_share", result.features.added_share},
          {"most_points_of_a_rank", measured.counters[Counter::sites_extracted].max},
          {"seconds_total", measured.total}, // up to the writing of this file
          {"peak_memory_bytes", measured.peak_memory},
          {"bytes_per_point", static_cast<double>(measured.memory_sum) / points},
          {"complete", std::int64_t{is_complete(result)}}};
}

/// user = (container - shift) / scale, if that is the same for all normalised contours.
Attributes normalization_attributes(const std::vector<NormalizedPart>& parts) {
  const auto differs = [&](const NormalizedPart& part) {
    return part.scale != parts[0].scale || part.shift != parts[0].shift;
  };
  if (parts.empty() || std::any_of(parts.begin(), parts.end(), differs))
    return {};
  return {{"normalize_scale", parts[0].scale},
          {"normalize_shift_x", parts[0].shift.x},
          {"normalize_shift_y", parts[0].shift.y}};
}

/// Returns the group with a row for each normalised contour.
io::MetadataGroup normalization_group(const std::vector<NormalizedPart>& parts) {
  using Part = NormalizedPart;
  return {"normalization",
          {},
          {column<std::string>("part_name", parts, &Part::name), column<std::string>("file", parts, &Part::file),
           column<double>("scale", parts, &Part::scale),
           column<double>("shift_x", parts, [](const Part& part) { return part.shift.x; }),
           column<double>("shift_y", parts, [](const Part& part) { return part.shift.y; })}};
}

Attributes joined(Attributes a, const Attributes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<io::Text> texts(const Provenance& p) {
  std::vector<io::Text> all{
      {"command_line", p.line.as_given}, {"config_text", p.config_text}, {"config_resolved", p.options.resolved}};
  if (!p.map.well_known_text.empty())
    all.push_back({"crs_wkt", p.map.well_known_text});
  return all;
}

io::MetadataGroup history_group(const std::vector<sweep::SweepRecord>& history) {
  using Record = sweep::SweepRecord;
  return {
      "history",
      {},
      {column<std::int64_t>("sweep", history, &Record::sweep), column<std::int64_t>("points", history, &Record::points),
       column<std::int64_t>("stage", history, &Record::stage),
       column<std::int64_t>("by_bars", history, &Record::by_bars),
       column<double>("median_alpha", history, &Record::median_alpha),
       column<double>("mean_alpha", history, &Record::mean_alpha),
       column<double>("max_alpha", history, &Record::max_alpha), column<double>("max_move", history, &Record::max_move),
       column<double>("moving_share", history, &Record::moving_share),
       column<std::int64_t>("rebuilt_stars", history, &Record::rebuilt_stars),
       column<std::int64_t>("pushed", history, &Record::pushed),
       column<std::int64_t>("deleted", history, &Record::deleted),
       column<double>("seconds", history, &Record::seconds)}};
}

io::MetadataGroup timers_group(const std::vector<Phase>& phases) {
  const auto sum = [](Counter counter) { return [=](const Phase& phase) { return phase.counters[counter].sum; }; };
  return {"timers",
          {},
          {column<std::string>("name", phases, &Phase::name), column<std::int64_t>("calls", phases, &Phase::calls),
           column<double>("min", phases, &Phase::min), column<double>("avg", phases, &Phase::mean),
           column<double>("max", phases, &Phase::max), column<std::int64_t>("messages", phases, sum(Counter::messages)),
           column<std::int64_t>("bytes", phases, sum(Counter::bytes)),
           column<std::int64_t>("collectives", phases,
                                [](const Phase& phase) { return phase.counters[Counter::collectives].max; })}};
}

/// A row for each counter of each phase that has counted anything, then those of the whole run.
io::MetadataGroup counters_group(const Measurements& measured) {
  struct Row {
    std::string phase;
    Counter counter;
    Spread values;
  };
  std::vector<Row> rows;
  const auto add = [&](const std::string& phase, const CounterSpreads& counters) {
    for (std::size_t k = 0; k < counter_count; ++k)
      if (const auto counter = static_cast<Counter>(k); counters[counter].sum > 0)
        rows.push_back({phase, counter, counters[counter]});
  };
  for (const Phase& phase : measured.phases)
    add(phase.name, phase.counters);
  add("run", measured.counters);
  return {"counters",
          {{"limit", run_limit(measured)}},
          {column<std::string>("phase", rows, &Row::phase),
           column<std::string>("name", rows, [](const Row& row) { return name_of(row.counter).name; }),
           column<std::string>("unit", rows, [](const Row& row) { return name_of(row.counter).unit; }),
           column<std::int64_t>("sum", rows, [](const Row& row) { return row.values.sum; }),
           column<std::int64_t>("min", rows, [](const Row& row) { return row.values.min; }),
           column<double>("mean", rows,
                          [&](const Row& row) { return static_cast<double>(row.values.sum) / measured.ranks; }),
           column<std::int64_t>("max", rows, [](const Row& row) { return row.values.max; })}};
}

/// Names of the parts along a loop, in order, each once: "square" or "square+disc".
std::string loop_name(const geometry::Boundary& boundary, const polygon::LoopSummary& loop) {
  std::string name;
  for (const std::int32_t part : loop.parts)
    name += (name.empty() ? "" : "+") + boundary.part_names.at(static_cast<std::size_t>(part));
  return name;
}

/// Corners where small angles cannot be avoided.
io::MetadataGroup sharp_corners_group(const std::vector<boundary::SharpCorner>& corners) {
  using Corner = boundary::SharpCorner;
  return {"sharp_corners",
          {{"below_degrees", boundary::FeatureReport::sharp_angle}},
          {column<double>("x", corners, [](const Corner& c) { return c.place.x; }),
           column<double>("y", corners, [](const Corner& c) { return c.place.y; }),
           column<double>("degrees", corners, &Corner::degrees)}};
}

/// Returns the table of the loops of the shape.
io::MetadataGroup rings_group(const Provenance& p, const std::vector<boundary::LoopFate>& loops) {
  using Fate = boundary::LoopFate;
  std::vector<std::int32_t> numbers(loops.size()), lines = p.ring_lines;
  std::iota(numbers.begin(), numbers.end(), 1);
  lines.resize(loops.size());
  const auto all_tags = [](const Fate& fate) {
    std::string text;
    for (const std::int32_t tag : fate.tags)
      text += fmt::format("{}{}", text.empty() ? "" : " ", tag);
    return text;
  };
  return {"rings",
          {},
          {{"loop", std::move(numbers)},
           {"line", std::move(lines)},
           column<std::string>(
               "part_name", loops,
               [&](const Fate& fate) { return p.boundary.part_names.at(static_cast<std::size_t>(fate.part)); }),
           column<std::string>("state", loops, [](const Fate& fate) { return std::string(to_string(fate.state)); }),
           column<std::int32_t>("tag", loops, [](const Fate& fate) { return fate.tags.empty() ? 0 : fate.tags[0]; }),
           column<std::string>("tags", loops, all_tags),
           column<double>("x", loops, [](const Fate& fate) { return fate.place.x; }),
           column<double>("y", loops, [](const Fate& fate) { return fate.place.y; }),
           column<double>("area", loops, &Fate::area),
           column<double>("length", loops, &Fate::length),
           column<double>("remaining_length", loops, &Fate::remaining_length),
           column<double>("largest_deviation", loops, &Fate::largest_deviation)}};
}

std::string kind_name(const polygon::LoopSummary& loop) {
  using Kind = polygon::LoopSummary::Kind;
  return loop.kind == Kind::outer ? "outer" : loop.kind == Kind::hole ? "hole" : "band";
}

/// Returns the tables that explain the numbers in /Mesh/facets: `values` are edge_id, `parts` are part_id.
io::MetadataGroup tags_group(const Provenance& p, const std::vector<polygon::LoopSummary>& loops) {
  const geometry::Boundary& boundary = p.boundary;
  using polygon::LoopSummary;
  std::vector<std::int32_t> part_ids(boundary.part_names.size());
  std::iota(part_ids.begin(), part_ids.end(), 0);
  return {"tags",
          {},
          {column<std::int32_t>("edge_id", loops, &LoopSummary::tag),
           column<std::string>("edge_name", loops, [&](const LoopSummary& loop) { return loop_name(boundary, loop); }),
           column<std::string>("edge_kind", loops, kind_name),
           column<std::int64_t>("edge_count", loops, &LoopSummary::edges),
           column<double>("edge_length_sum", loops, &LoopSummary::length),
           {"part_id", part_ids},
           {"part_name", boundary.part_names},
           {"part_marker", p.part_markers},
           {"region_id", std::vector<std::int32_t>{1}},
           {"region_name", std::vector<std::string>{p.options.geometry}}}};
}

} // namespace

io::Metadata describe_run(const Provenance& p, const meshing::MeshResult& result, const SizeSummary& size,
                          const Measurements& measured) {
  return {joined(joined(joined(run_attributes(p), normalization_attributes(p.normalized)),
                        mesh_attributes(result.mesh, final_retriangulation(result))),
                 result_attributes(result, size, measured)),
          texts(p),
          {history_group(result.history), io::quality_group(result.quality), io::checks_group(result.checks),
           io::bad_triangles_group(result.quality), timers_group(measured.phases), counters_group(measured),
           tags_group(p, result.loops), sharp_corners_group(result.features.sharp_corners),
           rings_group(p, result.features.loops), normalization_group(p.normalized)}};
}

io::Metadata describe_step(const Provenance& p, const meshing::Snapshot& snapshot) {
  const Attributes step{{"stop_reason", std::string("none: a step of the run")},
                        {"seconds_total", snapshot.seconds},
                        {"complete", std::int64_t{0}}};
  return {joined(joined(joined(run_attributes(p), normalization_attributes(p.normalized)),
                        mesh_attributes(snapshot.mesh, snapshot.retriangulation)),
                 step),
          texts(p),
          {io::quality_group(snapshot.quality), tags_group(p, snapshot.loops), normalization_group(p.normalized)}};
}

} // namespace trime::app
