// SPDX-License-Identifier: BSD-3-Clause
#include "record/groups.hpp"

#include "core/thread_loop.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/shape/region_shape.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>

namespace trime::record {
namespace {

/// Names of the parts along a loop, in order, each once: "square" or "square+disc".
std::string loop_name(const Origin& origin, const polygon::LoopSummary& loop) {
  std::string name;
  for (const std::int32_t number : loop.parts) { // curves that are split follow the parts
    const auto part = static_cast<std::size_t>(number);
    const std::size_t parts = origin.part_names.size();
    name += (name.empty() ? "" : "+") + (part < parts ? origin.part_names[part] : origin.curve_names.at(part - parts));
  }
  return name;
}

std::string kind_name(const polygon::LoopSummary& loop) {
  using Kind = polygon::LoopSummary::Kind;
  return loop.kind == Kind::outer ? "outer" : loop.kind == Kind::hole ? "hole" : "band";
}

std::string utc_time() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

Attributes joined(std::initializer_list<Attributes> lists) {
  Attributes all;
  for (const Attributes& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

void add_summary(Attributes& to, const std::string& name, const mesh::RatioSummary& s) {
  to.push_back({name + "_median", s.median});
  to.push_back({name + "_mean", s.mean});
  to.push_back({name + "_max", s.max});
  to.push_back({name + "_half_mean", s.half_mean});
  to.push_back({name + "_std", s.std});
}

/// Returns what became of the features of the boundary.
Attributes feature_attributes(const boundary::FeatureReport& features) {
  return {{"dropped_islands", features.dropped_islands},
          {"dropped_lakes", features.dropped_lakes},
          {"dropped_area", features.dropped_area},
          {"corners_left_out", features.corners_left_out},
          {"largest_deviation", features.largest_deviation},
          {"segments_halved", features.segments_halved},
          {"size_limits", features.size_limits},
          {"lowest_size_share", features.lowest_size_share},
          {"narrow_cut", features.cut},
          {"narrow_closed", features.closed},
          {"narrow_widened", features.widened},
          {"other_components", features.other_components},
          {"narrow_held", features.held},
          {"narrow_severed", features.severed},
          {"widest_severed", features.widest_severed},
          {"severed_x", features.severed_place.x},
          {"severed_y", features.severed_place.y},
          {"holes_filled", features.filled},
          {"vertices_smoothed", features.smoothed},
          {"coarseness", features.coarseness},
          {"lost_share", features.lost_share},
          {"added_share", features.added_share},
          {"loops_changed", features.changed.number},
          {"hole_share", features.hole_share}};
}

} // namespace

Attributes format_attributes() {
  return {{"format", std::string("trime_mpi-mesh")}, {"format_version", std::int64_t{1}}};
}

Attributes place_attributes(const Origin& origin) {
  return {{"crs", origin.crs},           // reference system of the coordinates; empty: none is known
          {"period_x", origin.period.x}, // 0: not periodic; else images of a triangle's corners count
          {"period_y", origin.period.y}};
}

Attributes open_attributes(const Origin& origin) {
  if (!origin.open_boundary)
    return {};
  return {{"open_boundary", fmt::format("{}", fmt::join(*origin.open_boundary, ","))}};
}

std::optional<std::vector<std::string>> open_boundary_of(const io::Metadata& metadata) {
  const auto found = std::ranges::find(metadata.attributes, "open_boundary", &io::Attribute::name);
  const auto* text = found == metadata.attributes.end() ? nullptr : std::get_if<std::string>(&found->value);
  if (text == nullptr)
    return std::nullopt;
  std::vector<std::string> names;
  std::istringstream stream(*text);
  for (std::string name; std::getline(stream, name, ',');)
    names.push_back(name);
  return names;
}

Attributes mesh_attributes(const mesh::DistributedMesh& mesh, int retriangulation) {
  return {{"points", mesh.point_slab.total},
          {"triangles", mesh.triangle_slab.total},
          {"retriangulation", std::int64_t{retriangulation}},
          {"mesh_hash", mesh.hash},
          {"mesh_hash_hex", fmt::format("{:016x}", mesh.hash)}};
}

Attributes result_attributes(const meshing::MeshResult& result) {
  Attributes attributes = {{"iterations", std::int64_t{result.history.empty() ? 0 : result.history.back().sweep}},
                           {"stop_reason", sweep::to_string(result.stop_reason)},
                           {"requested_points", result.requested_points},
                           {"count_reason", result.count_reason},
                           {"start_reason", result.start_reason},
                           {"edge_length", result.edge_length},
                           {"corners", result.corners},
                           {"components", std::int64_t{result.components}},
                           {"holes", std::int64_t{result.holes}},
                           {"given_components", std::int64_t{result.features.given_components}},
                           {"given_holes", std::int64_t{result.features.given_holes}},
                           {"shape_area", result.shape_area},
                           {"given_area", result.features.given_area},
                           {"cleanup_patches", result.cleanup.patches},
                           {"cleanup_better", result.cleanup.better},
                           {"cleanup_moved", result.cleanup.moved},
                           {"cleanup_inserted", result.cleanup.inserted},
                           {"cleanup_deleted", result.cleanup.deleted},
                           {"cleanup_on_boundary", result.cleanup.on_boundary},
                           {"cleanup_left", result.cleanup.left}};
  const Attributes features = feature_attributes(result.features);
  attributes.insert(attributes.end(), features.begin(), features.end());
  return attributes;
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

io::MetadataGroup quality_group(const mesh::QualitySummary& quality) {
  io::MetadataGroup group{"quality", {}, {}};
  add_summary(group.attributes, "alpha", quality.alpha);
  add_summary(group.attributes, "beta", quality.beta);
  group.attributes.push_back({"min_angle_degrees", quality.min_angle_degrees});
  group.attributes.push_back({"shortest_edge", quality.shortest_edge});
  group.attributes.push_back({"shortest_edge_x", quality.shortest_place.x});
  group.attributes.push_back({"shortest_edge_y", quality.shortest_place.y});
  group.attributes.push_back({"growth_90", quality.growth.of_90_percent});
  group.attributes.push_back({"growth_99", quality.growth.of_99_percent});
  group.attributes.push_back({"growth_largest", quality.growth.largest});
  group.attributes.push_back({"growth_largest_x", quality.growth.place.x});
  group.attributes.push_back({"growth_largest_y", quality.growth.place.y});
  group.attributes.push_back({"longest_over_size", quality.longest_over_size});
  group.attributes.push_back({"longest_over_size_x", quality.longest_place.x});
  group.attributes.push_back({"longest_over_size_y", quality.longest_place.y});
  group.attributes.push_back({"size_mean", quality.size_mean});
  group.attributes.push_back({"size_std", quality.size_std});
  group.attributes.push_back({"bad_triangles", quality.bad_triangles});
  group.attributes.push_back({"obtuse_triangles", quality.obtuse_triangles});
  group.attributes.push_back({"obtuse_at_corners", quality.obtuse_at_corners});
  const auto& edges = mesh::RatioStatistics::histogram_edges;
  const auto& counts = quality.alpha_histogram;
  group.columns.push_back({"alpha_histogram_from", std::vector<double>(edges.begin(), edges.end())});
  group.columns.push_back({"alpha_histogram", std::vector<std::int64_t>(counts.begin(), counts.end())});
  return group;
}

io::MetadataGroup bad_triangles_group(const mesh::QualitySummary& quality) {
  using mesh::BadTriangle;
  const std::vector<BadTriangle>& worst = quality.worst_triangles;
  return {"worst_triangles",
          {},
          {column<double>("alpha", worst, &BadTriangle::alpha),
           column<double>("x", worst, [](const BadTriangle& one) { return one.place.x; }),
           column<double>("y", worst, [](const BadTriangle& one) { return one.place.y; }),
           column<double>("largest_degrees", worst, &BadTriangle::largest_degrees),
           column<std::int64_t>("obtuse", worst, &BadTriangle::obtuse),
           column<double>("corner_degrees", worst, &BadTriangle::corner_degrees),
           column<double>("corner_x", worst, [](const BadTriangle& one) { return one.corner.x; }),
           column<double>("corner_y", worst, [](const BadTriangle& one) { return one.corner.y; })}};
}

io::MetadataGroup checks_group(const mesh::Checks& checks) {
  using mesh::Check;
  return {"checks",
          {},
          {column<std::string>("name", checks, &Check::name), column<double>("expected", checks, &Check::expected),
           column<double>("found", checks, &Check::found), column<std::int32_t>("passed", checks, &Check::passed),
           column<std::string>("meaning", checks, &Check::meaning)}};
}

io::MetadataGroup sharp_corners_group(const std::vector<boundary::SharpCorner>& corners) {
  using Corner = boundary::SharpCorner;
  return {"sharp_corners",
          {{"below_degrees", boundary::FeatureReport::sharp_angle}},
          {column<double>("x", corners, [](const Corner& c) { return c.place.x; }),
           column<double>("y", corners, [](const Corner& c) { return c.place.y; }),
           column<double>("degrees", corners, &Corner::degrees)}};
}

io::MetadataGroup rings_group(const Origin& origin, const std::vector<boundary::LoopFate>& loops) {
  using Fate = boundary::LoopFate;
  std::vector<std::int32_t> numbers(loops.size()), lines = origin.ring_lines;
  std::iota(numbers.begin(), numbers.end(), 1);
  lines.resize(loops.size());
  const auto all_tags = [](const Fate& fate) {
    std::string text;
    for (const std::int32_t tag : fate.tags)
      text += fmt::format("{}{}", text.empty() ? "" : " ", tag);
    return text;
  };
  return {
      "rings",
      {},
      {{"loop", std::move(numbers)},
       {"line", std::move(lines)},
       column<std::string>("part_name", loops,
                           [&](const Fate& fate) { return origin.part_names.at(static_cast<std::size_t>(fate.part)); }),
       column<std::string>("state", loops, [](const Fate& fate) { return std::string(to_string(fate.state)); }),
       column<std::int32_t>("tag", loops, [](const Fate& fate) { return fate.tags.empty() ? 0 : fate.tags[0]; }),
       column<std::string>("tags", loops, all_tags),
       column<double>("x", loops, [](const Fate& fate) { return fate.place.x; }),
       column<double>("y", loops, [](const Fate& fate) { return fate.place.y; }),
       column<double>("area", loops, &Fate::area),
       column<double>("length", loops, &Fate::length),
       column<double>("remaining_length", loops, &Fate::remaining_length),
       column<double>("largest_deviation", loops, &Fate::largest_deviation),
       column<double>("mesh_area", loops, &Fate::mesh_area),
       column<double>("deviation", loops, &Fate::deviation),
       column<double>("reach", loops, &Fate::reach)}};
}

io::MetadataGroup tags_group(const Origin& origin, const std::vector<polygon::LoopSummary>& loops) {
  using polygon::LoopSummary;
  std::vector<std::int32_t> part_ids(origin.part_names.size());
  std::iota(part_ids.begin(), part_ids.end(), 0);
  std::vector<std::int32_t> region_ids(origin.regions.names.size());
  std::iota(region_ids.begin(), region_ids.end(), 1);
  return {"tags",
          {},
          {column<std::int32_t>("edge_id", loops, &LoopSummary::tag),
           column<std::string>("edge_name", loops, [&](const LoopSummary& loop) { return loop_name(origin, loop); }),
           column<std::string>("edge_kind", loops, kind_name),
           column<std::int64_t>("edge_count", loops, &LoopSummary::edges),
           column<double>("edge_length_sum", loops, &LoopSummary::length),
           {"part_id", part_ids},
           {"part_name", origin.part_names},
           {"part_marker", origin.part_markers},
           {"region_id", region_ids},
           {"region_name", origin.regions.names}}};
}

mesh::Checks checks_of(const io::Metadata& metadata) {
  mesh::Checks checks;
  if (io::find_group(metadata, "checks") == nullptr)
    return checks;
  const auto& names = io::column_of<std::string>(metadata, "checks", "name");
  const auto& expected = io::column_of<double>(metadata, "checks", "expected");
  const auto& found = io::column_of<double>(metadata, "checks", "found");
  const auto& passed = io::column_of<std::int32_t>(metadata, "checks", "passed");
  const auto& meanings = io::column_of<std::string>(metadata, "checks", "meaning");
  for (std::size_t k = 0; k < names.size(); ++k)
    checks.push_back({names.at(k), expected.at(k), found.at(k), passed.at(k) != 0, meanings.at(k)});
  return checks;
}

SizeRange size_range(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  constexpr std::size_t part = 1 << 14;
  struct Extremes {
    float smallest = std::numeric_limits<float>::infinity(), largest = 0;
  };
  std::vector<Extremes> of_part((mesh.size.size() + part - 1) / part);
  thread_loop(std::ssize(of_part), 1, [&](std::ptrdiff_t k, int) {
    const std::size_t first = static_cast<std::size_t>(k) * part;
    Extremes& extremes = of_part[static_cast<std::size_t>(k)];
    for (const float size : std::span(mesh.size).subspan(first, std::min(part, mesh.size.size() - first)))
      extremes = {std::min(extremes.smallest, size), std::max(extremes.largest, size)};
  });
  SizeRange range{std::numeric_limits<double>::infinity(), 0};
  for (const Extremes& extremes : of_part) {
    range.smallest = std::min(range.smallest, static_cast<double>(extremes.smallest));
    range.largest = std::max(range.largest, static_cast<double>(extremes.largest));
  }
  range.smallest = comm.min(range.smallest);
  range.largest = comm.max(range.largest);
  return range;
}

geometry::Regions named(geometry::Regions regions, const std::string& geometry) {
  if (regions.names.empty())
    regions.names = {geometry};
  return regions;
}

Origin origin_of(const shape::RegionShape& shape) {
  const geometry::Boundary& boundary = shape.boundary();
  const geometry::InnerCurves& curves = shape.domain().curves();
  Origin origin{boundary.part_names,
                shape.domain().part_markers(),
                named(shape.domain().regions(), shape.region().text()),
                {boundary.periods.x, boundary.periods.y},
                {},
                curves.names};
  origin.curve_kinds = curves.kinds;
  return origin;
}

io::Metadata describe(const meshing::MeshResult& result, const Origin& origin, const std::string& sizing,
                      const comm::Communicator& comm) {
  const SizeRange sizes = size_range(result.mesh, comm);
  const Attributes made{{"created_utc", utc_time()},
                        {"mpi_library", comm::library_version()},
                        {"hdf5_library", io::hdf5_version()},
                        {"sizing", sizing},
                        {"smallest_size", sizes.smallest},
                        {"largest_size", sizes.largest},
                        {"complete", std::int64_t{is_complete(result)}}};
  return with_regions(
      {joined({format_attributes(), made, open_attributes(origin), place_attributes(origin),
               mesh_attributes(result.mesh, result.triangulations + 1), result_attributes(result)}),
       {},
       {history_group(result.history), quality_group(result.quality), checks_group(result.checks),
        bad_triangles_group(result.quality), tags_group(origin, result.loops),
        sharp_corners_group(result.features.sharp_corners), rings_group(origin, result.features.loops)}},
      origin, result);
}

} // namespace trime::record
