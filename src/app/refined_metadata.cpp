// SPDX-License-Identifier: BSD-3-Clause
#include "app/refined_metadata.hpp"

#include "acceptance/solver_rules.hpp"
#include "app/provenance.hpp"
#include "core/thread_loop.hpp"
#include "record/acceptance_record.hpp"
#include "record/groups.hpp"
#include "trime/record/describe.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

namespace trime::app {
namespace {

using io::Attribute;
using io::Metadata;
using io::MetadataGroup;
using record::Attributes;

/// Returns the value, or `otherwise` if there is no such value.
template <class T>
T value_or(const Metadata& metadata, const std::string& name, T otherwise) {
  for (const Attribute& attribute : metadata.attributes)
    if (const T* value = std::get_if<T>(&attribute.value); value && attribute.name == name)
      return *value;
  return otherwise;
}

/// Replaces values, or adds them at the end.
void set(Attributes& attributes, const Attributes& values) {
  for (const Attribute& value : values) {
    const auto found = std::ranges::find(attributes, value.name, &Attribute::name);
    if (found != attributes.end())
      *found = value;
    else
      attributes.push_back(value);
  }
}

/// Replaces lengths and ratios by multiples of themselves, where the file has them.
void scale(Attributes& attributes, const std::string& name, double factor) {
  for (Attribute& attribute : attributes)
    if (double* value = std::get_if<double>(&attribute.value); value && attribute.name == name)
      *value *= factor;
}

/// Where the mesh was refined, and how long that took.
Attributes place_of_refinement(double seconds, const comm::Communicator& comm) {
  return {{"mpi_ranks", std::int64_t{comm.size()}},
          {"omp_threads", std::int64_t{thread_count()}},
          {"setup_threads", std::int64_t{thread_count()}},
          {"seconds_total", seconds}};
}

/// Where the mesh comes from, over all refinements.
Attributes refinement_attributes(const Metadata& metadata, const refinement::Refined& refined,
                                 const CommandLine& line) {
  const auto sum = [&](const char* name, std::int64_t more) {
    return Attribute{name, value_or(metadata, name, std::int64_t{0}) + more};
  };
  return {sum("refinements", 1),
          {"refined_from", io::shortened(line.files[0], 1000)},
          {"refined_from_hash", value_or(metadata, "mesh_hash_hex", std::string())},
          sum("middles_on_curve", refined.middles.on_curve),
          sum("middles_near_curve", refined.middles.near_curve),
          sum("middles_straight", refined.middles.straight),
          sum("middles_refused", refined.middles.refused)};
}

/// The loops of the mesh have the same rows; only edges and their lengths are new.
MetadataGroup tags_group(const Metadata& metadata, const std::vector<polygon::LoopSummary>& loops) {
  const MetadataGroup* group = io::find_group(metadata, "tags");
  if (!group)
    throw FileError("the file has no group /trime_mpi/tags: it is damaged");
  const auto& ids = io::column_of<std::int32_t>(metadata, "tags", "edge_id");
  std::map<std::int32_t, const polygon::LoopSummary*> by_tag;
  for (const polygon::LoopSummary& loop : loops)
    by_tag[loop.tag] = &loop;
  std::vector<std::int64_t> edges;
  std::vector<double> lengths;
  for (const std::int32_t id : ids) {
    const auto found = by_tag.find(id);
    edges.push_back(found == by_tag.end() ? 0 : found->second->edges);
    lengths.push_back(found == by_tag.end() ? 0 : found->second->length);
  }
  MetadataGroup tags = *group;
  for (io::Column& column : tags.columns)
    if (column.name == "edge_count")
      column.values = edges;
    else if (column.name == "edge_length_sum")
      column.values = lengths;
  return tags;
}

/// The regions have the same rows; their triangles and areas are new.
MetadataGroup regions_group(MetadataGroup group, const std::vector<refinement::RegionSum>& sums) {
  for (io::Column& column : group.columns) {
    if (auto* triangles = std::get_if<std::vector<std::int64_t>>(&column.values);
        triangles && column.name == "triangles")
      for (std::size_t k = 0; k < triangles->size(); ++k)
        (*triangles)[k] = k < sums.size() ? sums[k].triangles : 0;
    if (auto* areas = std::get_if<std::vector<double>>(&column.values); areas && column.name == "area")
      for (std::size_t k = 0; k < areas->size(); ++k)
        (*areas)[k] = k < sums.size() ? sums[k].area : 0;
  }
  return group;
}

/// Does the check hold a rule of a model, see judge_mesh?
bool is_rule(const mesh::Check& check) {
  return std::ranges::any_of(acceptance::solver_rules(), [&](const acceptance::SolverRule& rule) {
    return rule.refuses && check.name == record::check_name(rule);
  });
}

/// Adds the failed checks of the mesh that was refined, unless the refined mesh has a check of the same name: a
/// boundary that lies too far from the shape still does. Rules of models are left out, since other triangles may keep
/// them.
mesh::Checks with_failed(mesh::Checks checks, const Metadata& metadata) {
  for (const mesh::Check& check : record::checks_of(metadata))
    if (!check.passed && !is_rule(check) && std::ranges::find(checks, check.name, &mesh::Check::name) == checks.end())
      checks.push_back(check);
  return checks;
}

/// The command that made the first mesh stays, next to the new one.
std::vector<io::Text> texts(const Metadata& metadata, const CommandLine& line) {
  std::vector<io::Text> all = metadata.texts;
  const bool is_first = std::ranges::find(all, "meshing_command_line", &io::Text::name) == all.end();
  const auto command = std::ranges::find(all, "command_line", &io::Text::name);
  if (command == all.end()) {
    all.push_back({"command_line", line.as_given});
    return all;
  }
  const std::string before = std::exchange(command->text, line.as_given);
  if (is_first)
    all.push_back({"meshing_command_line", before});
  return all;
}

} // namespace

std::vector<std::string> groups_to_refine() {
  return {"checks", "tags",       "history", "rings",         "sharp_corners",
          "curves", "interfaces", "regions", "normalization", "accept"};
}

bool says_complete(const Metadata& metadata) {
  return value_or(metadata, "complete", std::int64_t{1}) != 0;
}

Metadata refined_metadata(const Metadata& metadata, const refinement::Refined& refined, const CommandLine& line,
                          double seconds, const comm::Communicator& comm) {
  const record::SizeRange sizes = record::size_range(refined.mesh, comm);
  const mesh::Checks checks = with_failed(refined.checks, metadata);
  const bool stopped_early = value_or(metadata, "stop_reason", std::string()) == "sweep cap";
  Metadata made{metadata.attributes, texts(metadata, line), {}};
  // These values belong to the first run, which took another time and other memory.
  std::erase_if(made.attributes, [](const Attribute& attribute) {
    return attribute.name == "most_points_of_a_rank" || attribute.name == "peak_memory_bytes" ||
           attribute.name == "bytes_per_point" || attribute.name == "nodes" || attribute.name == "job_id" ||
           attribute.name == "hole_share";
  });
  scale(made.attributes, "edge_length", 0.5);
  scale(made.attributes, "coarseness", 2);
  set(made.attributes, program_attributes(line));
  set(made.attributes, place_of_refinement(seconds, comm));
  set(made.attributes,
      record::mesh_attributes(refined.mesh, static_cast<int>(value_or(metadata, "retriangulation", std::int64_t{1}))));
  set(made.attributes, {{"smallest_size", sizes.smallest},
                        {"largest_size", sizes.largest},
                        {"complete", std::int64_t{!stopped_early && mesh::all_passed(checks)}}});
  set(made.attributes, refinement_attributes(metadata, refined, line));
  for (const char* kept : {"history", "rings", "sharp_corners", "curves", "interfaces", "normalization"})
    if (const MetadataGroup* group = io::find_group(metadata, kept))
      made.groups.push_back(*group);
  if (const MetadataGroup* group = io::find_group(metadata, "regions"))
    made.groups.push_back(regions_group(*group, refined.regions));
  made.groups.push_back(record::quality_group(refined.quality));
  made.groups.push_back(record::checks_group(checks));
  made.groups.push_back(record::bad_triangles_group(refined.quality));
  made.groups.push_back(tags_group(metadata, refined.loops));
  return made;
}

} // namespace trime::app
