// SPDX-License-Identifier: BSD-3-Clause
#include "app/convert.hpp"

#include "core/quoted.hpp"
#include "formats/open_boundary.hpp"
#include "formats/output_files.hpp"
#include "io/split_counts.hpp"
#include "record/groups.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace trime::app {
namespace {

using io::Metadata;

/// A value as words, or nothing if the file has none.
std::string value_text(const Metadata& metadata, const std::string& name) {
  for (const io::Attribute& attribute : metadata.attributes)
    if (attribute.name == name)
      return std::visit([](const auto& value) { return fmt::format("{}", value); }, attribute.value);
  return {};
}

formats::Names names_of(const Metadata& metadata) {
  formats::Names names{io::column_of<std::string>(metadata, "tags", "part_name"),
                       io::column_of<std::string>(metadata, "tags", "region_name"),
                       io::curve_names(metadata),
                       io::interface_names(metadata),
                       {io::attribute_of<double>(metadata, "period_x"), io::attribute_of<double>(metadata, "period_y")},
                       value_text(metadata, "crs")};
  names.curve_kinds = record::curve_kinds(metadata);
  names.open_boundary = record::open_boundary_of(metadata);
  return names;
}

formats::Format format_of_output(const std::string& path) {
  if (const auto format = formats::format_of_path(path))
    return *format;
  std::string endings;
  for (const formats::FormatInfo& info : formats::all_formats())
    if (info.plan)
      endings += fmt::format("{}{} ({})", endings.empty() ? "" : ", ", info.ending, info.word);
  throw ConfigError(fmt::format("the ending of '{}' is not that of a format: expected {}", shown(path), endings));
}

bool is_marked(const Metadata& metadata) {
  return io::attribute_of<std::int64_t>(metadata, "complete") == 0;
}

std::string made_text(const Metadata& metadata) {
  std::string text;
  for (const auto& [what, name] : {std::pair{"made", "created_utc"},
                                   {"by trime_mpi", "program_version"},
                                   {"command", "command_line"},
                                   {"method", "method"},
                                   {"stopped", "stop_reason"},
                                   {"refined from", "refined_from"},
                                   {"crs", "crs"}})
    if (const std::string value = value_text(metadata, name); !value.empty())
      text += fmt::format("{:<13} {}\n", what, value);
  return text;
}

template <class T>
const std::vector<T>& tags(const Metadata& metadata, const char* name) {
  return io::column_of<T>(metadata, "tags", name);
}

/// Row k of a column that has as many rows as another one of its table. @throws FileError if it has not
template <class T>
const T& row(const Metadata& metadata, const char* group, const char* name, std::size_t k) {
  const std::vector<T>& column = io::column_of<T>(metadata, group, name);
  if (k >= column.size())
    throw FileError(fmt::format("/trime_mpi/{}/{} has {} rows, but other columns of the same table have more: expected "
                                "columns of equal length; the file is damaged",
                                group, name, column.size()));
  return column[k];
}

/// How many entries of each list are printed: a mesh may have thousands of regions.
class ListLimit {
public:
  explicit ListLimit(bool prints_all) : most_(prints_all ? std::numeric_limits<std::size_t>::max() : 20) {}

  /// Returns how many entries of a list of this length are printed.
  std::size_t of(std::size_t length) {
    is_reached_ = is_reached_ || length > most_;
    return std::min(length, most_);
  }
  /// Returns what follows behind a list of this length: nothing if all of it is printed.
  std::string more(std::size_t length, const char* before, const char* after) const {
    return length > most_ ? fmt::format("{}and {} more{}", before, length - most_, after) : "";
  }
  bool is_reached() const { return is_reached_; } ///< whether a list was longer

private:
  std::size_t most_;
  bool is_reached_ = false;
};

/// Labels of edges, which follow those of the names before.
std::string labels_text(const char* edges, const std::vector<std::string>& names, std::size_t before,
                        ListLimit& limit) {
  std::string text = fmt::format("labels of {} in other formats:", edges);
  for (std::size_t k = 0; k < limit.of(names.size()); ++k)
    text += fmt::format("{} {} {}", k == 0 ? "" : ",", before + k + 1, names[k]);
  return text + limit.more(names.size(), ", ", "") + "\n";
}

/// The loops of each name together: a coast may have thousands of islands.
std::string boundary_text(const Metadata& metadata, ListLimit& limit) {
  struct Loops {
    std::int64_t count = 0, edges = 0;
    double length = 0;
  };
  std::map<std::pair<std::string, std::string>, Loops> named;
  const auto& names = tags<std::string>(metadata, "edge_name");
  for (std::size_t k = 0; k < names.size(); ++k) {
    Loops& loops = named[{names[k], row<std::string>(metadata, "tags", "edge_kind", k)}];
    ++loops.count;
    loops.edges += row<std::int64_t>(metadata, "tags", "edge_count", k);
    loops.length += row<double>(metadata, "tags", "edge_length_sum", k);
  }
  std::string text = "\nboundary      kind    loops      edges  length\n";
  std::size_t left = limit.of(named.size());
  for (auto row = named.begin(); left > 0; ++row, --left)
    text += fmt::format("{:<13} {:<7} {:>5} {:>10}  {:.6g}\n", row->first.first, row->first.second, row->second.count,
                        row->second.edges, row->second.length);
  text += limit.more(named.size(), "", "\n");
  const auto& parts = tags<std::string>(metadata, "part_name");
  text += labels_text("boundary edges", parts, 0, limit);
  std::vector<std::string> inner = io::curve_names(metadata);
  for (const std::string& name : io::interface_names(metadata))
    inner.push_back(name);
  return inner.empty() ? text : text + labels_text("edges inside", inner, parts.size(), limit);
}

/// Numbers of the regions and what they hold; nothing if the mesh has one region.
std::string regions_text(const Metadata& metadata, ListLimit& limit) {
  if (!io::has_regions(metadata))
    return {};
  const bool has_counts = io::find_group(metadata, "regions") != nullptr; // a file of the library may lack it
  std::string text = fmt::format("\nregion                 number{}\n", has_counts ? "  triangles  area" : "");
  const auto& names = tags<std::string>(metadata, "region_name");
  for (std::size_t k = 0; k < limit.of(names.size()); ++k) {
    text += fmt::format("{:<21} {:>7}", names[k], row<std::int32_t>(metadata, "tags", "region_id", k));
    if (has_counts)
      text += fmt::format(" {:>10}  {:.6g}", row<std::int64_t>(metadata, "regions", "triangles", k),
                          row<double>(metadata, "regions", "area", k));
    text += "\n";
  }
  return text + limit.more(names.size(), "", "\n");
}

/// Returns the table of the areas that regions lost to each other; an empty text if the file has none.
std::string losses_text(const Metadata& metadata, ListLimit& limit) {
  const char* table = "region_losses";
  if (!io::find_group(metadata, table))
    return {};
  const auto& names = tags<std::string>(metadata, "region_name");
  const auto name_of = [&](const char* column, std::size_t k) {
    const auto region = static_cast<std::size_t>(row<std::int32_t>(metadata, table, column, k));
    return region >= 1 && region <= names.size() ? names[region - 1] : std::to_string(region);
  };
  std::string text = "\nlost by               gained by             reason       places  area\n";
  const std::size_t rows = io::column_of<std::string>(metadata, table, "reason").size();
  for (std::size_t k = 0; k < limit.of(rows); ++k)
    text += fmt::format("{:<21} {:<21} {:<11} {:>7}  {:.6g}, the largest at ({:.9g}, {:.9g})\n", name_of("loser", k),
                        name_of("winner", k), row<std::string>(metadata, table, "reason", k),
                        row<std::int64_t>(metadata, table, "places", k), row<double>(metadata, table, "area", k),
                        row<double>(metadata, table, "largest_x", k), row<double>(metadata, table, "largest_y", k));
  return text + limit.more(rows, "", "\n");
}

/// Returns a line about curves that are split; an empty text if there is no such curve.
std::string splits_text(const io::SplitCounts& splits) {
  if (splits.pairs == 0)
    return {};
  return fmt::format("\nsplit curves  {} pairs of points on {} path{}; {} {}\n", splits.pairs, splits.paths,
                     splits.paths == 1 ? "" : "s", splits.copies,
                     splits.copies == 1 ? "point is a copy of another one" : "points are copies of others");
}

std::string checks_text(const Metadata& metadata) {
  if (!io::find_group(metadata, "checks"))
    return "\nno checks: this mesh is an intermediate step of a run\n";
  const auto& names = io::column_of<std::string>(metadata, "checks", "name");
  std::string failed;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (row<std::int32_t>(metadata, "checks", "passed", k) == 0)
      failed += " " + names[k];
  return failed.empty() ? fmt::format("\nall {} checks passed\n", names.size())
                        : fmt::format("\nof the {} checks of the mesh, these FAILED:{}\n", names.size(), failed);
}

std::string quality_text(const Metadata& metadata) {
  const io::MetadataGroup* quality = io::find_group(metadata, "quality");
  if (!quality)
    return {};
  std::string text = "\n";
  for (const auto& [what, name] : {std::pair{"alpha median", "alpha_median"},
                                   {"alpha mean", "alpha_mean"},
                                   {"alpha max", "alpha_max"},
                                   {"smallest angle", "min_angle_degrees"},
                                   {"shortest edge", "shortest_edge"},
                                   {"size error mean", "size_mean"}})
    for (const io::Attribute& attribute : quality->attributes)
      if (attribute.name == name && std::holds_alternative<double>(attribute.value))
        text += fmt::format("{:<15} {:.5g}\n", what, std::get<double>(attribute.value));
  for (const io::Attribute& attribute : quality->attributes)
    if (attribute.name == "obtuse_triangles" && std::holds_alternative<std::int64_t>(attribute.value))
      text += fmt::format("{:<15} {}\n", "obtuse", std::get<std::int64_t>(attribute.value));
  return text;
}

template <class T>
T value_of(const io::MetadataGroup& group, const char* name) {
  for (const io::Attribute& attribute : group.attributes)
    if (attribute.name == name)
      if (const T* value = std::get_if<T>(&attribute.value))
        return *value;
  throw FileError(
      fmt::format("/trime_mpi/{} has no attribute '{}' of the expected type; the file is damaged", group.name, name));
}

/// Which parts of the boundary are open in files for coastal models; nothing if none is.
std::string open_boundary_text(const Metadata& metadata) {
  const formats::Names names = names_of(metadata);
  const std::vector<bool> open = formats::open_parts(names);
  if (std::ranges::find(open, true) == open.end())
    return {};
  std::string text;
  for (std::size_t part = 0; part < open.size(); ++part)
    if (open[part])
      text += (text.empty() ? "open boundary " : ", ") + names.parts[part];
  return text + "\n";
}

/// The Courant numbers; nothing if the run asked for none, or came before their triangles were counted.
std::string courant_text(const Metadata& metadata) {
  const io::MetadataGroup* courant = io::find_group(metadata, "courant");
  if (courant == nullptr ||
      std::ranges::find(courant->attributes, "dry", &io::Attribute::name) == courant->attributes.end())
    return {};
  const auto dry = value_of<std::int64_t>(*courant, "dry"), wet = value_of<std::int64_t>(*courant, "triangles") - dry;
  std::string text = fmt::format("Courant         time step {:g} s: ", value_of<double>(*courant, "time_step"));
  if (wet > 0)
    text += fmt::format("{} of {} wet triangles above {:g}, the largest {:.3g} at ({:.9g}, {:.9g}); ",
                        value_of<std::int64_t>(*courant, "above"), wet, value_of<double>(*courant, "limit"),
                        value_of<double>(*courant, "largest"), value_of<double>(*courant, "largest_x"),
                        value_of<double>(*courant, "largest_y"));
  return text + fmt::format("{} triangles without a positive depth\n", dry);
}

/// The depths and the Courant numbers that follow from them; nothing if the run asked for none.
std::string depth_text(const Metadata& metadata) {
  std::string text;
  if (const io::MetadataGroup* depth = io::find_group(metadata, "depth")) {
    const auto least = value_of<double>(*depth, "least"), most = value_of<double>(*depth, "most");
    text += least <= most ? fmt::format("\ndepths          from {:.6g} to {:.6g}", least, most)
                          : "\ndepths          none is a number";
    text += fmt::format(", positive at {} of {} points\n", value_of<std::int64_t>(*depth, "positive"),
                        value_text(metadata, "points"));
  }
  return text + courant_text(metadata);
}

/// The rules of models; nothing if the run asked for none.
std::string accept_text(const Metadata& metadata) {
  const char* table = "accept";
  if (!io::find_group(metadata, table))
    return {};
  std::string text = "\naccept   rule                  limit        worst        broken\n";
  const auto& solvers = io::column_of<std::string>(metadata, table, "solver");
  for (std::size_t k = 0; k < solvers.size(); ++k)
    text += fmt::format(
        "{:<8} {:<21} {:<2} {:<9.4g} {:<12.6g} {} of {}{}\n", solvers[k], row<std::string>(metadata, table, "rule", k),
        row<std::int32_t>(metadata, table, "is_least", k) != 0 ? ">=" : "<=", row<double>(metadata, table, "limit", k),
        row<double>(metadata, table, "worst", k), row<std::int64_t>(metadata, table, "broken", k),
        row<std::int64_t>(metadata, table, "measured", k),
        row<std::int64_t>(metadata, table, "broken", k) > 0 && row<std::int32_t>(metadata, table, "refuses", k) != 0
            ? ", REFUSED"
            : "");
  return text;
}

/// How many points have each of several sizes as the smallest one; nothing if there is one size.
std::string sizes_text(const Metadata& metadata) {
  if (!io::find_group(metadata, "sizes"))
    return {};
  std::string text = "\nsmallest size   points\n";
  const auto& names = io::column_of<std::string>(metadata, "sizes", "name");
  for (std::size_t k = 0; k < names.size(); ++k)
    text += fmt::format("{:<15} {}\n", names[k], row<std::int64_t>(metadata, "sizes", "points", k));
  return text;
}

} // namespace

ExitCode convert(const CommandLine& line, io::RunFiles* files, const comm::Communicator& comm, Log& log) {
  const std::string &from = line.files[0], &to = line.files[1];
  const formats::Format format = format_of_output(to);
  const auto refuse = [&](const formats::Names& with) {
    formats::refuse_to_replace(formats::touched_paths(format, to, with), line.overwrite,
                               "add --overwrite to replace it", comm);
  };
  refuse({}); // before the file is read
  const Metadata metadata = io::read_metadata(from, {"tags", "curves", "interfaces"}, comm);
  formats::Names names = names_of(metadata);
  refuse(names);
  names.in_degrees = line.in_degrees;
  names.cells = formats::cell_kind_of_word(line.cells);
  const mesh::DistributedMesh mesh = io::read_mesh(from, metadata, comm);
  if (is_marked(metadata))
    log.warning("{} holds a mesh that is NOT complete, see 'trime_mpi info {}'", from, from);
  const formats::Exported made = formats::write(format, to, mesh, names, files, comm);
  for (const std::string& path : made.paths)
    log.info("{}: {} points, {} triangles, {} boundary edges", path, mesh.point_slab.total, mesh.triangle_slab.total,
             mesh.facet_slab.total);
  print_cells(made, log);
  if (!made.warning.empty())
    log.warning("{}", made.warning);
  return mesh::all_passed(made.checks) ? ExitCode::done : ExitCode::incomplete;
}

void print_cells(const formats::Exported& made, Log& log) {
  if (made.checks.empty())
    return;
  log.summary("{}", made.summary);
  for (const mesh::Check& check : made.checks)
    if (!check.passed)
      log.warning("the Voronoi cells are NOT right: check {} FAILED: expected {:.15g}, found {:.15g} ({})", check.name,
                  check.expected, check.found, check.meaning);
}

std::string info(const std::string& path, bool prints_all, const comm::Communicator& comm) {
  const Metadata metadata = io::read_metadata(path,
                                              {"checks", "quality", "tags", "curves", "interfaces", "regions",
                                               "region_losses", "depth", "courant", "accept", "sizes"},
                                              comm);
  std::string text = fmt::format("{}: {} points, {} triangles{}\n", path, value_text(metadata, "points"),
                                 value_text(metadata, "triangles"), is_marked(metadata) ? "; NOT complete" : "");
  text += made_text(metadata);
  if (const formats::Names names = names_of(metadata); names.period.x != 0 || names.period.y != 0)
    text += fmt::format("periodic      with sides of {:.9g} and {:.9g} (0: not periodic)\n", names.period.x,
                        names.period.y);
  ListLimit limit(prints_all);
  text += boundary_text(metadata, limit) + open_boundary_text(metadata);
  text += splits_text(io::count_splits(path, comm)) + regions_text(metadata, limit);
  text += losses_text(metadata, limit) + checks_text(metadata) + quality_text(metadata) + sizes_text(metadata) +
          depth_text(metadata) + accept_text(metadata);
  if (limit.is_reached())
    text += fmt::format("\n'trime_mpi info {} --all' prints whole lists\n", path);
  return text + fmt::format("\nmesh hash     {}\n", value_text(metadata, "mesh_hash_hex"));
}

} // namespace trime::app
