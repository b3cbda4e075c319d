// SPDX-License-Identifier: BSD-3-Clause
// The files of Triangle (Shewchuk, https://www.cs.cmu.edu/~quake/triangle.html): .node and .edge with boundary markers,
// .ele with the region as its attribute. Numbers begin with 1. As with Triangle's option -e, .edge holds all edges:
// those of the boundary and others with a name first, then those inside, with the marker 0. Programs look up each side
// of a triangle there.
#include "comm/agree.hpp"
#include "formats/exchange_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace trime::formats {
namespace {

std::string comments(const char* what, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += fmt::format("# {} {}: {}\n", what, k + 1, names[k]);
  return text;
}

using Corners = std::array<GlobalId, 3>;
using Side = std::array<GlobalId, 2>;

/// The edges inside the mesh without a label. Each is the ascending side of one triangle, which lists it.
class InnerEdges {
public:
  /// O(boundary) and 8 bytes a triangle of this rank. Collective.
  explicit InnerEdges(const ExchangeMesh& mesh)
      : labelled_(comm::gather_everywhere(mesh.comm(), std::vector<Side>(mesh.mesh().facets))) {
    std::vector<Side> inside;
    for (const std::vector<Side>* list : {&mesh.mesh().curve_edges, &mesh.mesh().interfaces})
      for (const auto& [a, b] : *list)
        inside.push_back({std::min(a, b), std::max(a, b)});
    const std::vector<Side> all = comm::gather_everywhere(mesh.comm(), std::move(inside));
    labelled_.insert(labelled_.end(), all.begin(), all.end());
    std::sort(labelled_.begin(), labelled_.end());
    std::int64_t edges = 0;
    for (std::size_t row = 0; row < mesh.mesh().triangles.size(); ++row) {
      first_.push_back(edges);
      for (const Side side : sides(mesh.mesh().triangle_ids(row)))
        edges += is_listed(side) ? 1 : 0;
    }
    const std::int64_t before = mesh.lines() + mesh.comm().exclusive_scan(edges);
    for (std::int64_t& first : first_)
      first += before;
    total_ = mesh.lines() + mesh.comm().sum(edges);
  }

  /// Appends the edges of a triangle, numbered after those with a label.
  void append(std::int64_t row, const Corners& corners, std::string& to) const {
    std::int64_t number = first_[static_cast<std::size_t>(row)];
    for (const Side side : sides(corners))
      if (is_listed(side))
        append_line(to, ++number, side[0] + 1, side[1] + 1, std::int64_t{0});
  }
  /// With those that have a label.
  std::int64_t total() const { return total_; }

private:
  static std::array<Side, 3> sides(const Corners& corners) {
    return {{{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[0]}}};
  }
  /// Facets and triangles have the mesh on their left: a facet is a side in the same direction. Labelled edges inside
  /// are sides in both directions.
  bool is_listed(const Side& side) const {
    return side[0] < side[1] && !std::binary_search(labelled_.begin(), labelled_.end(), side);
  }

  std::vector<Side> labelled_;
  std::vector<std::int64_t> first_; // edges listed before those of a triangle of this rank
  std::int64_t total_ = 0;
};

} // namespace

std::vector<FilePlan> plan_triangle(const ExchangeMesh& mesh, const std::string& path) {
  const std::vector<std::string> paths = paths_of(Format::triangle, path, mesh.names());
  const auto inner = std::make_shared<const InnerEdges>(mesh); // rows outlive this function
  return {
      {paths[0],
       {mesh.once(fmt::format("{} 2 0 1\n", mesh.points())),
        mesh.point_rows([&mesh](std::int64_t row, GlobalId id, geometry::Vec2 p, std::string& to) {
          append_line(to, id + 1, p.x, p.y, mesh.point_label(row));
        }),
        mesh.once(comments("marker", mesh.line_names()))}},
      {paths[1],
       {mesh.once(fmt::format("{} 3 1\n", mesh.triangles())),
        mesh.triangle_rows(
            [&mesh](std::int64_t row, GlobalId id, const std::array<GlobalId, 3>& corners, std::string& to) {
              append_line(to, id + 1, corners[0] + 1, corners[1] + 1, corners[2] + 1, mesh.region(row));
            }),
        mesh.once(comments("region", mesh.names().regions))}},
      {paths[2],
       {mesh.once(fmt::format("{} 1\n", inner->total())),
        mesh.line_rows([&mesh](std::int64_t row, GlobalId id, const std::array<GlobalId, 2>& ends, std::string& to) {
          append_line(to, id + 1, ends[0] + 1, ends[1] + 1, mesh.line_label(row));
        }),
        mesh.triangle_rows([inner](std::int64_t row, GlobalId, const Corners& corners, std::string& to) {
          inner->append(row, corners, to);
        }),
        mesh.once(comments("marker", mesh.line_names()))}}};
}

} // namespace trime::formats
