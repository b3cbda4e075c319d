// SPDX-License-Identifier: BSD-3-Clause
#include "trime/dual/local_cells.hpp"

#include "comm/agree.hpp"
#include "dual/face_list.hpp"
#include "dual/site_cell.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace trime::dual {
namespace {

using geometry::Vec2;

/// The owned points and all triangles around them, without what other ranks hold.
Cells cells_of(const handover::LocalMesh& mesh, Vec2 period) {
  Cells cells;
  cells.first_site = mesh.first_point;
  cells.site_count = mesh.owned_points;
  cells.triangle_count = mesh.total_triangles;
  cells.period = period;
  cells.points = mesh.points;
  cells.foreign = mesh.ghost_ids;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    cells.triangles.push_back({mesh.triangle_ids[t], mesh.triangles[t], mesh.regions.empty() ? 1 : mesh.regions[t]});
  return cells;
}

/// Numbers the vertices of the cells of one rank.
class Vertices {
public:
  explicit Vertices(const Cells& cells) : cells_(cells) {
    for (const CellTriangle& triangle : cells.triangles)
      places_.push_back(cells.points[at(triangle.corners[0])] + cells.centre_of(triangle));
  }

  /// Finds the vertices around a site, as the site sees them.
  void look(LocalIndex site, const Surroundings& around, SeenVertices& seen) {
    seen.centres.clear();
    for (std::size_t k = 0; k < around.triangles.size(); ++k) {
      const LocalIndex triangle = around.triangles[k];
      const bool is_image = is_displaced(site, cells_.triangles[at(triangle)].corners[0]);
      seen.centres.push_back(is_image ? add(site, around.centres[k]) : triangle);
    }
    seen.middles.assign(around.arms.size(), -1);
    for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke)
      if (around.is_divided_at(spoke))
        seen.middles[spoke] = middle(site, around.ends[spoke], around.middle(spoke));
    const bool is_whole = std::all_of(seen.middles.begin(), seen.middles.end(), [](LocalIndex v) { return v < 0; });
    seen.site = is_whole ? -1 : add(site, {0, 0});
  }

  std::vector<Vec2>& places() { return places_; }

private:
  LocalIndex add(LocalIndex site, Vec2 place) {
    places_.push_back(cells_.points[at(site)] + place);
    return static_cast<LocalIndex>(places_.size()) - 1;
  }

  /// All ranks place the middle from the end with the lower number.
  LocalIndex middle(LocalIndex site, LocalIndex end, Vec2 place) {
    const bool is_lower = cells_.number_of(site) < cells_.number_of(end);
    const LocalIndex lower = is_lower ? site : end, upper = is_lower ? end : site;
    if (is_displaced(site, lower))
      return add(site, place);
    const auto key = static_cast<std::uint64_t>(lower) << 32U | static_cast<std::uint32_t>(upper);
    const auto [found, is_new] = middles_.try_emplace(key, static_cast<LocalIndex>(places_.size()));
    const auto point = [&](LocalIndex p) { return cells_.points[at(p)]; };
    if (is_new)
      places_.push_back(point(lower) + 0.5 * difference(point(upper), point(lower), cells_.period));
    return found->second;
  }

  /// Returns whether the container's border lies between a site and a point next to it.
  bool is_displaced(LocalIndex site, LocalIndex point) const {
    const Vec2 d = cells_.points[at(point)] - cells_.points[at(site)], period = cells_.period;
    return (period.x > 0 && std::fabs(d.x) > 0.5 * period.x) || (period.y > 0 && std::fabs(d.y) > 0.5 * period.y);
  }

  const Cells& cells_;
  std::vector<Vec2> places_;
  std::unordered_map<std::uint64_t, LocalIndex> middles_; // by the ends; only looked up, so its order does not matter
};

/// Appends the corners of a part of a cell to a list.
struct CornerList {
  const SeenVertices& seen;
  std::vector<LocalIndex>& corners;

  void centre(std::size_t triangle) { corners.push_back(seen.centres[triangle]); }
  void middle(std::size_t spoke) { corners.push_back(seen.middles[spoke]); }
  void site() { corners.push_back(seen.site); }
};

/// Finds facets by their ends.
class FacetsByEnds {
public:
  explicit FacetsByEnds(const handover::LocalMesh& mesh) : mesh_(mesh) {
    for (std::size_t k = 0; k < mesh.facets.size(); ++k)
      order_.push_back(static_cast<LocalIndex>(k));
    std::sort(order_.begin(), order_.end(),
              [&](LocalIndex a, LocalIndex b) { return mesh.facets[at(a)] < mesh.facets[at(b)]; });
  }

  LocalIndex find(LocalIndex first, LocalIndex second) const {
    const std::array<LocalIndex, 2> ends{first, second};
    const auto found = std::lower_bound(order_.begin(), order_.end(), ends, [&](LocalIndex facet, const auto& wanted) {
      return mesh_.facets[at(facet)] < wanted;
    });
    if (found == order_.end() || mesh_.facets[at(*found)] != ends)
      throw FileError(fmt::format(
          "the edge between the points {} and {} at ({:.9g}, {:.9g}) has a triangle on one side only: expected it "
          "among the boundary edges, and did not find it there. Use a local mesh with Overlap::triangles, and a mesh "
          "that has passed its checks",
          mesh_.global_id(first), mesh_.global_id(second), mesh_.points[at(first)].x, mesh_.points[at(first)].y));
    return *found;
  }

private:
  const handover::LocalMesh& mesh_;
  std::vector<LocalIndex> order_;
};

/// Makes the arrays, site by site.
class Builder {
public:
  Builder(const handover::LocalMesh& mesh, const Cells& cells) : facets_(mesh), vertices_(cells), cells_(cells) {
    made_.cells = cells.site_count;
    made_.areas.assign(mesh.points.size(), 0);
    made_.centroids.assign(mesh.points.size(), {0, 0});
    for (auto* first : {&made_.corner_first, &made_.part_first, &made_.part_corner_first, &made_.neighbour_first})
      first->push_back(0);
  }

  LocalCells make() {
    FaceList faces(cells_, made_);
    Surroundings around;
    SeenVertices seen;
    for (LocalIndex site = 0; site < cells_.site_count; ++site) {
      look_around(cells_, site, around);
      vertices_.look(site, around, seen);
      add_polygons(site, around, seen);
      faces.add(site, around, seen);
      if (!around.is_closed)
        add_chords(site, around);
    }
    faces.add_those_of_others();
    made_.vertices = std::move(vertices_.places());
    return std::move(made_);
  }

private:
  void add_polygons(LocalIndex site, const Surroundings& around, const SeenVertices& seen) {
    const Vec2 place = cells_.points[at(site)];
    const CellPart whole{0, 0, around.triangles.size(), around.is_closed};
    for_each_corner(around, whole, CornerList{seen, made_.corners});
    made_.corner_first.push_back(std::ssize(made_.corners));
    const Moments cell = moments_of(around, whole);
    made_.areas[at(site)] = cell.area;
    made_.centroids[at(site)] = place + cell.centroid;
    for (const CellPart& part : parts_of(around)) {
      for_each_corner(around, part, CornerList{seen, made_.part_corners});
      made_.part_corner_first.push_back(std::ssize(made_.part_corners));
      const Moments moments = moments_of(around, part);
      made_.part_regions.push_back(part.region);
      made_.part_areas.push_back(moments.area);
      made_.part_centroids.push_back(place + moments.centroid);
    }
    made_.part_first.push_back(std::ssize(made_.part_areas));
  }

  void add_chords(LocalIndex site, const Surroundings& around) {
    const auto add = [&](LocalIndex facet, Vec2 along) {
      made_.chord_cells.push_back(site);
      made_.chord_facets.push_back(facet);
      made_.chord_normals.push_back(0.5 * Vec2{along.y, -along.x});
    };
    add(facets_.find(site, around.ends.front()), around.arms.front());
    add(facets_.find(around.ends.back(), site), Vec2{0, 0} - around.arms.back());
  }

  FacetsByEnds facets_;
  Vertices vertices_;
  const Cells& cells_;
  LocalCells made_;
};

/// Fetches what other ranks know of the cells of ghosts.
void fetch_ghosts(const comm::Communicator& comm, const handover::LocalMesh& mesh, LocalCells& cells) {
  std::vector<double> values;
  for (std::size_t k = 0; k < cells.areas.size(); ++k)
    for (const double value : {cells.areas[k], cells.centroids[k].x, cells.centroids[k].y})
      values.push_back(value);
  handover::update_ghosts(comm, mesh, values, 3);
  for (std::size_t k = at(cells.cells); k < cells.areas.size(); ++k) {
    cells.areas[k] = values[3 * k];
    cells.centroids[k] = {values[3 * k + 1], values[3 * k + 2]};
  }
}

} // namespace

LocalCells make_local_cells(const comm::Communicator& comm, const handover::LocalMesh& mesh, Vec2 period) {
  LocalCells made;
  {
    Cells cells = cells_of(mesh, period);
    find_fans(cells, comm);
    comm::run_agreed(comm, [&] { made = Builder(mesh, cells).make(); });
  }
  fetch_ghosts(comm, mesh, made);
  return made;
}

} // namespace trime::dual
