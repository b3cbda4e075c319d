// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_sizing.hpp"

#include "trime/core/error.hpp"
#include "trime/core/formula.hpp"

namespace trime::app {
namespace {

// [1] Growth of the automatic size per length if none is given, as in TriMe++.
constexpr double automatic_gradation = 0.1;

// [1] Largest growth of a formula per length if none is given: triangles follow it with a largest alpha below 1.6.
constexpr double formula_gradation = 0.3;

/// The formula must parse; it is made again when the number of threads is known.
void read_expression(const Settings& settings, SizingOptions& sizing, Diagnostics& problems) {
  sizing.expression = settings.text("sizing", "expression");
  if (sizing.expression == "none") {
    problems.add(settings.line("sizing", "type"),
                 "'type = expression' in [sizing] needs 'expression', for example 'expression = 1+3*x+3*y'");
    return;
  }
  const std::string what = "'expression' in [sizing]";
  const int line = settings.line("sizing", "expression");
  sizing.expression_place = problems.place(line) + ": " + what;
  try {
    const Formula formula(sizing.expression, what);
  } catch (const ConfigError& error) {
    problems.add(line, error.what());
  }
}

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
    growth = options.sizing.gradation = given.value_or(automatic_gradation);
  } else if (type == "expression" && settings.text("sizing", "gradation") == "auto") {
    growth = formula_gradation;
  } else if (type == "expression" && given && *given == 0) {
    refuse("expected a number above 0, or none to use the formula as it is");
  }
  if (growth && *growth == 0) // the automatic size is uniform
    growth.reset();
}

/// A size that is a length needs no number of points, and a uniform one needs the length.
void read_scale(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  options.mesh.absolute_sizes = settings.text("sizing", "scale") == "absolute";
  if (options.mesh.absolute_sizes && options.sizing.type == "uniform" && !options.mesh.max_size &&
      !settings.is_set("sizing", "max_size"))
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
  if (sizing.type == "expression")
    read_expression(settings, sizing, problems);
  read_gradation(settings, options, problems);
  read_scale(settings, options, problems);
  check_automatic_scale(settings, options, problems);
  warn_without_effect(settings, "expression", "expression", options);
}

} // namespace trime::app
