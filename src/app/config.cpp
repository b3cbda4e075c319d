// SPDX-License-Identifier: BSD-3-Clause
#include "app/config.hpp"

#include "app/config_formulas.hpp"
#include "app/config_inside.hpp"
#include "app/config_sizing.hpp"
#include "app/present_names.hpp"
#include "app/settings.hpp"
#include "core/angle.hpp"
#include "core/quoted.hpp"
#include "formats/output_files.hpp"
#include "trime/core/error.hpp"
#include "trime/core/formula.hpp"
#include "trime/shape/region_shape.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace trime::app {
namespace {

namespace fs = std::filesystem;

constexpr double shortest_side = 1e-30,
                 longest_side = 1e30; // products of four lengths must neither vanish nor overflow

/// `low < high`, unless one of them was refused already. @param instead what holds where they are not given, if any
void check_interval(const Settings& settings, const std::string& section, const std::string& axis,
                    Diagnostics& problems, std::optional<std::pair<double, double>> instead = {}) {
  const std::string low = axis + "_min", high = axis + "_max";
  auto from = settings.optional_number(section, low), to = settings.optional_number(section, high);
  if (instead) {
    from = from.value_or(instead->first);
    to = to.value_or(instead->second);
  }
  if (settings.was_refused(section, low) || settings.was_refused(section, high) || !from || !to || *from < *to)
    return;
  problems.add(settings.later_line(section, low, high),
               fmt::format("[{}] needs {} < {}, found {} and {}", section, low, high, *from, *to));
}

/// Sides for which the predicates are exact, unless an end of them was refused already.
void check_side(const Settings& settings, const std::string& axis, Diagnostics& problems) {
  const std::string low = axis + "_min", high = axis + "_max";
  const double side =
      settings.optional_number("domain", high).value_or(1) - settings.optional_number("domain", low).value_or(0);
  if (settings.was_refused("domain", low) || settings.was_refused("domain", high))
    return;
  if (side > 0 && (side < shortest_side || side > longest_side))
    problems.add(settings.later_line("domain", low, high),
                 fmt::format("[domain] needs {} - {} from {} to {}, found {}; use another unit of length", high, low,
                             shortest_side, longest_side, side));
}

/// Coordinates have steps of 2^-44 of the longer side: of the shorter one there must be some.
void check_aspect(const Settings& settings, const geometry::Box& container, Diagnostics& problems) {
  constexpr double least_share = 1e-12;
  const double width = container.width(), height = container.height();
  const auto is_good = [](double side) { return side >= shortest_side && side <= longest_side; };
  if (!is_good(width) || !is_good(height) || std::fmin(width, height) >= least_share * std::fmax(width, height))
    return;
  const bool is_x = settings.is_set("domain", "x_min") || settings.is_set("domain", "x_max");
  problems.add(
      is_x ? settings.later_line("domain", "x_min", "x_max") : settings.later_line("domain", "y_min", "y_max"),
      fmt::format("[domain] has the sides {} and {}: expected the shorter to be at least {} of the longer; set "
                  "x_min, x_max, y_min and y_max around the shape, or none of them",
                  width, height, least_share));
}

geometry::Box box_of(const Settings& settings, const std::string& section) {
  return {{settings.number(section, "x_min"), settings.number(section, "y_min")},
          {settings.number(section, "x_max"), settings.number(section, "y_max")}};
}

/// The formula must parse; the error knows the position in it.
void check_formula(const Settings& settings, const std::string& section, const std::string& key,
                   Diagnostics& problems) {
  const std::string text = settings.text(section, key);
  if (text.empty())
    return; // reported as missing
  try {
    const Formula formula(text, fmt::format("'{}' in [{}]", key, section));
  } catch (const ConfigError& error) {
    problems.add(settings.line(section, key), error.what());
  }
}

PartOptions part_of(const Settings& settings, const std::string& name, const fs::path& directory,
                    Diagnostics& problems) {
  const std::string section = "shape." + name;
  PartOptions part;
  part.name = name;
  part.type = settings.text(section, "type");
  if (part.type == "rectangle") {
    check_interval(settings, section, "x", problems);
    check_interval(settings, section, "y", problems);
    part.box = box_of(settings, section);
  } else if (part.type == "circle") {
    part.center = settings.pair(section, "center");
    part.radius = settings.number(section, "radius");
  } else if (part.type == "triangle") {
    part.corners = {settings.pair(section, "p0"), settings.pair(section, "p1"), settings.pair(section, "p2")};
  } else if (part.type == "contour") {
    part.file_is_relative = fs::path(settings.text(section, "file")).is_relative();
    part.file = (directory / settings.text(section, "file")).lexically_normal().string(); // absolute paths stay
    if (const std::string attribute = settings.text(section, "attribute"); attribute != "none")
      part.attribute = attribute;
    part.dissolve = settings.text(section, "overlap") == "union";
    part.repair = settings.boolean(section, "repair");
    part.normalize = settings.boolean(section, "normalize");
  } else if (part.type == "expression") {
    part.sdf = settings.text(section, "sdf");
    check_formula(settings, section, "sdf", problems);
  }
  return part;
}

/// The geometry must parse. Parts that neither it nor a region uses are worth a warning.
/// @param in_regions the parts that occur in regions
void read_geometry(const Settings& settings, const std::set<int>& in_regions, RunOptions& options,
                   Diagnostics& problems) {
  options.geometry = settings.text("shape", "geometry");
  if (options.geometry.empty()) {
    if (!settings.is_set("shape", "geometry") && !settings.has_unknown_section())
      problems.add(whole_file, settings.parts().empty()
                                   ? "no shape is given: set 'geometry' in [shape] and describe its parts, or set "
                                     "'geometry = domain' to mesh the whole container"
                                   : fmt::format("'geometry' in [shape] is not set; for example 'geometry = {}'",
                                                 settings.parts()[0]));
    return;
  }
  try {
    const shape::Region region = shape::Region::parse(options.geometry, settings.parts());
    for (int part = 0; part < static_cast<int>(settings.parts().size()); ++part)
      if (!std::binary_search(region.parts().begin(), region.parts().end(), part) && !in_regions.contains(part))
        options.warnings.push_back(fmt::format("the part '{}' does not occur in the geometry '{}'{}, so it is left out",
                                               shown(settings.parts()[static_cast<std::size_t>(part)]),
                                               shown(options.geometry),
                                               options.regions.empty() ? "" : " or in a region"));
  } catch (const Error& error) {
    problems.add(settings.line("shape", "geometry"), error.what());
  }
}

/// Reads the projection of contours, which excludes a normalisation.
void read_projection(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  if (const std::string projection = settings.text("shape", "projection"); projection != "none")
    options.projection = projection;
  if (options.projection.empty())
    return;
  const auto is_contour = [](const PartOptions& part) { return part.type == "contour"; };
  if (std::none_of(options.parts.begin(), options.parts.end(), is_contour))
    problems.add(settings.line("shape", "projection"),
                 fmt::format("'projection = {}' in [shape] applies to contours only, but no part has 'type = contour'",
                             options.projection));
  for (const PartOptions& part : options.parts)
    if (part.normalize)
      problems.add(
          settings.line("shape." + part.name, "normalize"),
          fmt::format("'normalize = true' in [shape.{}] and 'projection = {}' in [shape]: expected only one of them",
                      part.name, options.projection));
}

void read_shape_options(const Settings& settings, const fs::path& directory, RunOptions& options,
                        Diagnostics& problems) {
  for (const std::string& name : settings.parts())
    options.parts.push_back(part_of(settings, name, directory, problems));
  read_geometry(settings, read_inside(settings, directory, options, problems), options, problems);
  read_projection(settings, options, problems);
}

void read_domain(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  meshing::MeshOptions& mesh = options.mesh;
  check_interval(settings, "domain", "x", problems,
                 std::pair{geometry::unit_square.min.x, geometry::unit_square.max.x});
  check_interval(settings, "domain", "y", problems,
                 std::pair{geometry::unit_square.min.y, geometry::unit_square.max.y});
  check_side(settings, "x", problems);
  check_side(settings, "y", problems);
  options.periodic_x = settings.boolean("domain", "periodic_x");
  options.periodic_y = settings.boolean("domain", "periodic_y");
  options.container_is_automatic = !options.periodic_x && !options.periodic_y;
  for (const auto& [key, side] : {std::pair<const char*, double*>{"x_min", &options.container.min.x},
                                  {"x_max", &options.container.max.x},
                                  {"y_min", &options.container.min.y},
                                  {"y_max", &options.container.max.y}})
    if (const auto given = settings.optional_number("domain", key)) {
      *side = *given;
      options.container_is_automatic = false;
    }
  check_aspect(settings, options.container, problems);
  if (const auto cells = settings.optional_integer("domain", "cells_x"))
    mesh.cells_x = static_cast<int>(*cells);
  if (const auto cells = settings.optional_integer("domain", "cells_y"))
    mesh.cells_y = static_cast<int>(*cells);
}

/// Exactly one of points and edge_length (with absolute sizes only the first, or none), and no edge length that asks
/// for an absurd number of points.
void read_resolution(const Settings& settings, const geometry::Box& container, meshing::MeshOptions& mesh,
                     Diagnostics& problems) {
  mesh.points = settings.optional_integer("meshing", "points");
  mesh.edge_length = settings.optional_number("meshing", "edge_length");
  const bool points = settings.is_set("meshing", "points"), length = settings.is_set("meshing", "edge_length");
  if (points && length)
    problems.add(settings.later_line("meshing", "points", "edge_length"),
                 "both 'points' and 'edge_length' are set in [meshing]; keep one of them (on the command line, "
                 "'meshing.points=' removes the value of the file)");
  if (mesh.absolute_sizes && length)
    problems.add(settings.line("meshing", "edge_length"),
                 "'edge_length' in [meshing] has no meaning with 'scale = absolute' in [sizing], because the sizes are "
                 "lengths already; leave it out, or set 'scale = fit'");
  if (!points && !length && !mesh.absolute_sizes && !settings.has_unknown_section())
    problems.add(whole_file, "set 'points' or 'edge_length' in [meshing], for example 'points = 5000'");
  const double area = container.width() * container.height();
  const double expected = mesh.edge_length ? area / (row_height * *mesh.edge_length * *mesh.edge_length) : 0;
  if (expected > most_points)
    problems.add(settings.line("meshing", "edge_length"),
                 fmt::format("'edge_length = {}' in [meshing] asks for {} points in a container of area {:.3g}; "
                             "at most {:.0e} are possible; use a larger edge_length",
                             *mesh.edge_length,
                             std::isfinite(expected) ? fmt::format("about {:.2g}", expected) : "far too many", area,
                             most_points));
}

/// The edge length is within the bounds of the size, which were read before.
void check_bounds_of_edge_length(const Settings& settings, const meshing::MeshOptions& mesh, Diagnostics& problems) {
  if (mesh.edge_length && mesh.min_size && *mesh.min_size > *mesh.edge_length)
    problems.add(settings.line("meshing", "edge_length"),
                 fmt::format("'edge_length = {}' in [meshing] is below 'min_size = {}' in [sizing]: expected at least "
                             "min_size",
                             *mesh.edge_length, *mesh.min_size));
  if (mesh.edge_length && mesh.max_size && *mesh.max_size < *mesh.edge_length)
    problems.add(settings.line("meshing", "edge_length"),
                 fmt::format("'edge_length = {}' in [meshing] is above 'max_size = {}' in [sizing]: expected at most "
                             "max_size",
                             *mesh.edge_length, *mesh.max_size));
}

constexpr std::pair<const char*, sweep::Method> methods[] = {{"distmesh", sweep::Method::distmesh},
                                                             {"cvd", sweep::Method::cvd}, // mesh files store this word
                                                             {"cvt", sweep::Method::cvd},
                                                             {"hybrid", sweep::Method::hybrid}};

/// all, largest or at X Y
void read_components(const Settings& settings, boundary::FeatureOptions& features, Diagnostics& problems) {
  const std::string text = settings.text("meshing", "components");
  const std::vector<std::string> words = split_words(text);
  if (words.size() == 1 && words[0] == "largest")
    features.components = boundary::Components::largest;
  if (words.size() == 1 && (words[0] == "largest" || words[0] == "all"))
    return;
  double x = 0, y = 0;
  const auto is_number = [](const std::string& word, double& value) {
    const char* end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value);
    return read.ec == std::errc{} && read.ptr == end && std::fabs(value) <= largest_coordinate;
  };
  if (words.size() != 3 || words[0] != "at" || !is_number(words[1], x) || !is_number(words[2], y)) {
    problems.add(settings.line("meshing", "components"),
                 fmt::format("'components = {}' in [meshing]: expected all, largest or 'at X Y', where X and Y are the "
                             "coordinates of a place in the component",
                             text));
    return;
  }
  features.components = boundary::Components::at;
  features.component_place = {x, y};
}

void read_meshing(const Settings& settings, const geometry::Box& container, meshing::MeshOptions& mesh,
                  Diagnostics& problems) {
  read_resolution(settings, container, mesh, problems);
  check_bounds_of_edge_length(settings, mesh, problems);
  for (const auto& [name, method] : methods)
    if (settings.text("meshing", "method") == name)
      mesh.method = method;
  mesh.initial_fraction = settings.optional_number("meshing", "initial_fraction");
  mesh.features.corner_angle = settings.number("meshing", "corner_angle");
  mesh.features.keep_all = settings.boolean("meshing", "keep_features");
  mesh.features.tolerance = settings.number("meshing", "feature_tolerance");
  mesh.features.within = settings.number("meshing", "simplify_within");
  if (settings.text("meshing", "connect") == "cut")
    mesh.features.connect = boundary::Connections::cut;
  read_components(settings, mesh.features, problems);
  mesh.features.max_loss = settings.optional_number("meshing", "max_loss");
  mesh.features.refine_narrow = settings.boolean("meshing", "refine_narrow");
  if (settings.text("meshing", "narrow") == "close")
    mesh.features.narrow = boundary::NarrowOutside::close;
  mesh.seed = static_cast<std::uint64_t>(settings.integer("meshing", "seed"));
  mesh.max_sweeps = static_cast<int>(settings.integer("meshing", "max_sweeps"));
  mesh.cleanup = settings.boolean("meshing", "cleanup");
  mesh.split_ears = settings.boolean("meshing", "split_ears");
  // No keys: tools for those who change the sweeps.
  mesh.star_tests = {std::getenv("TRIME_VERIFY_STARS") != nullptr, std::getenv("TRIME_STARS_BY_EMPTINESS") != nullptr,
                     std::getenv("TRIME_SLEEPLESS") != nullptr};
  mesh.worst_alpha = settings.number("meshing", "worst_alpha");
  mesh.stop_tolerance = settings.optional_number("meshing", "stop_tolerance");
}

/// The mesh from which a run starts.
void read_start_file(const Settings& settings, const fs::path& directory, RunOptions& options, Diagnostics& problems) {
  const std::string file = settings.text("meshing", "start");
  if (file == "none")
    return;
  options.start_file = (directory / file).lexically_normal().string();
  if (options.mesh.initial_fraction)
    problems.add(settings.later_line("meshing", "start", "initial_fraction"),
                 "'initial_fraction' in [meshing] has no effect with 'start', which says where the first points lie; "
                 "keep one of them");
}

/// The file, and a part that is a normalised contour.
void read_fixed_points_options(const Settings& settings, const fs::path& directory, RunOptions& options,
                               Diagnostics& problems) {
  const std::string file = settings.text("meshing", "fixed_points");
  const std::string name = settings.text("meshing", "fixed_points_normalize_with");
  if (file != "none") {
    options.fixed_points.file = (directory / file).lexically_normal().string();
    options.fixed_points.file_is_relative = fs::path(file).is_relative();
  }
  if (name == "none")
    return;
  const int line = settings.line("meshing", "fixed_points_normalize_with");
  const auto part = std::find_if(options.parts.begin(), options.parts.end(),
                                 [&](const PartOptions& candidate) { return candidate.name == name; });
  if (file == "none")
    problems.add(line, "'fixed_points_normalize_with' in [meshing] has no effect without 'fixed_points'");
  else if (part == options.parts.end())
    problems.add(line, fmt::format("'fixed_points_normalize_with = {}' in [meshing]: no part has this name{}", name,
                                   suggestion(name, settings.parts())));
  else if (part->type != "contour" || !part->normalize)
    problems.add(line, fmt::format("'fixed_points_normalize_with = {}' in [meshing]: expected a part of type contour "
                                   "with 'normalize = true'; without it, leave the key out",
                                   name));
  options.fixed_points.normalize_with = name;
}

void read_parallel(const Settings& settings, RunOptions& options) {
  options.setup_threads = static_cast<int>(settings.integer("parallel", "setup_threads"));
  options.mesh_threads = static_cast<int>(settings.integer("parallel", "mesh_threads"));
}

/// A stem that all file names of the run can begin with.
void check_name(const Settings& settings, const std::string& name, Diagnostics& problems) {
  if (name.find('/') != std::string::npos || name == "." || name == "..")
    problems.add(settings.line("output", "name"),
                 fmt::format("'name = {}' in [output]: expected the stem of a file name without a directory; set "
                             "output.directory for the directory",
                             shown(name)));
  if (name.size() > formats::longest_name)
    problems.add(settings.line("output", "name"),
                 fmt::format("'name = {}' in [output]: expected at most {} bytes, found {}. File systems allow names "
                             "of {} bytes, and the run adds endings to the name; set a shorter output.name",
                             shown(name), formats::longest_name, name.size(), io::longest_file_name));
}

/// Names that commas separate, without the blanks around them; nothing for auto, no name for none.
std::optional<std::vector<std::string>> read_open_boundary(const std::string& text) {
  if (text == "auto")
    return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t begin = 0; text != "none" && begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t", begin), end);
    if (first < end)
      names.push_back(text.substr(first, text.find_last_not_of(" \t", end - 1) + 1 - first));
    begin = end + 1;
  }
  return names;
}

void read_courant(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  options.courant.time_step = settings.optional_number("output", "time_step").value_or(0);
  options.courant.limit = settings.number("output", "courant");
  const bool has_step = options.courant.time_step > 0;
  if (has_step && settings.text("output", "depth") == "none")
    problems.add(settings.line("output", "time_step"),
                 "'time_step' in [output] needs 'depth', from which the speed of waves follows");
  if (has_step && (options.periodic_x || options.periodic_y))
    problems.add(settings.line("output", "time_step"),
                 "'time_step' in [output]: Courant numbers are not known for a periodic container; remove the key");
  // Its default is not worth a word: printed configs hold it.
  if (!has_step && settings.text("output", "courant") != find_option("output", "courant")->fallback &&
      !settings.was_refused("output", "time_step"))
    options.warnings.push_back("'courant' in [output] has no effect without 'time_step', the time step of the model");
}

void read_output(const Settings& settings, RunOptions& options, Diagnostics& problems) {
  io::MeshFileOptions& file = options.output.file;
  file.directory = settings.text("output", "directory");
  file.name = settings.text("output", "name");
  file.overwrite = settings.boolean("output", "overwrite");
  const std::int64_t interval = settings.integer("output", "interval");
  options.write = interval != 0;
  options.output.formats.clear();
  for (const std::string& word : split_list(settings.text("output", "formats")))
    options.output.formats.push_back(*formats::format_of_word(word)); // the table of options has all these words
  const auto is_refused = [](formats::Format format) { return !formats::info_of(format).holds_periodic; };
  const auto& formats = options.output.formats;
  if (options.write && (options.periodic_x || options.periodic_y) &&
      std::any_of(formats.begin(), formats.end(), is_refused))
    problems.add(settings.line("output", "formats"),
                 fmt::format("'formats = {}' in [output]: a periodic container can be written as {} only",
                             settings.text("output", "formats"),
                             formats::words_of(&formats::FormatInfo::holds_periodic, "and")));
  options.output.names.open_boundary = read_open_boundary(settings.text("output", "open_boundary"));
  options.output.names.cells = formats::cell_kind_of_word(settings.text("output", "cells"));
  for (const formats::Format format : formats)
    if (const std::string problem = formats::cells_problem(format, options.output.names.cells); !problem.empty())
      problems.add(settings.line("output", "cells"), "'cells' in [output]: " + problem);
  options.output.names.in_degrees = settings.text("output", "coordinates") == "degrees";
  for (const std::string& word : split_list(settings.text("output", "accept")))
    if (const std::optional<acceptance::Solver> solver = acceptance::solver_of_word(word))
      options.accept.push_back(*solver);
  read_courant(settings, options, problems);
  options.mesh.snapshot_interval = interval == -1 ? 0 : static_cast<int>(interval);
  options.output.steps = options.mesh.snapshot_interval != 0;
  check_name(settings, file.name, problems);
}

void read_checkpoint(const Settings& settings, CheckpointOptions& options) {
  options.interval = settings.number("checkpoint", "interval");
  options.keep = static_cast<int>(settings.integer("checkpoint", "keep"));
  if (const std::string file = settings.text("checkpoint", "stop_file"); file != "none")
    options.stop_file = file;
}

void read_log(const Settings& settings, RunOptions& options) {
  constexpr std::pair<const char*, LogLevel> levels[] = {{"debug", LogLevel::debug},     {"info", LogLevel::info},
                                                         {"summary", LogLevel::summary}, {"warning", LogLevel::warning},
                                                         {"error", LogLevel::error},     {"silent", LogLevel::silent}};
  for (const auto& [name, level] : levels)
    if (settings.text("log", "level") == name)
      options.log_level = level;
  options.log_interval = static_cast<int>(settings.integer("log", "interval"));
}

/// A contour or a mesh where a config belongs, which newcomers try.
void refuse_other_files(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  for (const char* contour : {".xy", ".geojson", ".json", ".shp", ".poly", ".msh"})
    if (ending == contour)
      throw ConfigError(
          fmt::format("{0}: expected a config, found a contour (by its ending). Name it in a config: 'file = {0}' in a "
                      "section [shape.NAME] with 'type = contour'; configs/coast.ini is an example",
                      path));
  if (ending == ".h5" || ending == ".vtkhdf")
    throw ConfigError(
        fmt::format("{0}: expected a config, found a mesh file (by its ending). 'trime_mpi info {0}' prints what it "
                    "holds, and 'trime_mpi convert {0} OUT.ENDING' writes it for other programs",
                    path));
}

} // namespace

std::string method_name(sweep::Method method) {
  for (const auto& [name, known] : methods)
    if (known == method)
      return name;
  return "";
}

RunOptions parse_config(std::string_view text, const std::string& path, const std::vector<std::string>& overrides) {
  refuse_other_files(path);
  Diagnostics problems(path);
  RunOptions options;
  IniDocument document = read_document(text, overrides, problems, options.warnings);
  if (!document.find("output", "name")) {
    const std::string stem = fs::path(path).stem().string();
    document.entries.push_back({"output", "name", stem.empty() ? "mesh" : stem, whole_file});
  }
  const Settings settings(document, problems);
  read_domain(settings, options, problems);
  read_shape_options(settings, fs::path(path).parent_path(), options, problems);
  read_formulas(settings, fs::path(path).parent_path(), options, problems);
  read_sizing(settings, options, problems);
  read_meshing(settings, options.container, options.mesh, problems);
  read_start_file(settings, fs::path(path).parent_path(), options, problems);
  read_fixed_points_options(settings, fs::path(path).parent_path(), options, problems);
  read_parallel(settings, options);
  read_output(settings, options, problems);
  read_checkpoint(settings, options.checkpoint);
  read_log(settings, options);
  problems.throw_if_any();
  options.resolved = settings.resolved(fs::path(path).parent_path().string());
  return options;
}

} // namespace trime::app
