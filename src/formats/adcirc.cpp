// SPDX-License-Identifier: BSD-3-Clause
// fort.14 of ADCIRC (user's manual, "ADCIRC Grid and Boundary Information File"), which other coastal models read too,
// and hgrid.gr3 of SCHISM (manual, "Horizontal grid"), which has nearly the same lines. Boundary segments go by the
// names of the parts. A part that is not open is land: an island where it goes round a hole, mainland elsewhere. Curves
// that are split are land too; those with a height are weirs in fort.14, and land in hgrid.gr3, which has no weirs.
#include "formats/degrees.hpp"
#include "formats/node_strings.hpp"
#include "formats/open_boundary.hpp"

#include <fmt/format.h>

namespace trime::formats {
namespace {

constexpr int weir = 24; // in fort.14: between two points, with a height and coefficients

/// Says what the two formats do differently.
struct Dialect {
  const char* word;
  int mainland, island; ///< in fort.14 with the natural condition of no flow
  bool repeats_first;   ///< whether a ring has its first point at the end, too
  bool has_weirs;
};
constexpr Dialect fort14{"fort14", 20, 21, true, true}, gr3{"gr3", 0, 1, false, false};

struct Group {
  bool repeats_first;
  std::string text{};
  std::int64_t segments = 0, points = 0;

  void add(const NodeString& string, const std::string& head, const std::string& name) {
    const std::size_t count = string.points.size() + (string.is_closed && repeats_first ? 1 : 0);
    text += fmt::format("{}{} = {}\n", count, head, name);
    for (std::size_t k = 0; k < count; ++k)
      text += fmt::format("{}\n", string.points[k % string.points.size()] + 1);
    ++segments;
    points += static_cast<std::int64_t>(count);
  }
  /// A weir counts its points on both sides.
  void add(const PairString& string, const std::string& name, const geometry::CurveKind& kind) {
    text += fmt::format("{} {} = {}\n", string.pairs.size(), weir, name);
    for (const auto& [left, right] : string.pairs)
      text += fmt::format("{} {} {} {} {}\n", left + 1, right + 1, *kind.weir_height, kind.weir_subcritical,
                          kind.weir_supercritical);
    ++segments;
    points += 2 * std::ssize(string.pairs);
  }
};

/// The kind of the curve with this label of an edge; nothing for a part of the boundary.
const geometry::CurveKind* kind_of(std::int64_t label, const Names& names) {
  const auto curve = static_cast<std::size_t>(label - 1) - names.parts.size();
  return static_cast<std::size_t>(label) > names.parts.size() && curve < names.curve_kinds.size()
             ? &names.curve_kinds[curve]
             : nullptr;
}

std::string boundary_text(const std::vector<NodeString>& strings, const std::vector<PairString>& pairs,
                          const ExchangeMesh& mesh, const Dialect& dialect) {
  const Names& names = mesh.names();
  const std::vector<bool> is_open = open_parts(names);
  Group open{dialect.repeats_first}, land{dialect.repeats_first};
  for (const NodeString& string : strings) {
    const auto part = static_cast<std::size_t>(string.label - 1);
    const std::string& name = mesh.line_names()[part];
    if (const geometry::CurveKind* kind = kind_of(string.label, names);
        dialect.has_weirs && kind != nullptr && kind->weir_height)
      continue;
    if (part < is_open.size() && is_open[part])
      open.add(string, "", name);
    else
      land.add(string, fmt::format(" {}", string.is_island ? dialect.island : dialect.mainland), name);
  }
  for (const PairString& string : pairs)
    if (const auto label = static_cast<std::int64_t>(names.parts.size()) + string.curve + 1;
        dialect.has_weirs && kind_of(label, names) != nullptr && kind_of(label, names)->weir_height)
      land.add(string, names.curves[static_cast<std::size_t>(string.curve)], *kind_of(label, names));
  return fmt::format("{} = open boundaries\n{} = points on them\n{}{} = land boundaries\n{} = points on them\n{}",
                     open.segments, open.points, open.text, land.segments, land.points, land.text);
}

std::vector<FilePlan> plan(const ExchangeMesh& mesh, const std::string& path, const Dialect& dialect) {
  const std::string& title = mesh.names().regions.size() == 1 ? mesh.names().regions[0] : path;
  return {{path,
           {mesh.once(fmt::format("{}\n{} {}\n", title, mesh.triangles(), mesh.points())),
            numbered_points(mesh, {"", dialect.word, Height::depth}),
            mesh.triangle_rows([](std::int64_t, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
              append_line(to, id + 1, std::int64_t{3}, corners[0] + 1, corners[1] + 1, corners[2] + 1);
            }),
            mesh.once(boundary_text(node_strings(mesh), pair_strings(mesh), mesh, dialect))}}};
}

} // namespace

std::vector<FilePlan> plan_adcirc(const ExchangeMesh& mesh, const std::string& path) {
  return plan(mesh, path, fort14);
}

std::vector<FilePlan> plan_schism(const ExchangeMesh& mesh, const std::string& path) {
  return plan(mesh, path, gr3);
}

} // namespace trime::formats
