// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_sizing.hpp"

#include "trime/core/error.hpp"
#include "trime/core/formula.hpp"

namespace trime::app {
namespace {

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
  if (mesh.min_size && mesh.max_size && *mesh.min_size > *mesh.max_size)
    problems.add(settings.later_line("sizing", "min_size", "max_size"),
                 fmt::format("[sizing] needs min_size <= max_size, found {} and {}", *mesh.min_size, *mesh.max_size));
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
  sizing.gradation = settings.number("sizing", "gradation");
  read_bounds(settings, options.mesh, problems);
  if (settings.was_refused("sizing", "type"))
    return;
  if (sizing.type == "expression")
    read_expression(settings, sizing, problems);
  warn_without_effect(settings, "gradation", "automatic", options);
  warn_without_effect(settings, "expression", "expression", options);
}

} // namespace trime::app
