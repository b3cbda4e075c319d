// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_sizing.hpp"

#include "core/quoted.hpp"
#include "sizing/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace trime::app {
namespace {

// [1] Growth of a uniform size per length from the lengths in size_at, if none is given.
constexpr double boundary_gradation = 0.15;

void read_bounds(const Settings& settings, meshing::MeshOptions& mesh, Diagnostics& problems) {
  mesh.min_size = settings.optional_number("sizing", "min_size");
  mesh.max_size = settings.optional_number("sizing", "max_size");
  mesh.shortest_edge = settings.optional_number("sizing", "shortest_edge");
  if (mesh.shortest_edge && mesh.max_size && *mesh.shortest_edge > *mesh.max_size)
    problems.add(
        settings.later_line("sizing", "shortest_edge", "max_size"),
        fmt::format("[sizing] needs shortest_edge <= max_size, found {} and {}: edges are about as long as the "
                    "size",
                    *mesh.shortest_edge, *mesh.max_size));
  if (mesh.min_size && mesh.max_size && *mesh.min_size > *mesh.max_size)
    problems.add(settings.later_line("sizing", "min_size", "max_size"),
                 fmt::format("[sizing] needs min_size <= max_size, found {} and {}", *mesh.min_size, *mesh.max_size));
}

/// Sets the gradation of the automatic size, and the largest growth of any size in the mesh.
void read_gradation(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  const std::string& type = options.sizing.type;
  const std::optional<double> given = settings.optional_number("sizing", "gradation");
  std::optional<double>& growth = options.mesh.gradation;
  const auto refuse = [&](const char* why) {
    problems.add(settings.line("sizing", "gradation"),
                 fmt::format("'gradation = {}' in [sizing]: {}", settings.text("sizing", "gradation"), why));
  };
  growth = given;
  if (type == "automatic") {
    if (settings.text("sizing", "gradation") == "none")
      refuse("expected a number, because the automatic size grows by this number per length");
    growth = options.sizing.gradation = given.value_or(SizingOptions().gradation);
  } else if (type == "expression" && settings.text("sizing", "gradation") == "auto") {
    growth = sizing::SizingRules::function_gradation;
  } else if (type == "expression" && given && *given == 0) {
    refuse("expected a number above 0, or none to use the formula as it is");
  }
  if (growth && *growth == 0) // the automatic size is uniform
    growth.reset();
  if (!growth && settings.text("sizing", "gradation") == "auto" && !options.sizing.more.empty())
    growth = sizing::SizingRules::function_gradation;
  const auto is_sized = [](const RegionOptions& region) { return region.size.has_value() || region.area_limits; };
  if (!growth && settings.text("sizing", "gradation") == "auto" && std::ranges::any_of(options.regions, is_sized))
    growth = sizing::SizingRules::function_gradation;
}

/// A size that is a length needs no number of points, and a uniform one needs the length.
void read_scale(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  const std::string scale = settings.text("sizing", "scale");
  options.scale_is_automatic = scale == "auto";
  options.mesh.absolute_sizes = scale == "absolute" || (scale == "auto" && options.sizing.uses_data);
  if (options.mesh.absolute_sizes && options.sizing.type == "uniform" && options.sizing.more.empty() &&
      !options.mesh.max_size && !settings.is_set("sizing", "max_size"))
    problems.add(settings.line("sizing", "scale"),
                 "'scale = absolute' in [sizing] with 'type = uniform' needs 'max_size', the length of the edges, for "
                 "example 'max_size = 2000'");
}

/// The automatic size as a length has no mean from which the least feature follows.
void check_automatic_scale(const Settings& settings, const RunOptions& options, Diagnostics& problems) {
  if (options.mesh.absolute_sizes && options.sizing.type == "automatic" && !settings.is_set("sizing", "min_size"))
    problems.add(settings.line("sizing", "scale"),
                 "'scale = absolute' in [sizing] with 'type = automatic' needs 'min_size', the length below which "
                 "features of the boundary are not resolved, for example 'min_size = 200'");
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// Splits a list at its commas, except at those between double quotes.
std::vector<std::string_view> entries_of(std::string_view list) {
  std::vector<std::string_view> entries;
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= list.size(); ++k) {
    is_quoted ^= k < list.size() && list[k] == '"';
    if (k < list.size() && (list[k] != ',' || is_quoted))
      continue;
    entries.push_back(trimmed(list.substr(begin, k - begin)));
    begin = k + 1;
  }
  return entries;
}

/// Reads "NAME LENGTH"; the name may be in double quotes.
/// @throws ConfigError if the entry is something else
sizing::NamedSize named_size(std::string_view entry) {
  const std::size_t blank = entry.find_last_of(" \t");
  std::string_view name = blank == std::string_view::npos ? std::string_view() : trimmed(entry.substr(0, blank));
  const std::string_view number = blank == std::string_view::npos ? entry : entry.substr(blank + 1);
  if (name.size() > 2 && name.front() == '"' && name.back() == '"')
    name = name.substr(1, name.size() - 2);
  double length = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), length);
  if (name.empty() || error != std::errc() || end != number.data() + number.size())
    throw ConfigError(fmt::format("expected NAME LENGTH, for example 'coast 200', found {}", trime::quoted(entry)));
  if (!(length > 0) || !std::isfinite(length))
    throw ConfigError(fmt::format("expected a positive length for {}, found {}", trime::quoted(name), number));
  return {std::string(name), length};
}

/// The bounds of the size must leave room for a length on the boundary.
void check_within_bounds(const sizing::NamedSize& named, const meshing::MeshOptions& mesh) {
  if (mesh.min_size && named.size < *mesh.min_size)
    throw ConfigError(fmt::format("the length {:.6g} of {} is below 'min_size = {:.6g}'", named.size,
                                  trime::quoted(named.name), *mesh.min_size));
  if (mesh.max_size && named.size > *mesh.max_size)
    throw ConfigError(fmt::format("the length {:.6g} of {} is above 'max_size = {:.6g}'", named.size,
                                  trime::quoted(named.name), *mesh.max_size));
}

/// The lengths are absolute, and the size grows from them by a gradation.
void check_size_at(const Settings& settings, RunOptions& options) {
  std::optional<double>& growth = options.mesh.gradation;
  if (!options.mesh.absolute_sizes)
    throw ConfigError("the lengths need 'scale = absolute'");
  if (!growth && options.sizing.type == "uniform" && settings.text("sizing", "gradation") == "auto")
    growth = boundary_gradation;
  if (!growth)
    throw ConfigError("the size grows from the boundary by 'gradation', which must be a number above 0, for example "
                      "'gradation = 0.15'");
}

/// Reads the lengths on parts of the boundary. The names are compared with those of the shape when it has been made.
void read_size_at(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  const std::string list = settings.text("sizing", "size_at");
  if (list == "none")
    return;
  const int line = settings.line("sizing", "size_at");
  const std::string what = "'size_at' in [sizing]";
  options.sizing.size_at_place = problems.place(line) + ": " + what;
  try {
    check_size_at(settings, options);
    for (const std::string_view entry : entries_of(list)) {
      options.sizing.size_at.push_back(named_size(entry));
      check_within_bounds(options.sizing.size_at.back(), options.mesh);
    }
  } catch (const ConfigError& error) {
    problems.add(line, fmt::format("{}: {}", what, error.what()));
  }
}

/// A key that only another type obeys. Its default is not worth a word: printed configs hold it.
void warn_without_effect(const Settings& settings, const std::string& key, const std::string& type_of_key,
                         RunOptions& options) {
  if (settings.text("sizing", key) != find_option("sizing", key)->fallback && options.sizing.type != type_of_key)
    options.warnings.push_back(
        fmt::format("'{}' in [sizing] has no effect: the type is {}, not {}", key, options.sizing.type, type_of_key));
}

} // namespace

void read_sizing(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  SizingOptions& sizing = options.sizing;
  sizing.type = settings.text("sizing", "type");
  read_bounds(settings, options.mesh, problems);
  if (settings.was_refused("sizing", "type"))
    return;
  read_gradation(settings, options, problems);
  read_scale(settings, options, problems);
  check_automatic_scale(settings, options, problems);
  read_size_at(settings, options, problems);
  warn_without_effect(settings, "expression", "expression", options);
}

} // namespace trime::app
