// SPDX-License-Identifier: BSD-3-Clause
// Makes a Mesh of the library from a mesh file.
#include "facade/implementation.hpp"
#include "record/groups.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace trime {
namespace {

geometry::Regions regions_of(const io::Metadata& metadata) {
  geometry::Regions regions{io::column_of<std::string>(metadata, "tags", "region_name")};
  if (!io::has_regions(metadata))
    return regions;
  const auto& left = io::column_of<std::int32_t>(metadata, "interfaces", "left");
  const auto& right = io::column_of<std::int32_t>(metadata, "interfaces", "right");
  const auto last = std::ssize(regions.names);
  for (std::size_t pair = 0; pair < std::min(left.size(), right.size()); ++pair) {
    if (left[pair] < 1 || left[pair] > last || right[pair] < 1 || right[pair] > last)
      throw FileError(fmt::format("/trime_mpi/interfaces names the regions {} and {}: expected numbers from 1 to {}; "
                                  "the file is damaged",
                                  left[pair], right[pair], last));
    regions.pairs.push_back({left[pair] - 1, right[pair] - 1});
  }
  return regions;
}

/// The names and other things that are there for readers of the file.
record::Origin origin_of(const io::Metadata& metadata) {
  record::Origin origin;
  origin.part_names = io::column_of<std::string>(metadata, "tags", "part_name");
  origin.part_markers = io::column_of<std::int32_t>(metadata, "tags", "part_marker");
  origin.regions = regions_of(metadata);
  origin.period = {io::attribute_of<double>(metadata, "period_x"), io::attribute_of<double>(metadata, "period_y")};
  origin.crs = io::attribute_of<std::string>(metadata, "crs");
  origin.curve_names = io::curve_names(metadata);
  origin.curve_kinds = record::curve_kinds(metadata);
  origin.open_boundary = record::open_boundary_of(metadata);
  return origin;
}

mesh::QualitySummary quality_of(const io::Metadata& metadata) {
  mesh::QualitySummary quality;
  const io::MetadataGroup* group = io::find_group(metadata, "quality");
  for (const auto& [name, value] : {std::pair{"alpha_median", &quality.alpha.median},
                                    {"alpha_mean", &quality.alpha.mean},
                                    {"alpha_max", &quality.alpha.max},
                                    {"alpha_half_mean", &quality.alpha.half_mean},
                                    {"alpha_std", &quality.alpha.std},
                                    {"beta_median", &quality.beta.median},
                                    {"beta_mean", &quality.beta.mean},
                                    {"beta_max", &quality.beta.max},
                                    {"beta_half_mean", &quality.beta.half_mean},
                                    {"beta_std", &quality.beta.std},
                                    {"min_angle_degrees", &quality.min_angle_degrees},
                                    {"shortest_edge", &quality.shortest_edge},
                                    {"shortest_edge_x", &quality.shortest_place.x},
                                    {"shortest_edge_y", &quality.shortest_place.y},
                                    {"growth_90", &quality.growth.of_90_percent},
                                    {"growth_99", &quality.growth.of_99_percent},
                                    {"growth_largest", &quality.growth.largest},
                                    {"growth_largest_x", &quality.growth.place.x},
                                    {"growth_largest_y", &quality.growth.place.y},
                                    {"longest_over_size", &quality.longest_over_size},
                                    {"longest_over_size_x", &quality.longest_place.x},
                                    {"longest_over_size_y", &quality.longest_place.y},
                                    {"size_mean", &quality.size_mean},
                                    {"size_std", &quality.size_std}})
    if (group != nullptr)
      for (const io::Attribute& attribute : group->attributes)
        if (attribute.name == name && std::holds_alternative<double>(attribute.value))
          *value = std::get<double>(attribute.value);
  for (const auto& [name, value] : {std::pair{"bad_triangles", &quality.bad_triangles},
                                    {"obtuse_triangles", &quality.obtuse_triangles},
                                    {"obtuse_at_corners", &quality.obtuse_at_corners}})
    if (group != nullptr)
      for (const io::Attribute& attribute : group->attributes)
        if (attribute.name == name && std::holds_alternative<std::int64_t>(attribute.value))
          *value = std::get<std::int64_t>(attribute.value);
  return quality;
}

} // namespace

Mesh read_mesh(MPI_Comm handle, const std::string& path) {
  auto read = std::make_unique<Mesh::Implementation>();
  read->communicator = std::make_shared<const comm::Communicator>(comm::duplicate_of(handle));
  read->metadata = io::read_metadata(path,
                                     {"history", "quality", "checks", "worst_triangles", "tags", "sharp_corners",
                                      "rings", "curves", "interfaces", "regions", "normalization", "sizes", "accept"},
                                     *read->communicator);
  read->origin = origin_of(read->metadata);
  read->result.checks = record::checks_of(read->metadata);
  read->result.quality = quality_of(read->metadata);
  read->result.mesh = io::read_mesh(path, read->metadata, *read->communicator);
  return Mesh(std::move(read));
}

} // namespace trime
