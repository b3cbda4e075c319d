// SPDX-License-Identifier: BSD-3-Clause
#include "app/config_formulas.hpp"

#include "core/distance_formula.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <set>

namespace trime::app {
namespace {

/// Names of the data fields that formulas use.
struct UsedFields {
  std::set<std::string> names, slopes; ///< the second ones in `grad(NAME)`
};

std::vector<FieldOptions> read_fields(const Settings& settings, const std::filesystem::path& directory) {
  std::vector<FieldOptions> fields;
  for (const std::string& name : settings.fields()) {
    const std::string section = "field." + name;
    const std::filesystem::path file = settings.text(section, "file");
    FieldOptions& field = fields.emplace_back();
    field.name = name;
    field.file = (directory / file).lexically_normal().string();
    field.file_is_relative = file.is_relative();
    if (const std::string variable = settings.text(section, "variable"); variable != "none")
      field.variable = variable;
    field.fill = settings.text(section, "fill");
    field.fill_value = settings.number(section, "fill");
    field.outside_is_nearest = settings.text(section, "outside") == "nearest";
    field.coordinates = settings.text(section, "coordinates");
    field.smooth = settings.optional_number(section, "smooth").value_or(0);
  }
  return fields;
}

/// Reads a formula, which must parse; it is made again when the number of threads is known. Adds the fields that it
/// uses.
FormulaText read_formula(const Settings& settings, const std::string& section, const std::string& key, UsedFields& used,
                         Diagnostics& problems) {
  const std::string what = fmt::format("'{}' in [{}]", key, section);
  const int line = settings.line(section, key);
  const FormulaText formula{settings.text(section, key), problems.place(line) + ": " + what};
  try {
    // The names of the boundary are known only when the shape has been made.
    const auto one = [](double, double) { return 1.0; };
    std::vector<FormulaField> fields;
    for (const std::string& name : settings.fields())
      fields.push_back({name, one, one});
    for (const std::string& name : settings.meant_fields())
      if (std::ranges::find(settings.fields(), name) == settings.fields().end())
        fields.push_back({name, one, one});
    const DistanceFormula parsed(
        formula.text, what, [&](const std::string&) -> PlaceFunction { return one; }, std::move(fields));
    for (const std::string& name : parsed.fields())
      used.names.insert(name);
    for (const std::string& name : parsed.slopes())
      used.slopes.insert(name);
  } catch (const ConfigError& error) {
    problems.add(line, error.what());
    used.names.insert(settings.fields().begin(), settings.fields().end()); // no consequences of this error
    used.slopes.insert(settings.fields().begin(), settings.fields().end());
  }
  return formula;
}

/// Reads the sections [size.NAME].
void read_more_sizes(const Settings& settings, RunOptions& options, UsedFields& used, Diagnostics& problems) {
  for (const std::string& name : settings.sizes())
    if (const std::string section = "size." + name; settings.is_set(section, "expression"))
      options.sizing.more.push_back({name, read_formula(settings, section, "expression", used, problems)});
  options.sizing.uses_data = !used.names.empty();
}

/// Reads the formula of the size, if the type of the size wants one.
void read_size(const Settings& settings, RunOptions& options, UsedFields& used, Diagnostics& problems) {
  if (settings.was_refused("sizing", "type") || settings.text("sizing", "type") != "expression")
    return;
  if (settings.text("sizing", "expression") == "none") {
    problems.add(settings.line("sizing", "type"),
                 "'type = expression' in [sizing] needs 'expression', for example 'expression = 1+3*x+3*y'");
    return;
  }
  options.sizing.expression = read_formula(settings, "sizing", "expression", used, problems);
}

} // namespace

void read_formulas(const Settings& settings, const std::filesystem::path& directory, RunOptions& options,
                   Diagnostics& problems) {
  UsedFields used;
  read_size(settings, options, used, problems);
  read_more_sizes(settings, options, used, problems);
  if (settings.text("output", "depth") != "none")
    options.depth = read_formula(settings, "output", "depth", used, problems);
  for (FieldOptions& field : read_fields(settings, directory)) {
    if (!used.names.contains(field.name)) { // probably a mistake
      options.warnings.push_back(fmt::format(
          "[field.{}] has no effect: neither a formula of a size nor 'depth' in [output] uses it", field.name));
      continue;
    }
    if (field.smooth > 0 && !used.slopes.contains(field.name)) {
      options.warnings.push_back(fmt::format("'smooth' in [field.{0}] has no effect: only the slope grad({0}) is "
                                             "smoothed, and no formula uses it",
                                             field.name));
      field.smooth = 0;
    }
    options.fields.push_back(std::move(field));
  }
}

} // namespace trime::app
