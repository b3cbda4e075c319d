// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_inside.hpp"

#include "core/quoted.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <algorithm>
#include <vector>

namespace trime::app {
namespace {

namespace fs = std::filesystem;

// Defaults that stand for other values.
constexpr const char *default_rest = "geometry", *own_name = "NAME";

/// The value of `normalize_with`, which must name a normalised contour; empty for none.
std::string normalizing_contour(const Settings& settings, const std::string& section, const RunOptions& options,
                                Diagnostics& problems) {
  const std::string with = settings.text(section, "normalize_with");
  if (with == "none")
    return {};
  const auto is_it = [&](const PartOptions& part) { return part.name == with && part.normalize; };
  if (std::none_of(options.parts.begin(), options.parts.end(), is_it))
    problems.add(settings.line(section, "normalize_with"),
                 fmt::format("'normalize_with = {}' in [{}]: expected the name of a part of type contour with "
                             "'normalize = true'{}",
                             shown(with), section, suggestion(with, settings.parts())));
  return with;
}

/// Reads the keys that all sections with a file have.
template <class FileOptions>
void read_file_of(const Settings& settings, const std::string& section, const fs::path& directory, FileOptions& read) {
  read.file_is_relative = fs::path(settings.text(section, "file")).is_relative();
  read.file = (directory / settings.text(section, "file")).lexically_normal().string();
  if (const std::string attribute = settings.text(section, "attribute"); attribute != "none")
    read.attribute = attribute;
}

/// Returns the kind of a curve: whether it is split, and whether it is a weir. A weir that is not split is a problem.
geometry::CurveKind kind_of(const Settings& settings, const std::string& section, Diagnostics& problems) {
  geometry::CurveKind kind;
  kind.split = settings.boolean(section, "split");
  kind.weir_height = settings.optional_number(section, "weir_height");
  kind.weir_subcritical = settings.number(section, "weir_subcritical");
  kind.weir_supercritical = settings.number(section, "weir_supercritical");
  if (kind.weir_height && !kind.split)
    problems.add(settings.line(section, "weir_height"),
                 fmt::format("'weir_height' in [{}]: expected 'split = true' in the same section, since a weir has "
                             "points on both sides",
                             section));
  return kind;
}

CurveOptions curve_of(const Settings& settings, const std::string& name, const fs::path& directory,
                      const RunOptions& options, Diagnostics& problems) {
  const std::string section = "curve." + name;
  CurveOptions curve;
  curve.name = name;
  read_file_of(settings, section, directory, curve);
  curve.clip = settings.boolean(section, "clip");
  curve.kind = kind_of(settings, section, problems);
  curve.normalize_with = normalizing_contour(settings, section, options, problems);
  return curve;
}

/// Returns whether the largest areas of triangles in a file count.
bool area_limits_of(const Settings& settings, const std::string& section, Diagnostics& problems) {
  const bool limits = settings.boolean(section, "area_limits");
  if (limits && settings.text("sizing", "scale") != "absolute")
    problems.add(settings.line(section, "area_limits"),
                 fmt::format("'area_limits = true' in [{}] needs 'scale = absolute' in [sizing], because the areas in "
                             "the file are not relative to another size",
                             section));
  return limits;
}

/// Without its expression.
RegionOptions region_of(const Settings& settings, const std::string& name, const fs::path& directory,
                        const RunOptions& options, Diagnostics& problems) {
  const std::string section = "region." + name;
  RegionOptions region;
  region.name = name;
  region.size = settings.optional_number(section, "size");
  if (settings.text(section, "file") != "none") {
    read_file_of(settings, section, directory, region);
    region.normalize_with = normalizing_contour(settings, section, options, problems);
    region.area_limits = area_limits_of(settings, section, problems);
    if (settings.text(section, "geometry") != own_name)
      problems.add(settings.line(section, "geometry"),
                   fmt::format("[{}] has 'geometry' and 'file': expected only one of them", shown(section)));
    return region;
  }
  if (settings.boolean(section, "area_limits"))
    problems.add(settings.line(section, "area_limits"),
                 fmt::format("'area_limits' in [{}] needs 'file', a .poly with region points", section));
  for (const char* key : {"attribute", "normalize_with"})
    if (settings.text(section, key) != "none")
      problems.add(settings.line(section, key),
                   fmt::format("'{}' in [{}] needs 'file', the polygons of the region", key, shown(section)));
  return region;
}

/// Adds the parts of the expression of a region to `used`.
void read_expression(const Settings& settings, RegionOptions& region, std::set<int>& used, Diagnostics& problems) {
  const std::string section = "region." + region.name;
  const std::string text = settings.text(section, "geometry");
  const bool is_set = text != own_name;
  region.geometry = is_set ? text : region.name;
  try {
    const shape::Region parsed = shape::Region::parse(region.geometry, settings.parts());
    used.insert(parsed.parts().begin(), parsed.parts().end());
  } catch (const Error& error) {
    problems.add(is_set ? settings.line(section, "geometry") : settings.section_line(section),
                 fmt::format("region '{}': {}", shown(region.name), error.what()));
  }
}

std::set<int> read_regions(const Settings& settings, const fs::path& directory, RunOptions& options,
                           Diagnostics& problems) {
  std::set<int> used;
  options.regions_cover_all = settings.text("shape", "cover") == "all";
  const std::string rest = settings.text("shape", "rest");
  const bool has_rest = rest != default_rest;
  if (has_rest)
    options.rest = rest;
  for (const std::string& name : settings.regions()) {
    RegionOptions& region = options.regions.emplace_back(region_of(settings, name, directory, options, problems));
    if (region.file.empty())
      read_expression(settings, region, used, problems);
    if (has_rest && name == rest)
      problems.add(
          settings.section_line("region." + name),
          fmt::format("[region.{}] has the name of the rest of the shape; expected different names: set 'rest' "
                      "in [shape]",
                      shown(name)));
  }
  if (options.regions.empty() && (options.regions_cover_all || has_rest))
    problems.add(settings.line("shape", options.regions_cover_all ? "cover" : "rest"),
                 "'rest' and 'cover' in [shape] need regions: add a section [region.NAME]");
  return used;
}

} // namespace

std::set<int> read_inside(const Settings& settings, const fs::path& directory, RunOptions& options,
                          Diagnostics& problems) {
  for (const std::string& name : settings.curves())
    options.curves.push_back(curve_of(settings, name, directory, options, problems));
  std::set<int> used = read_regions(settings, directory, options, problems);
  const bool is_periodic = settings.boolean("domain", "periodic_x") || settings.boolean("domain", "periodic_y");
  for (const CurveOptions& curve : options.curves)
    if (is_periodic && curve.kind.split)
      problems.add(
          settings.line("curve." + curve.name, "split"),
          fmt::format("'split = true' in [curve.{}]: curves of a periodic container cannot be split yet: remove "
                      "'split', or periodic_x and periodic_y",
                      curve.name));
  return used;
}

} // namespace trime::app
