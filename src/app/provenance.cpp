// SPDX-License-Identifier: BSD-3-Clause
#include "app/provenance.hpp"

#include "app/config.hpp"
#include "app/run_limit.hpp"
#include "record/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace trime::app {
namespace {

using record::Attributes;
using record::column;

/// Machine and options: known before the run.
Attributes run_attributes(const Provenance& p) {
  const char* job = std::getenv("SLURM_JOB_ID");
  return {{"job_id", std::string(job ? job : "")},
          {"seed", p.options.mesh.seed},
          {"method", method_name(p.options.mesh.method)},
          {"mpi_ranks", std::int64_t{p.placement.ranks}},
          {"omp_threads", std::int64_t{p.placement.threads}},
          {"setup_threads", std::int64_t{p.placement.setup_threads}},
          {"nodes", std::int64_t{p.placement.nodes}}};
}

/// Describes the time and memory of the run, and its sizes.
Attributes measured_attributes(const meshing::MeshResult& result, const SizeSummary& size,
                               const Measurements& measured) {
  const auto points = static_cast<double>(std::max<GlobalId>(result.mesh.point_slab.total, 1));
  return {{"sizing", io::shortened(size.description, 1000)},
          {"smallest_size", size.smallest},
          {"largest_size", size.largest},
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

Attributes joined(std::initializer_list<Attributes> lists) {
  Attributes all;
  for (const Attributes& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// The mesh from which the run started, with a hash of its points.
Attributes start_attributes(const std::optional<OldMesh>& old) {
  if (!old)
    return {};
  return {{"start_file", old->file}, {"start_points", old->count}, {"start_hash", old->hash}};
}

/// Describes what is known before the run.
Attributes given_attributes(const Provenance& p) {
  return joined({record::format_attributes(), program_attributes(p.line), run_attributes(p),
                 record::open_attributes(p.origin), start_attributes(p.old), record::place_attributes(p.origin),
                 normalization_attributes(p.normalized)});
}

std::vector<io::Text> texts(const Provenance& p) {
  std::vector<io::Text> all{
      {"command_line", p.line.as_given}, {"config_text", p.config_text}, {"config_resolved", p.options.resolved}};
  if (!p.map.well_known_text.empty())
    all.push_back({"crs_wkt", p.map.well_known_text});
  return all;
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

/// The quality, with the shortest edge on the Earth if the mesh is in a plane of a map.
io::MetadataGroup quality_group(const mesh::QualitySummary& quality, const Provenance& p) {
  io::MetadataGroup group = record::quality_group(quality);
  if (const auto place = p.is_root ? on_earth(p.map, quality.shortest_place) : std::nullopt) {
    group.attributes.push_back({"shortest_edge_longitude", place->x});
    group.attributes.push_back({"shortest_edge_latitude", place->y});
  }
  return group;
}

} // namespace

std::vector<io::Attribute> program_attributes(const CommandLine& line) {
  const BuildInfo build = build_info();
  return {{"program_version", build.version},
          {"git_commit", build.git_commit},
          {"build_type", build.build_type},
          {"compiler", build.compiler},
          {"mpi_library", build.mpi_library},
          {"hdf5_library", build.hdf5_library},
          {"created_utc", utc_time()},
          {"command_line", io::shortened(line.as_given, 1000)}, // whole among the texts
          {"host", host_name()}};
}

io::Metadata describe_run(const Provenance& p, const meshing::MeshResult& result, const SizeSummary& size,
                          const Measurements& measured) {
  return record::with_regions(
      {joined({given_attributes(p), record::mesh_attributes(result.mesh, final_retriangulation(result)),
               record::result_attributes(result), measured_attributes(result, size, measured)}),
       texts(p),
       {record::history_group(result.history), quality_group(result.quality, p), record::checks_group(result.checks),
        record::bad_triangles_group(result.quality), timers_group(measured.phases), counters_group(measured),
        record::tags_group(p.origin, result.loops), record::sharp_corners_group(result.features.sharp_corners),
        record::rings_group(p.origin, result.features.loops), normalization_group(p.normalized)}},
      p.origin, result);
}

io::Metadata describe_step(const Provenance& p, const meshing::Snapshot& snapshot) {
  const Attributes step{{"stop_reason", std::string("none: a step of the run")},
                        {"seconds_total", snapshot.seconds},
                        {"complete", std::int64_t{0}}};
  return record::with_inner_edges(
      {joined({given_attributes(p), record::mesh_attributes(snapshot.mesh, snapshot.retriangulation), step}),
       texts(p),
       {quality_group(snapshot.quality, p), record::tags_group(p.origin, snapshot.loops),
        normalization_group(p.normalized)}},
      p.origin);
}

} // namespace trime::app
