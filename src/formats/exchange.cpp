// SPDX-License-Identifier: BSD-3-Clause
#include "trime/formats/exchange.hpp"

#include "comm/agree.hpp"
#include "formats/exchange_mesh.hpp"
#include "io/temporary_file.hpp"

#include <algorithm>
#include <limits>

namespace trime::formats {
namespace {

constexpr FormatName names[] = {
    {Format::gmsh, "gmsh", ".msh"},
    {Format::gmsh2, "gmsh2", ".msh2"},
    {Format::medit, "medit", ".mesh"},
    {Format::freefem, "freefem", ".freefem"},
    {Format::triangle, "triangle", ".node"},
    {Format::vtu, "vtu", ".vtu"},
    {Format::sms, "2dm", ".2dm"},
    {Format::adcirc, "fort14", ".14"},
    {Format::geojson, "geojson", ".geojson"},
};

const FormatName& name_of(Format format) {
  return *std::find_if(std::begin(names), std::end(names), [&](const FormatName& n) { return n.format == format; });
}

/// Numbers of MSH 2.2 have 32 bits, as have those of most programs that read the text formats.
void check_fits(Format format, const mesh::DistributedMesh& mesh, const Names& with) {
  const char* word = name_of(format).word;
  if (with.period.x != 0 || with.period.y != 0)
    throw ConfigError(fmt::format("the format '{}' cannot hold a periodic mesh; found one with the periods {:.9g} and "
                                  "{:.9g} (0: not periodic); use vtkhdf, xdmf or text",
                                  word, with.period.x, with.period.y));
  constexpr GlobalId most = std::numeric_limits<std::int32_t>::max();
  const GlobalId triangles = mesh.triangle_slab.total, facets = mesh.facet_slab.total;
  const GlobalId elements = format == Format::triangle ? (3 * triangles + facets) / 2 : triangles + facets; // .edge
  if (format != Format::gmsh && format != Format::vtu && format != Format::geojson && elements > most)
    throw ConfigError(fmt::format("the format '{}' counts with 32 bits: expected at most {} triangles and edges, found "
                                  "{}; use gmsh, vtu, vtkhdf or xdmf",
                                  word, most, elements));
}

std::vector<FilePlan> plan(Format format, const ExchangeMesh& mesh, const std::string& path) {
  switch (format) {
  case Format::gmsh:
    return plan_gmsh(mesh, path);
  case Format::gmsh2:
    return plan_gmsh2(mesh, path);
  case Format::medit:
    return plan_medit(mesh, path);
  case Format::freefem:
    return plan_freefem(mesh, path);
  case Format::triangle:
    return plan_triangle(mesh, path);
  case Format::vtu:
    return plan_vtu(mesh, path);
  case Format::sms:
    return plan_sms(mesh, path);
  case Format::adcirc:
    return plan_adcirc(mesh, path);
  case Format::geojson:
    return plan_geojson(mesh, path);
  }
  return {};
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

} // namespace

std::span<const FormatName> all_formats() {
  return names;
}

std::optional<Format> format_of_word(const std::string& word) {
  for (const FormatName& name : names)
    if (word == name.word)
      return name.format;
  return {};
}

std::optional<Format> format_of_path(const std::string& path) {
  for (const FormatName& name : names)
    if (ends_with(path, name.ending))
      return name.format;
  return {};
}

std::vector<std::string> paths_of(Format format, const std::string& path) {
  if (format != Format::triangle)
    return {path};
  const std::string stem = ends_with(path, ".node") ? path.substr(0, path.size() - 5) : path;
  return {stem + ".node", stem + ".ele", stem + ".edge"};
}

std::vector<std::string> write(Format format, const std::string& path, const mesh::DistributedMesh& mesh,
                               const Names& with, io::RunFiles* files, const comm::Communicator& comm) {
  check_fits(format, mesh, with); // all ranks find the same
  const ExchangeMesh exchange(mesh, with, comm);
  io::FileSet written;
  for (const FilePlan& file : plan(format, exchange, path)) {
    comm::run_agreed(comm, [&] {
      if (comm.is_root())
        written.add(file.path);
    });
    io::write_text_rows(file.path, file.rows, files, comm);
  }
  written.complete();
  return paths_of(format, path);
}

} // namespace trime::formats
