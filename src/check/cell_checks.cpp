// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "topology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace trime_check {
namespace {

constexpr double area_tolerance = 1e-12;    // of the area of a region
constexpr double place_tolerance = 1e-9;    // of the length of an edge, or of a radius
constexpr double coordinate_roundings = 64; // half units in the last place of the largest coordinate

/// The arrays of the group /Cells.
struct Cells {
  std::vector<double> vertices, areas, centroids, distances, lengths;
  std::vector<std::int64_t> first, corners, sites, regions, faces, face_regions;

  std::size_t parts() const { return sites.size(); }
  Point vertex(std::int64_t v) const {
    return {vertices[2 * static_cast<std::size_t>(v)], vertices[2 * static_cast<std::size_t>(v) + 1]};
  }
  std::size_t begin(std::size_t part) const { return static_cast<std::size_t>(first[part]); }
  std::size_t end(std::size_t part) const { return static_cast<std::size_t>(first[part + 1]); }
};

double length_of(Point p) {
  return std::hypot(p.x, p.y);
}
double cross_of(Point u, Point v) {
  return u.x * v.y - u.y * v.x;
}

/// Adds numbers of very different size without loss (Neumaier 1974).
struct Sum {
  double sum = 0, rest = 0;
  void add(double value) {
    const double next = sum + value;
    rest += std::fabs(sum) >= std::fabs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  double total() const { return sum + rest; }
};

/// Compares the cells with the triangles.
class CellChecks {
public:
  CellChecks(const StoredFile& file, const Mesh& mesh, Report& report)
      : file_(file), mesh_(mesh), report_(report), triangles_(std::ssize(mesh.triangles)) {
    double largest = 0;
    for (const Point& p : mesh.points)
      largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
    rounding_ = 0.5 * coordinate_roundings * std::numeric_limits<double>::epsilon() * largest;
  }

  void run() {
    if (!read() || !check_numbers()) {
      report_.skip("cells", "nothing can be computed from the arrays of /Cells");
      return;
    }
    check_centres();
    check_polygons();
    check_areas();
    check_topology();
    check_faces();
    check_chords();
  }

private:
  bool read() {
    Tally wrong;
    const std::string group = "/Cells/";
    const auto reals = [&](const char* name, std::vector<std::int64_t> shape) {
      return file_.array<double>(group + name, "float64", std::move(shape), wrong);
    };
    const auto integers = [&](const char* name, const char* type, std::vector<std::int64_t> shape) {
      return file_.array<std::int64_t>(group + name, type, std::move(shape), wrong);
    };
    cells_.sites = integers("sites", "int64", {-1});
    const auto parts = std::ssize(cells_.sites);
    cells_.vertices = reals("vertices", {-1, 2});
    cells_.first = integers("corner_first", "int64", {parts + 1});
    cells_.corners = integers("corners", "int64", {-1});
    cells_.regions = integers("regions", "int32", {parts});
    cells_.areas = reals("areas", {parts});
    cells_.centroids = reals("centroids", {parts, 2});
    cells_.faces = integers("faces", "int64", {-1, 2});
    const auto faces = std::ssize(cells_.faces) / 2;
    cells_.distances = reals("face_distances", {faces});
    cells_.lengths = reals("face_lengths", {faces, 2});
    cells_.face_regions = integers("face_regions", "int32", {faces, 2});
    report_.none("cell_arrays", wrong, "arrays of /Cells that are missing, or have another type or shape");
    return wrong.count == 0;
  }

  bool check_numbers() {
    Tally wrong;
    const std::int64_t points = std::ssize(mesh_.points), vertices = std::ssize(cells_.vertices) / 2;
    if (vertices < triangles_ || cells_.first.front() != 0 || cells_.first.back() != std::ssize(cells_.corners))
      wrong.note([] { return std::string("corner_first does not cover corners, or there are too few vertices"); });
    for (std::size_t part = 0; part < cells_.parts(); ++part) {
      const std::int64_t site = cells_.sites[part], before = part == 0 ? -1 : cells_.sites[part - 1];
      if (site < 0 || site >= points || (site != before && site != before + 1) ||
          cells_.first[part + 1] < cells_.first[part] + 3)
        wrong.note([&] { return fmt::format("polygon {} of site {}", part, site); });
    }
    if (cells_.sites.empty() || cells_.sites.back() != points - 1)
      wrong.note([] { return std::string("the last point has no cell"); });
    for (const std::int64_t corner : cells_.corners)
      if (corner < 0 || corner >= vertices)
        wrong.note([&] { return fmt::format("corner {} of {} vertices", corner, vertices); });
    for (const std::int64_t site : cells_.faces)
      if (site < 0 || site >= points)
        wrong.note([&] { return fmt::format("a face of the cell {}", site); });
    for (const double value : cells_.vertices)
      if (!std::isfinite(value))
        wrong.note([] { return std::string("a vertex that is not finite"); });
    report_.none("cell_numbers", wrong, "numbers of corners and sites out of range or out of order");
    return wrong.count == 0;
  }

  /// A circumcentre has the number of its triangle, and the same distance from its corners.
  void check_centres() {
    Tally wrong;
    for (std::int64_t t = 0; t < triangles_; ++t) {
      const std::array<Point, 3> corners = mesh_.corners(mesh_.triangles[static_cast<std::size_t>(t)]);
      const Point centre = mesh_.periods.near(cells_.vertex(t), corners[0]);
      const double radius = length_of(centre - corners[0]);
      for (const Point& corner : {corners[1], corners[2]})
        if (!(std::fabs(length_of(centre - corner) - radius) <= place_tolerance * radius + rounding_))
          wrong.note([&] { return place_of(mesh_, static_cast<std::size_t>(t)); });
    }
    report_.none("cell_centres", wrong, "vertices that are not the circumcentres of the triangles of their numbers");
  }

  /// Returns the place of a point in a triangle; 3 if it is not there.
  std::size_t slot_of(std::int64_t point, std::int64_t triangle) const {
    const Triangle& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
    return static_cast<std::size_t>(std::find(t.begin(), t.end(), point) - t.begin());
  }

  bool is_at(std::int64_t vertex, std::int64_t site, Point wanted, double scale) const {
    const Point place = mesh_.periods.near(cells_.vertex(vertex), mesh_.at(site));
    return length_of(place - wanted) <= place_tolerance * scale + rounding_;
  }

  /// Returns whether a vertex is the middle of the side of a triangle between a site and the corner `steps` behind it.
  bool is_middle(std::int64_t vertex, std::int64_t site, std::int64_t triangle, std::size_t steps) const {
    const Triangle& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
    const Point p = mesh_.at(site), q = mesh_.periods.near(mesh_.at(t[(slot_of(site, triangle) + steps) % 3]), p);
    return is_at(vertex, site, {0.5 * (p.x + q.x), 0.5 * (p.y + q.y)}, length_of(q - p));
  }

  /// Returns whether the triangles [from, to) of the list of corners follow each other around a site.
  bool is_fan(std::size_t part, std::size_t from, std::size_t to, bool is_round) const {
    const std::int64_t site = cells_.sites[part];
    for (std::size_t k = from; k < to; ++k) {
      const std::int64_t t = cells_.corners[k];
      if (t >= triangles_ || slot_of(site, t) == 3 || mesh_.region[static_cast<std::size_t>(t)] != cells_.regions[part])
        return false;
    }
    const auto corner = [&](std::size_t k, std::size_t steps) {
      const std::int64_t t = cells_.corners[k];
      return mesh_.triangles[static_cast<std::size_t>(t)][(slot_of(site, t) + steps) % 3];
    };
    for (std::size_t k = from; k + 1 < to; ++k)
      if (corner(k, 2) != corner(k + 1, 1))
        return false;
    return !is_round || corner(to - 1, 2) == corner(from, 1);
  }

  bool is_cell(std::size_t part) const {
    const std::size_t from = cells_.begin(part), to = cells_.end(part);
    const std::int64_t site = cells_.sites[part];
    if (cells_.corners[from] < triangles_)
      return is_fan(part, from, to, true);
    return to - from >= 4 && is_fan(part, from + 1, to - 2, false) &&
           is_middle(cells_.corners[from], site, cells_.corners[from + 1], 1) &&
           is_middle(cells_.corners[to - 2], site, cells_.corners[to - 3], 2) &&
           is_at(cells_.corners[to - 1], site, mesh_.at(site), 0);
  }

  /// Each corner of each triangle belongs to one polygon.
  void check_polygons() {
    Tally wrong;
    std::int64_t incidences = 0;
    std::set<Facet> seen; // of the polygon's site: (site, triangle)
    for (std::size_t part = 0; part < cells_.parts(); ++part) {
      if (!is_cell(part))
        wrong.note([&] { return polygon(part); });
      if (part > 0 && cells_.sites[part] != cells_.sites[part - 1])
        seen.clear();
      for (std::size_t k = cells_.begin(part); k < cells_.end(part); ++k)
        if (cells_.corners[k] < triangles_) {
          ++incidences;
          if (!seen.insert({cells_.sites[part], cells_.corners[k]}).second)
            wrong.note([&] { return polygon(part); });
        }
    }
    report_.none("cell_polygons", wrong,
                 "polygons that are not the circumcentres around their site, with the middles of edges and the site "
                 "where the boundary or another region begins");
    report_.equal("cell_duality", 3 * triangles_, incidences, "corners of triangles, each in one polygon");
  }

  std::string polygon(std::size_t part) const {
    return fmt::format("polygon {} of site {} at {}", part, cells_.sites[part], place_of(mesh_.at(cells_.sites[part])));
  }

  /// Returns the places of the corners of a polygon relative to its site.
  std::vector<Point> places_of(std::size_t part) const {
    const Point site = mesh_.at(cells_.sites[part]);
    std::vector<Point> places;
    for (std::size_t k = cells_.begin(part); k < cells_.end(part); ++k)
      places.push_back(mesh_.periods.near(cells_.vertex(cells_.corners[k]), site) - site);
    return places;
  }

  void check_areas() {
    Tally areas, centroids, empty;
    std::map<std::int64_t, Sum> found, wanted;
    Sum stored;
    for (std::size_t part = 0; part < cells_.parts(); ++part) {
      const std::vector<Point> places = places_of(part);
      double twice = 0;
      Point sum;
      for (std::size_t k = 0; k < places.size(); ++k) {
        const Point a = places[k] - places[0], b = places[(k + 1) % places.size()] - places[0];
        const double area = cross_of(a, b);
        twice += area;
        sum = sum + Point{area * (a.x + b.x), area * (a.y + b.y)};
      }
      const Point centroid = places[0] + Point{sum.x / (3 * twice), sum.y / (3 * twice)};
      const Point given = mesh_.periods.near({cells_.centroids[2 * part], cells_.centroids[2 * part + 1]},
                                             mesh_.at(cells_.sites[part])) -
                          mesh_.at(cells_.sites[part]);
      const double size = std::sqrt(std::fabs(twice));
      if (!(twice > 0))
        empty.note([&] { return polygon(part); });
      if (!(std::fabs(cells_.areas[part] - 0.5 * twice) <= place_tolerance * 0.5 * twice + size * rounding_))
        areas.note([&] { return polygon(part); });
      if (!(length_of(given - centroid) <= 1e-6 * size + rounding_))
        centroids.note([&] { return polygon(part); });
      found[cells_.regions[part]].add(cells_.areas[part]);
      stored.add(cells_.areas[part]);
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::array<Point, 3> c = mesh_.corners(mesh_.triangles[t]);
      const double area = 0.5 * cross_of(c[1] - c[0], c[2] - c[0]);
      wanted[mesh_.region[t]].add(area);
      wanted[0].add(area);
    }
    found[0] = stored;
    report_.none("cell_positive", empty, "polygons without an area");
    report_.none("cell_areas", areas, "polygons with another area than the file says");
    report_.none("cell_centroids", centroids, "polygons with another centroid than the file says");
    compare_areas(found, wanted);
  }

  void compare_areas(std::map<std::int64_t, Sum>& found, std::map<std::int64_t, Sum>& wanted) {
    Tally wrong;
    for (const auto& [region, sum] : wanted)
      if (!(std::fabs(found[region].total() - sum.total()) <=
            area_tolerance * sum.total() + 1000 * rounding_ * rounding_))
        wrong.note([&, number = region] {
          return fmt::format("{}: expected {:.17g}, found {:.17g}",
                             number == 0 ? "all cells" : fmt::format("region {}", number), wanted[number].total(),
                             found[number].total());
        });
    report_.none("cell_cover", wrong, "regions, and the whole mesh, with another area of cells than of triangles");
  }

  /// Sides of polygons lie in two of them, except halves of boundary edges; vertices - sides + polygons is the number
  /// of the mesh.
  void check_topology() {
    std::vector<Facet> sides;
    for (std::size_t part = 0; part < cells_.parts(); ++part)
      for (std::size_t k = cells_.begin(part); k < cells_.end(part); ++k)
        sides.push_back(
            ascending({cells_.corners[k], cells_.corners[k + 1 == cells_.end(part) ? cells_.begin(part) : k + 1]}));
    std::sort(sides.begin(), sides.end());
    std::int64_t single = 0, distinct = 0;
    for (std::size_t k = 0, next = 0; k < sides.size(); k = next) {
      next = static_cast<std::size_t>(
          std::upper_bound(sides.begin() + static_cast<std::ptrdiff_t>(k), sides.end(), sides[k]) - sides.begin());
      ++distinct;
      single += next - k == 1 ? 1 : 0;
    }
    std::vector<std::int64_t> used = cells_.corners;
    std::sort(used.begin(), used.end());
    const std::int64_t vertices = std::unique(used.begin(), used.end()) - used.begin();
    report_.equal("cell_vertices", std::ssize(cells_.vertices) / 2, vertices, "vertices that polygons use");
    report_.equal("cell_rim", 2 * std::ssize(mesh_.facets), single, "sides of one polygon: halves of boundary edges");
    const std::int64_t edges = (3 * triangles_ + std::ssize(mesh_.facets)) / 2;
    report_.equal("cell_euler", std::ssize(mesh_.points) - edges + triangles_,
                  vertices - distinct + static_cast<std::int64_t>(cells_.parts()),
                  "vertices - sides + polygons; that of the mesh is expected");
  }

  /// Lengths of a face by region, from the cotangents of the opposite angles.
  std::map<std::int64_t, double> lengths_of(const Side* from, const Side* to) const {
    std::map<std::int64_t, double> lengths;
    for (const Side* side = from; side != to; ++side) {
      const std::array<Point, 3> c = mesh_.corners(mesh_.triangles[side->triangle]);
      const Point apex = c[side->corner], a = c[(side->corner + 1U) % 3] - apex, b = c[(side->corner + 2U) % 3] - apex;
      lengths[mesh_.region[side->triangle]] +=
          0.5 * length_of(b - a) * (a.x * b.x + a.y * b.y) / std::fabs(cross_of(a, b));
    }
    return lengths;
  }

  void check_faces() {
    Tally wrong, values, negative;
    const std::vector<Side> sides = sides_of(mesh_);
    std::vector<std::pair<Facet, std::size_t>> rows;
    for (std::size_t f = 0; f < cells_.distances.size(); ++f)
      rows.push_back({{cells_.faces[2 * f], cells_.faces[2 * f + 1]}, f});
    std::sort(rows.begin(), rows.end());
    std::size_t row = 0;
    for (std::size_t k = 0, next = 0; k < sides.size(); k = next, ++row) {
      for (next = k + 1; next < sides.size() && sides[next].is_same_edge(sides[k]);)
        ++next;
      const Facet edge{sides[k].low, sides[k].high};
      if (row >= rows.size() || rows[row].first != edge) {
        wrong.note([&] { return place_of(mesh_, edge); });
        break;
      }
      check_face(edge, rows[row].second, lengths_of(&sides[k], sides.data() + next), values, negative);
    }
    if (wrong.count == 0 && row != rows.size())
      wrong.note([&] { return fmt::format("{} faces, expected {}", rows.size(), row); });
    report_.none("cell_faces", wrong, "edges of the mesh without a face in the list, or faces that are not an edge");
    report_.none("cell_lengths", values, "faces with other lengths, distances or regions than the triangles give");
    report_.none("cell_negative", negative, "faces with a negative length");
  }

  void check_face(const Facet& edge, std::size_t face, const std::map<std::int64_t, double>& wanted, Tally& values,
                  Tally& negative) const {
    const double distance = length_of(mesh_.periods.near(mesh_.at(edge[1]), mesh_.at(edge[0])) - mesh_.at(edge[0]));
    const double room = place_tolerance * distance + rounding_;
    std::map<std::int64_t, double> found;
    for (std::size_t k = 0; k < 2; ++k)
      if (cells_.face_regions[2 * face + k] != 0)
        found[cells_.face_regions[2 * face + k]] = cells_.lengths[2 * face + k];
    bool is_right = std::fabs(cells_.distances[face] - distance) <= room && found.size() == wanted.size();
    for (const auto& [region, length] : wanted)
      is_right = is_right && found.contains(region) && std::fabs(found[region] - length) <= room;
    if (!is_right)
      values.note([&] { return place_of(mesh_, edge); });
    for (const auto& [region, length] : found)
      if (!(length >= -(1e-12 * distance + rounding_)))
        negative.note([&] { return place_of(mesh_, edge); });
  }

  /// A circumcentre lies in its region if no angle opposite to an edge on the boundary or between regions is obtuse.
  void check_chords() {
    Tally outside;
    const std::vector<Side> sides = sides_of(mesh_);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto is_inner = [&](const Side& other) {
        return other.is_same_edge(sides[k]) && mesh_.region[other.triangle] == mesh_.region[sides[k].triangle];
      };
      if ((k > 0 && is_inner(sides[k - 1])) || (k + 1 < sides.size() && is_inner(sides[k + 1])))
        continue;
      if (mesh_.cosine(mesh_.triangles[sides[k].triangle], sides[k].corner) < least_cosine)
        outside.note([&] { return place_of(mesh_, sides[k].triangle); });
    }
    report_.none("cell_outside", outside, "circumcentres behind a boundary edge, or behind an edge between regions");
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  Report& report_;
  std::int64_t triangles_;
  double rounding_ = 0;
  Cells cells_;
};

} // namespace

void check_cells(const StoredFile& file, const Mesh& mesh, Report& report) {
  if (file.has("/Cells"))
    CellChecks(file, mesh, report).run();
}

} // namespace trime_check
