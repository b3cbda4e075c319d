// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"

#include <algorithm>
#include <map>

namespace trime_check {
namespace {

/// All that looks at the edges on curves.
class CurveChecks {
public:
  CurveChecks(const StoredFile& file, const Mesh& mesh, Report& report) : file_(file), mesh_(mesh), report_(report) {}

  void run() {
    check_numbers();
    for (const Facet& edge : mesh_.curve_edges)
      triangles_.try_emplace(ascending(edge), 0);
    Tally twice, wide;
    for (const Facet& edge : mesh_.curve_edges)
      if (++listed_[ascending(edge)] > 1)
        twice.note([&] { return place_of(mesh_, edge); });
    for (const Triangle& t : mesh_.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto found = triangles_.find(ascending({t[(k + 1) % 3], t[(k + 2) % 3]}));
            found != triangles_.end()) {
          ++found->second;
          if (mesh_.cosine(t, k) < least_cosine)
            wide.note([&] { return place_of(mesh_, found->first); });
        }
    Tally no_edges;
    for (const auto& of_edge : triangles_)
      if (of_edge.second != 2)
        no_edges.note([&] { return place_of(mesh_, of_edge.first); });
    report_.none("curve_edges", no_edges, "edges on curves that are not edges of two triangles");
    report_.none("curve_once", twice, "edges on curves that are listed twice");
    report_.none("curve_discs", wide, "edges on curves with an angle above 90 degrees opposite to them");
  }

private:
  void check_numbers() {
    const auto curves = static_cast<std::int64_t>(file_.names("/trime_mpi/curves/curve_name").size());
    const auto parts = static_cast<std::int64_t>(file_.names("/trime_mpi/tags/part_name").size());
    Tally numbers;
    for (std::size_t k = 0; k < mesh_.curve_edges.size(); ++k) {
      const std::int64_t number = mesh_.curve_numbers[k];
      if (number < 0 || number >= curves || mesh_.curve_labels[k] != parts + number + 1)
        numbers.note([&] { return fmt::format("edge {}", k); });
    }
    report_.none("curve_labels", numbers,
                 "edges on curves whose curve has no name, or whose label is not that of the curve after all parts");
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  Report& report_;
  std::map<Facet, int> triangles_, listed_;
};

/// The list of all labelled edges against the lists of facets, edges on curves and interfaces.
void compare_lines(const Mesh& mesh, Report& report) {
  std::vector<Facet> edges = mesh.facets;
  std::vector<std::int64_t> labels = mesh.facet_labels;
  edges.insert(edges.end(), mesh.curve_edges.begin(), mesh.curve_edges.end());
  labels.insert(labels.end(), mesh.curve_labels.begin(), mesh.curve_labels.end());
  for (std::size_t k = 0; k < mesh.interfaces.size(); ++k)
    if (mesh.interface_curves[k] == -1) {
      edges.push_back(mesh.interfaces[k]);
      labels.push_back(mesh.interface_labels[k]);
    }
  Tally wrong;
  for (std::size_t k = 0; k < std::max(edges.size(), mesh.lines.size()); ++k)
    if (k >= std::min(edges.size(), mesh.lines.size()) || edges[k] != mesh.lines[k] || labels[k] != mesh.line_labels[k])
      wrong.note([&] { return fmt::format("row {}", k); });
  report.none("lines", wrong,
              "rows of /Mesh/lines that are not the facets, then the edges on curves, then the other interface edges");
}

} // namespace

void check_curves(const StoredFile& file, const Mesh& mesh, Report& report) {
  if (!mesh.curve_edges.empty())
    CurveChecks(file, mesh, report).run();
}

void check_lines(const StoredFile& file, const Mesh& mesh, Report& report) {
  if (file.has("/Mesh/lines")) // older files have none
    compare_lines(mesh, report);
}

} // namespace trime_check
