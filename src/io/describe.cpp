// SPDX-License-Identifier: BSD-3-Clause
#include "trime/io/describe.hpp"

#include <fmt/format.h>

#include <functional>

namespace trime::io {
namespace {

/// One value of each element as a column.
template <class T, class Element, class Value>
Column column(const std::string& name, const std::vector<Element>& elements, const Value& value) {
  std::vector<T> values;
  for (const Element& element : elements)
    values.push_back(static_cast<T>(std::invoke(value, element)));
  return {name, std::move(values)};
}

void add_summary(std::vector<Attribute>& to, const std::string& name, const mesh::RatioSummary& s) {
  to.push_back({name + "_median", s.median});
  to.push_back({name + "_mean", s.mean});
  to.push_back({name + "_max", s.max});
  to.push_back({name + "_half_mean", s.half_mean});
  to.push_back({name + "_std", s.std});
}

} // namespace

MetadataGroup quality_group(const mesh::QualitySummary& quality) {
  MetadataGroup group{"quality", {}, {}};
  add_summary(group.attributes, "alpha", quality.alpha);
  add_summary(group.attributes, "beta", quality.beta);
  group.attributes.push_back({"min_angle_degrees", quality.min_angle_degrees});
  group.attributes.push_back({"shortest_edge", quality.shortest_edge});
  group.attributes.push_back({"shortest_edge_x", quality.shortest_place.x});
  group.attributes.push_back({"shortest_edge_y", quality.shortest_place.y});
  group.attributes.push_back({"size_mean", quality.size_mean});
  group.attributes.push_back({"size_std", quality.size_std});
  group.attributes.push_back({"bad_triangles", quality.bad_triangles});
  const auto& edges = mesh::RatioStatistics::histogram_edges;
  const auto& counts = quality.alpha_histogram;
  group.columns.push_back({"alpha_histogram_from", std::vector<double>(edges.begin(), edges.end())});
  group.columns.push_back({"alpha_histogram", std::vector<std::int64_t>(counts.begin(), counts.end())});
  return group;
}

MetadataGroup bad_triangles_group(const mesh::QualitySummary& quality) {
  using mesh::BadTriangle;
  const std::vector<BadTriangle>& worst = quality.worst_triangles;
  return {"worst_triangles",
          {},
          {column<double>("alpha", worst, &BadTriangle::alpha),
           column<double>("x", worst, [](const BadTriangle& one) { return one.place.x; }),
           column<double>("y", worst, [](const BadTriangle& one) { return one.place.y; }),
           column<double>("corner_degrees", worst, &BadTriangle::corner_degrees),
           column<double>("corner_x", worst, [](const BadTriangle& one) { return one.corner.x; }),
           column<double>("corner_y", worst, [](const BadTriangle& one) { return one.corner.y; })}};
}

MetadataGroup checks_group(const mesh::Checks& checks) {
  using mesh::Check;
  return {"checks",
          {},
          {column<std::string>("name", checks, &Check::name), column<double>("expected", checks, &Check::expected),
           column<double>("found", checks, &Check::found), column<std::int32_t>("passed", checks, &Check::passed),
           column<std::string>("meaning", checks, &Check::meaning)}};
}

Metadata describe(const mesh::DistributedMesh& mesh, const mesh::QualitySummary& quality, const mesh::Checks& checks) {
  return {{{"format", std::string("trime_mpi-mesh")},
           {"format_version", std::int64_t{1}},
           {"points", mesh.point_slab.total},
           {"triangles", mesh.triangle_slab.total},
           {"mesh_hash", mesh.hash},
           {"mesh_hash_hex", fmt::format("{:016x}", mesh.hash)},
           {"complete", std::int64_t{mesh::all_passed(checks)}}},
          {},
          {quality_group(quality), checks_group(checks)}};
}

} // namespace trime::io
