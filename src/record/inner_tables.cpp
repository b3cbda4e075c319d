// SPDX-License-Identifier: BSD-3-Clause
// Tables that explain the numbers of curves, interfaces and regions in a mesh file.
#include "record/groups.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trime::record {
namespace {

/// The table of the interfaces: columns pair_id, pair_name, left, right and label.
io::MetadataGroup interfaces_group(const Origin& origin) {
  const geometry::Regions& regions = origin.regions;
  std::vector<std::int32_t> ids(regions.pairs.size()), labels(ids);
  std::vector<std::string> names;
  for (std::size_t pair = 0; pair < ids.size(); ++pair)
    names.push_back(regions.pair_name(pair));
  std::iota(ids.begin(), ids.end(), 0);
  std::iota(labels.begin(), labels.end(),
            static_cast<std::int32_t>(origin.part_names.size() + origin.curve_names.size()) + 1);
  return {"interfaces",
          {},
          {{"pair_id", ids},
           {"pair_name", names},
           column<std::int32_t>("left", regions.pairs, [](const std::array<int, 2>& pair) { return pair[0] + 1; }),
           column<std::int32_t>("right", regions.pairs, [](const std::array<int, 2>& pair) { return pair[1] + 1; }),
           {"label", labels}}};
}

constexpr double no_weir = std::numeric_limits<double>::quiet_NaN();

/// Adds columns to the table of curves if any curve is split.
void add_kinds(const std::vector<geometry::CurveKind>& kinds, io::MetadataGroup& group) {
  using Kind = geometry::CurveKind;
  if (std::ranges::none_of(kinds, &Kind::split))
    return;
  group.columns.push_back(column<std::int32_t>("split", kinds, &Kind::split));
  group.columns.push_back(
      column<double>("weir_height", kinds, [](const Kind& kind) { return kind.weir_height.value_or(no_weir); }));
  group.columns.push_back(column<double>("weir_subcritical", kinds, &Kind::weir_subcritical));
  group.columns.push_back(column<double>("weir_supercritical", kinds, &Kind::weir_supercritical));
}

} // namespace

std::vector<geometry::CurveKind> curve_kinds(const io::Metadata& metadata) {
  const io::MetadataGroup* group = io::find_group(metadata, "curves");
  if (group == nullptr || std::ranges::find(group->columns, "split", &io::Column::name) == group->columns.end())
    return {};
  const auto& split = io::column_of<std::int32_t>(metadata, "curves", "split");
  const auto& heights = io::column_of<double>(metadata, "curves", "weir_height");
  const auto& subcritical = io::column_of<double>(metadata, "curves", "weir_subcritical");
  const auto& supercritical = io::column_of<double>(metadata, "curves", "weir_supercritical");
  std::vector<geometry::CurveKind> kinds;
  for (std::size_t k = 0; k < std::min({split.size(), heights.size(), subcritical.size(), supercritical.size()}); ++k) {
    geometry::CurveKind& kind = kinds.emplace_back();
    kind = {split[k] != 0, std::nullopt, subcritical[k], supercritical[k]};
    if (!std::isnan(heights[k]))
      kind.weir_height = heights[k];
  }
  return kinds;
}

io::Metadata with_inner_edges(io::Metadata metadata, const Origin& origin) {
  if (!origin.curve_names.empty()) {
    std::vector<std::int32_t> ids(origin.curve_names.size()), labels(ids);
    std::iota(ids.begin(), ids.end(), 0);
    std::iota(labels.begin(), labels.end(), static_cast<std::int32_t>(origin.part_names.size()) + 1);
    io::MetadataGroup& group = metadata.groups.emplace_back(
        io::MetadataGroup{"curves", {}, {{"curve_id", ids}, {"curve_name", origin.curve_names}, {"label", labels}}});
    add_kinds(origin.curve_kinds, group);
  }
  if (origin.regions.any())
    metadata.groups.push_back(interfaces_group(origin));
  return metadata;
}

namespace {

/// Returns the table of losses: the numbers of both regions, the reason, the sum of the areas, and the largest place.
io::MetadataGroup losses_group(const std::vector<geometry::RegionLoss>& losses) {
  using geometry::RegionLoss;
  return {"region_losses",
          {},
          {column<std::int32_t>("loser", losses, [](const RegionLoss& loss) { return loss.loser + 1; }),
           column<std::int32_t>("winner", losses, [](const RegionLoss& loss) { return loss.winner + 1; }),
           column<std::string>("reason", losses,
                               [](const RegionLoss& loss) { return std::string(geometry::name_of(loss.reason)); }),
           column<double>("area", losses, &RegionLoss::area),
           column<std::int64_t>("places", losses, &RegionLoss::count),
           column<double>("largest_area", losses, &RegionLoss::largest),
           column<double>("largest_x", losses, [](const RegionLoss& loss) { return loss.place.x; }),
           column<double>("largest_y", losses, [](const RegionLoss& loss) { return loss.place.y; })}};
}

} // namespace

io::Metadata with_regions(io::Metadata metadata, const Origin& origin, const meshing::MeshResult& result) {
  const std::vector<meshing::RegionSummary>& regions = result.regions;
  metadata = with_inner_edges(std::move(metadata), origin);
  if (regions.empty())
    return metadata;
  std::vector<std::int32_t> ids(regions.size());
  std::iota(ids.begin(), ids.end(), 1);
  metadata.groups.push_back({"regions",
                             {},
                             {{"region_id", ids},
                              {"region_name", origin.regions.names},
                              column<std::int64_t>("triangles", regions, &meshing::RegionSummary::triangles),
                              column<double>("area", regions, &meshing::RegionSummary::area),
                              column<double>("given_area", regions, &meshing::RegionSummary::given_area)}});
  if (!result.region_losses.empty())
    metadata.groups.push_back(losses_group(result.region_losses));
  return metadata;
}

} // namespace trime::record
