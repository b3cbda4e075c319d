// SPDX-License-Identifier: BSD-3-Clause
#include "trime/formats/exchange.hpp"

#include "comm/agree.hpp"
#include "formats/exchange_mesh.hpp"
#include "formats/solver_names.hpp"
#include "io/temporary_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <string_view>

namespace trime::formats {
namespace {

constexpr FormatInfo table[] = {
    {Format::vtkhdf, "vtkhdf", ".vtkhdf", true, true},
    {Format::xdmf, "xdmf", ".xdmf", true, true},
    {Format::text, "text", "", true, true},
    {Format::gmsh, "gmsh", ".msh", false, true, plan_gmsh},
    {Format::gmsh2, "gmsh2", ".msh2", false, false, plan_gmsh2},
    {Format::medit, "medit", ".mesh", false, false, plan_medit},
    {Format::freefem, "freefem", ".freefem", false, false, plan_freefem},
    {Format::triangle, "triangle", ".node", false, false, plan_triangle},
    {Format::vtu, "vtu", ".vtu", false, true, plan_vtu},
    {Format::voronoi, "voronoi", "_cells.vtu", true, true, plan_voronoi},
    {Format::disv, "disv", ".disv", false, true, plan_disv},
    {Format::uge, "uge", ".uge", false, true, plan_uge},
    {Format::sms, "2dm", ".2dm", false, false, plan_sms},
    {Format::adcirc, "fort14", ".14", false, false, plan_adcirc},
    {Format::schism, "gr3", ".gr3", false, false, plan_schism},
    {Format::telemac, "slf", ".slf", false, false, plan_telemac},
    {Format::fvcom, "fvcom", "_grd.dat", false, false, plan_fvcom},
    {Format::su2, "su2", ".su2", false, false, plan_su2},
    {Format::geojson, "geojson", ".geojson", false, true, plan_geojson},
    {Format::abaqus, "abaqus", ".inp", false, false, plan_abaqus},
    {Format::exodus, "exodus", ".exo", false, true, plan_exodus},
    {Format::ugrid, "ugrid", ".nc", false, true, plan_ugrid},
    {Format::ugrid_cells, "ugrid_cells", "_cells.nc", false, true, plan_ugrid_cells},
    {Format::mpas, "mpas", "_mpas.nc", true, true, plan_mpas},
    {Format::tough, "tough", ".tough", false, true, plan_tough},
};

/// Numbers of MSH 2.2 have 32 bits, as have those of most programs that read the text formats.
void check_fits(const FormatInfo& format, const mesh::DistributedMesh& mesh, const Names& with) {
  if (!format.holds_periodic && (with.period.x != 0 || with.period.y != 0))
    throw ConfigError(fmt::format("the format '{}' cannot hold a periodic mesh; found one with the periods {:.9g} and "
                                  "{:.9g} (0: not periodic); use {}",
                                  format.word, with.period.x, with.period.y,
                                  words_of(&FormatInfo::holds_periodic, "or")));
  if (const std::string problem = cells_problem(format.format, with.cells); !problem.empty())
    throw ConfigError(problem);
  constexpr GlobalId most = std::numeric_limits<std::int32_t>::max();
  const GlobalId triangles = mesh.triangle_slab.total, facets = mesh.facet_slab.total;
  const GlobalId elements = format.format == Format::triangle
                                ? (3 * triangles + facets) / 2 // in .edge
                                : triangles + facets + mesh.curve_slab.total + mesh.interface_slab.total;
  if (!format.has_long_ids && elements > most)
    throw ConfigError(fmt::format("the format '{}' counts with 32 bits: expected at most {} triangles and edges, found "
                                  "{}; use {}",
                                  format.word, most, elements, words_of(&FormatInfo::has_long_ids, "or")));
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The path of the first file without the ending of the format.
std::string stem_of(const FormatInfo& format, const std::string& path) {
  return ends_with(path, format.ending) ? path.substr(0, path.size() - std::string_view(format.ending).size()) : path;
}

/// The file of FVCOM with the latitudes of the points.
std::string latitudes_of(const std::string& stem) {
  return stem + "_cor.dat";
}

/// Rank 0 removes them before the first new file appears: a model does not start without a file that it needs, but it
/// would run with one of another mesh. Collective.
void remove_stale(const std::vector<std::string>& paths, const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      for (const std::string& path : paths)
        if (unlink(path.c_str()) != 0 && errno != ENOENT)
          throw FileError(
              fmt::format("{} belongs to another mesh and cannot be removed: {}", path, io::system_error()));
  });
}

} // namespace

std::span<const FormatInfo> all_formats() {
  return table;
}

const FormatInfo& info_of(Format format) {
  return *std::find_if(std::begin(table), std::end(table), [&](const FormatInfo& row) { return row.format == format; });
}

std::optional<Format> format_of_word(const std::string& word) {
  for (const FormatInfo& row : table)
    if (word == row.word)
      return row.format;
  return {};
}

CellKind cell_kind_of_word(const std::string& word) {
  return word == "whole" ? CellKind::whole : word == "triangles" ? CellKind::triangles : CellKind::voronoi;
}

std::string cells_problem(Format format, CellKind kind) {
  const bool is_flow = format == Format::disv || format == Format::uge || format == Format::tough;
  if (is_flow && kind == CellKind::whole)
    return fmt::format("the format '{}' has the cells 'voronoi' or 'triangles', found 'whole'", info_of(format).word);
  if (format == Format::mpas && kind == CellKind::triangles)
    return "the format 'mpas' has the cells 'voronoi' or 'whole', found 'triangles'";
  return {};
}

std::optional<Format> format_of_path(const std::string& path) {
  const FormatInfo* found = nullptr; // with the longest ending
  for (const FormatInfo& row : table)
    if (row.plan && ends_with(path, row.ending) &&
        (!found || std::string_view(row.ending).size() > std::string_view(found->ending).size()))
      found = &row;
  return found ? std::optional(found->format) : std::nullopt;
}

std::string words_of(bool FormatInfo::*property, const char* last) {
  std::vector<std::string> words;
  for (const FormatInfo& row : table)
    if (row.*property)
      words.emplace_back(row.word);
  const std::string end = words.back();
  words.pop_back();
  return fmt::format("{} {} {}", fmt::join(words, ", "), last, end);
}

std::vector<std::string> paths_of(Format format, const std::string& path, const Names& names) {
  const std::string stem = stem_of(info_of(format), path);
  if (format == Format::triangle)
    return {stem + ".node", stem + ".ele", stem + ".edge"};
  std::vector<std::string> paths{path};
  if (format == Format::telemac)
    paths.push_back(stem + ".cli");
  if (format == Format::fvcom) {
    paths.insert(paths.end(), {stem + "_dep.dat", stem + "_obc.dat"});
    if (!names.crs.empty())
      paths.push_back(latitudes_of(stem));
  }
  if (format == Format::disv)
    paths.push_back(stem + ".zones");
  if (format == Format::mpas)
    paths.push_back(stem + "_graph.info");
  if (format == Format::uge)
    for (const std::string& part : solver_names(names.parts))
      paths.push_back(stem + "_" + part + ".ex");
  if (format == Format::disv || format == Format::uge || format == Format::tough)
    paths.push_back(fmt::format("{}_{}.csv", stem, info_of(format).word));
  return paths;
}

std::vector<std::string> stale_paths(Format format, const std::string& path, const Names& names) {
  if (format != Format::fvcom || !names.crs.empty())
    return {};
  return {latitudes_of(stem_of(info_of(format), path))};
}

std::vector<std::string> touched_paths(Format format, const std::string& path, const Names& names) {
  std::vector<std::string> paths = paths_of(format, path, names);
  for (const std::string& stale : stale_paths(format, path, names))
    paths.push_back(stale);
  return paths;
}

Exported write(Format format, const std::string& path, const mesh::DistributedMesh& mesh, const Names& with,
               io::RunFiles* files, const comm::Communicator& comm) {
  const FormatInfo& info = info_of(format);
  check_fits(info, mesh, with); // all ranks find the same
  const ExchangeMesh exchange(mesh, with, comm);
  io::FileSet written;
  Exported made{paths_of(format, path, with)};
  const std::vector<FilePlan> plans = info.plan(exchange, path);
  remove_stale(stale_paths(format, path, with), comm);
  for (const FilePlan& file : plans) {
    comm::run_agreed(comm, [&] {
      if (comm.is_root())
        written.add(file.path);
    });
    io::write_text_rows(file.path, file.rows, files, comm);
    made.checks.insert(made.checks.end(), file.checks.begin(), file.checks.end());
    made.summary += file.summary;
    made.warning += file.warning;
  }
  written.complete();
  return made;
}

} // namespace trime::formats
