// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"

#include "config_text.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

namespace trime_check {
namespace {

constexpr double format_version = 1, cell_dim = 2, cell_corners = 3;
// [h asked for] The boundary strays so far from its facets, at most: what the certificate says of chords.
constexpr double chord = 0.75;
// Relative tolerance of areas: both sides are sums of many terms.
constexpr double area_tolerance = 1e-9;

/// Attributes and views by which other programs know what the file is.
void check_format(const StoredFile& file, const Mesh& mesh, Report& report) {
  Tally wrong;
  const auto expect = [&](const std::string& object, const std::string& attribute, const std::vector<double>& values) {
    if (file.numbers(object, attribute) != values)
      wrong.note([&] { return fmt::format("attribute {} of {} is not {}", attribute, object, values[0]); });
  };
  const auto expect_view = [&](const std::string& name, bool is_there, bool wanted) {
    if (is_there != wanted)
      wrong.note([&] {
        return fmt::format("{} is {}, according to the key `formats` of the config", name,
                           wanted ? "missing" : "too much");
      });
  };
  expect("/trime_mpi", "format_version", {format_version});
  if (mesh.has_vtk) {
    expect("/VTKHDF", "Version", {1, 0});
    if (file.text_attribute("/VTKHDF", "Type") != "UnstructuredGrid")
      wrong.note([] { return std::string("attribute Type of /VTKHDF is not UnstructuredGrid"); });
  }
  if (mesh.has_plain) {
    expect("/Mesh/mesh/topology", "cell_dim", {cell_dim});
    expect("/Mesh/mesh/topology", "cell_corners", {cell_corners});
  }
  for (const char* link : {"/geometry/vertices", "/viz/topology/cells"})
    expect_view(link, file.has(link), mesh.has_plain);
  const ConfigText config(file.text("/trime_mpi/config_resolved"), "");
  const std::string formats = fmt::format(" {} ", config.value("output", "formats"));
  if (formats.find_first_not_of(' ') != std::string::npos) {
    const bool vtk = formats.find(" vtkhdf ") != std::string::npos;
    expect_view("/VTKHDF", mesh.has_vtk, vtk);
    expect_view("/Mesh/mesh", mesh.has_plain, !vtk || formats.find(" xdmf ") != std::string::npos);
  }
  report.none("format", wrong, "arrays and attributes for other programs that are missing or wrong");
}

/// Labels, markers and regions, by the table of what they mean.
void check_labels(const StoredFile& file, const Mesh& mesh, Report& report) {
  const std::vector<double> markers = file.column("/trime_mpi/tags/part_marker");
  const std::vector<double> ids = file.column("/trime_mpi/tags/region_id");
  const std::set<double> regions(ids.begin(), ids.end());
  const bool any_marker = std::ranges::any_of(markers, [](double marker) { return marker != 0; });
  Tally labels, marked, foreign;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
    const auto place = [&] { return fmt::format("facet {}: {}", k, place_of(mesh, mesh.facets[k])); };
    const auto part = static_cast<std::size_t>(mesh.facet_parts[k]);
    if (mesh.facet_labels[k] != mesh.facet_parts[k] + 1)
      labels.note(place);
    const double marker = part < markers.size() ? markers[part] : 0;
    if (mesh.facet_markers.empty() ? marker != 0 : static_cast<double>(mesh.facet_markers[k]) != marker)
      marked.note(place);
  }
  if (any_marker == mesh.facet_markers.empty() && !mesh.facets.empty())
    marked.note([] { return std::string("/Mesh/facets/markers must be there if and only if a part has a marker"); });
  for (std::size_t t = 0; t < mesh.region.size(); ++t)
    if (!regions.contains(static_cast<double>(mesh.region[t])))
      foreign.note([&] { return fmt::format("{}: {}", place_of(mesh, t), mesh.region[t]); });
  report.none("labels", labels, "facets whose label is not the number of their part plus 1");
  report.none("markers", marked, "facets whose marker differs from that of their part in /trime_mpi/tags");
  report.none("region", foreign, "triangles whose region is missing in /trime_mpi/tags");
}

/// Tables of tags have as many rows in all columns, and parts count from 0; points of ranks come one behind the other.
void check_columns(const StoredFile& file, const Mesh& mesh, Report& report) {
  Tally wrong;
  const auto expect = [&](bool holds, const char* name) {
    if (!holds)
      wrong.note([&] { return fmt::format("/trime_mpi/{}", name); });
  };
  const std::vector<double> parts = file.column("/trime_mpi/tags/part_id");
  const std::size_t names = file.names("/trime_mpi/tags/part_name").size();
  expect(parts.size() == names, "tags/part_id");
  for (std::size_t k = 0; k < parts.size(); ++k)
    expect(parts[k] == static_cast<double>(k), "tags/part_id");
  expect(file.column("/trime_mpi/tags/part_marker").size() == names, "tags/part_marker");
  expect(file.names("/trime_mpi/tags/region_name").size() == file.column("/trime_mpi/tags/region_id").size(),
         "tags/region_name");
  const std::vector<double> first = file.column("/trime_mpi/ranks/first_point");
  expect(!first.empty() && first[0] == 0 && std::ranges::is_sorted(first) &&
             first.back() <= static_cast<double>(mesh.points.size()),
         "ranks/first_point");
  report.none("columns", wrong, "columns of the tables `tags` and `ranks` with rows that are missing or out of order");
}

/// Parts of a loop, each once in the order in which they come from a facet on.
std::string name_from(const std::vector<std::int64_t>& runs, std::size_t first, const std::vector<std::string>& names) {
  std::string name;
  std::set<std::int64_t> listed;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::int64_t part = runs[(first + k) % runs.size()];
    if (listed.insert(part).second)
      name += (name.empty() ? "" : "+") + names[static_cast<std::size_t>(part)];
  }
  return name;
}

/// Is this the name of a loop, whichever of its facets is the first?
bool is_name(const std::string& name, const Mesh& mesh, const Loop& loop, const std::vector<std::string>& names) {
  std::vector<std::int64_t> runs;
  for (const std::size_t k : loop.facets)
    if (const std::int64_t part = mesh.facet_parts[k]; runs.empty() || runs.back() != part)
      runs.push_back(part);
  if (std::ranges::any_of(runs, [&](std::int64_t part) { return part < 0 || part >= std::ssize(names); }))
    return false;
  for (std::size_t first = 0; first < runs.size(); ++first)
    if (name.starts_with(names[static_cast<std::size_t>(runs[first])]) && name_from(runs, first, names) == name)
      return true;
  return false;
}

void check_loops(const StoredFile& file, const Mesh& mesh, const Counted& counted, Report& report) {
  const std::vector<double> ids = file.column("/trime_mpi/tags/edge_id");
  const std::vector<std::string> kinds = file.names("/trime_mpi/tags/edge_kind");
  const std::vector<std::string> loop_names = file.names("/trime_mpi/tags/edge_name");
  std::vector<std::string> names = file.names("/trime_mpi/tags/part_name");
  for (const std::string& curve : file.names("/trime_mpi/curves/curve_name")) // loops go along curves that are split
    names.push_back(curve);
  std::map<double, std::size_t> rows;
  for (std::size_t row = 0; row < std::min({ids.size(), kinds.size(), loop_names.size()}); ++row)
    rows.emplace(ids[row], row);
  Tally kind, name;
  for (const Loop& loop : counted.boundary) {
    const std::int64_t tag = mesh.facet_tags[loop.facets[0]];
    const auto row = rows.find(static_cast<double>(tag));
    if (row == rows.end() || kinds[row->second] != loop.kind)
      kind.note([&] { return fmt::format("loop {} is {}", tag, loop.kind); });
    if (row == rows.end() || !is_name(loop_names[row->second], mesh, loop, names))
      name.note([&] { return fmt::format("loop {} at {}", tag, place_of(mesh, mesh.facets[loop.facets[0]])); });
  }
  report.none("edge_kind", kind, "loops whose `edge_kind` is not the kind of the loop");
  report.none("edge_name", name, "loops whose `edge_name` does not list their parts in order");
}

/// Attributes of a run that follow from its mesh.
class Attributes {
public:
  Attributes(const StoredFile& file, const Mesh& mesh, const Counted& counted)
      : file_(file), mesh_(mesh), counted_(counted) {}

  Tally compare() {
    exact("components", static_cast<double>(counted_.components));
    exact("holes", static_cast<double>(std::ranges::count(counted_.boundary, "hole", &Loop::kind)));
    exact("corners", static_cast<double>(counted_.corners));
    const auto [smallest, largest] = std::ranges::minmax(mesh_.size);
    exact("smallest_size", smallest);
    exact("largest_size", largest);
    const double asked = mesh_.asked_sizes.empty() ? 0 : std::ranges::max(mesh_.asked_sizes);
    if (file_.text_attribute("/trime_mpi", "sizing") == "uniform") { // else it is one of the container
      if (ConfigText(file_.text("/trime_mpi/config_resolved"), "").number("sizing", "shortest_edge"))
        within("edge_length", 0, std::max(largest, asked)); // the size may be raised at places
      else
        exact("edge_length", std::max(largest, asked));
    }
    double slivers = area_tolerance * counted_.area;
    for (std::size_t k = 0; k < mesh_.facets.size(); ++k) {
      const Point a = mesh_.at(mesh_.facets[k][0]), d = mesh_.periods.near(mesh_.at(mesh_.facets[k][1]), a) - a;
      slivers += std::hypot(d.x, d.y) * chord * mesh_.asked_sizes[k];
    }
    within("shape_area", counted_.area - slivers, counted_.area + slivers);
    return wrong_;
  }

private:
  void exact(const char* name, double value) { within(name, value, value); }

  void within(const char* name, double low, double high) {
    // Sizes are stored in single precision, other than the attribute.
    constexpr double rounding = 1e-6;
    const std::optional<double> found = file_.number("/trime_mpi", name);
    if (!found || !(*found >= low - rounding * std::fabs(low) && *found <= high + rounding * std::fabs(high)))
      wrong_.note([&] {
        return fmt::format("`{}` is {}, expected {}", name, found ? fmt::format("{:.9g}", *found) : "missing",
                           low == high ? fmt::format("{:.9g}", low) : fmt::format("{:.9g} to {:.9g}", low, high));
      });
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  const Counted& counted_;
  Tally wrong_;
};

bool is_step(const StoredFile& file) {
  return file.text_attribute("/trime_mpi", "stop_reason").value_or("").starts_with("none");
}

} // namespace

void check_tables(const StoredFile& file, const Mesh& mesh, const Counted& counted, Report& report) {
  check_format(file, mesh, report);
  check_labels(file, mesh, report);
  check_columns(file, mesh, report);
  if (counted.boundary.empty() && !mesh.facets.empty())
    report.skip("edge_kind, edge_name", "the facets do not form closed loops without crossings");
  else
    check_loops(file, mesh, counted, report);
  if (is_step(file))
    report.skip("attributes", "the mesh is an intermediate step of a run, which does not store these counts");
  else
    report.none(
        "attributes", Attributes(file, mesh, counted).compare(),
        "attributes of /trime_mpi that differ from what trime_check finds: components, holes, corners, sizes, areas");
  report.skip("provenance", "trime_check cannot check how the mesh was made: texts, versions, `crs`, times, counters, "
                            "history, `normalization`, `rings`, `sharp_corners`, `worst_triangles`, other attributes");
}

namespace {

constexpr std::int64_t vtk_triangle = 5; // VTK's number of this kind of cell

void check_views(const Mesh& mesh, Report& report) {
  Tally points, cells;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Point p = mesh.points[i];
    if (mesh.has_vtk &&
        (mesh.vtk_points[3 * i] != p.x || mesh.vtk_points[3 * i + 1] != p.y || mesh.vtk_points[3 * i + 2] != 0))
      points.note([&] { return fmt::format("/VTKHDF/Points[{}] and {}", i, place_of(p)); });
    if (mesh.has_plain && (mesh.petsc_points[2 * i] != p.x || mesh.petsc_points[2 * i + 1] != p.y))
      points.note([&] { return fmt::format("/geometry/vertices[{}] and {}", i, place_of(p)); });
  }
  for (std::size_t t = 0; mesh.has_vtk && t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.connectivity[3 * t + k] != mesh.triangles[t][k])
        cells.note([&] { return fmt::format("/VTKHDF/Connectivity[{}] and {}", 3 * t + k, place_of(mesh, t)); });
    if (mesh.offsets[t] != static_cast<std::int64_t>(3 * t) || mesh.types[t] != vtk_triangle)
      cells.note([&] { return fmt::format("/VTKHDF/Offsets or Types [{}]", t); });
  }
  const std::vector<std::int64_t> counts{std::ssize(mesh.points), std::ssize(mesh.triangles),
                                         std::ssize(mesh.connectivity)};
  if (mesh.has_vtk && (mesh.offsets.back() != counts[2] || mesh.counts != counts))
    cells.note([] { return std::string("/VTKHDF/Offsets at its end, or one of /VTKHDF/NumberOf..."); });
  report.none("vtk_points", points, "points in the copies /VTKHDF and /geometry that differ from /Mesh/mesh/geometry");
  report.none("vtk_cells", cells, "triangles in the copy /VTKHDF that differ from /Mesh/mesh/topology");
}

/// Canonical: the lowest vertex first, triangles by their first and then second vertex, facets by their lowest vertex.
void check_order(const Mesh& mesh, Report& report) {
  Tally wrong;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& now = mesh.triangles[t];
    if (now[0] > now[1] || now[0] > now[2] || (t > 0 && !(mesh.triangles[t - 1] < now)))
      wrong.note([&] { return place_of(mesh, t); });
  }
  for (std::size_t k = 1; k < mesh.facets.size(); ++k) {
    const auto least = [&](std::size_t f) { return std::min(mesh.facets[f][0], mesh.facets[f][1]); };
    if (least(k) < least(k - 1))
      wrong.note([&] { return fmt::format("facet {}: {}", k, place_of(mesh, mesh.facets[k])); });
  }
  report.none("order", wrong, "triangles and facets that are not sorted by the ids of their vertices");
}

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// See "mesh_hash" in src/files.md.
std::uint64_t hash_of(const Mesh& mesh) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value); };
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    sum += mix(mix(mix(2 * std::uint64_t{i}) ^ bits(mesh.points[i].x)) ^ bits(mesh.points[i].y));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint64_t term = mix(2 * std::uint64_t{t} + 1);
    for (const std::int64_t id : mesh.triangles[t])
      term = mix(term ^ static_cast<std::uint64_t>(id));
    sum += term;
  }
  return sum;
}

void check_hash(const StoredFile& file, const Mesh& mesh, Report& report) {
  const std::uint64_t hash = hash_of(mesh);
  const std::string hex = fmt::format("{:016x}", hash);
  const std::optional<std::uint64_t> stored = file.hash("/trime_mpi", "mesh_hash");
  report.add("mesh_hash", stored == hash && file.text_attribute("/trime_mpi", "mesh_hash_hex") == hex,
             stored ? fmt::format("{:016x}", *stored) : std::string("a hash"), hex,
             "hash of points and triangles; expected is the value stored in /trime_mpi");
}

} // namespace

bool check_arrays(const StoredFile& file, const Mesh& mesh, Report& report) {
  Tally range, infinite;
  const auto is_id = [&](std::int64_t id) { return id >= 0 && id < std::ssize(mesh.points); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!std::ranges::all_of(mesh.triangles[t], is_id))
      range.note([&] { return fmt::format("triangle {}", t); });
  const auto check_edges = [&](const std::vector<Facet>& edges, const char* what) {
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (!std::ranges::all_of(edges[k], is_id))
        range.note([&] { return fmt::format("{} {}", what, k); });
  };
  check_edges(mesh.facets, "facet");
  check_edges(mesh.curve_edges, "edge on a curve");
  check_edges(mesh.interfaces, "interface edge");
  check_edges(mesh.split_pairs, "pair");
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!std::isfinite(mesh.points[i].x) || !std::isfinite(mesh.points[i].y))
      infinite.note([&] { return fmt::format("point {} {}", i, place_of(mesh.points[i])); });
  report.none("id_range", range,
              fmt::format("triangles, facets and edges inside with vertex ids outside the range of the {} points",
                          mesh.points.size()));
  report.none("finite", infinite, "points whose coordinates are not finite numbers");
  if (range.count > 0)
    return false;
  check_hash(file, mesh, report);
  check_views(mesh, report);
  check_order(mesh, report);
  return infinite.count == 0;
}

} // namespace trime_check
