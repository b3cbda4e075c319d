// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "exact.hpp"
#include "topology.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace trime_check {
namespace {

/// All that looks at the triangles and facets together.
class Surface {
public:
  /// @param prefix stands before the names of the checks
  Surface(const StoredFile& file, const Mesh& mesh, const std::string& prefix, Report& report)
      : file_(file), mesh_(mesh), prefix_(prefix), report_(report), plane_(mesh) {}

  Counted run() {
    check_orientation();
    check_edges();
    check_points();
    follow_loops();
    check_euler();
    check_area();
    if (prefix_.empty())
      check_tags();
    check_fixed();
    check_depth();
    if (loops_are_sound_)
      counted_.boundary = std::move(loops_);
    return counted_;
  }

private:
  void check_orientation() {
    Tally clockwise;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [a, b, c] = mesh_.corners(mesh_.triangles[t]);
      if (!is_left_turn(a, b, c))
        clockwise.note([&] { return place_of(mesh_, t); });
      twice_area_ += plane_.twice_area(a, b, c);
    }
    counted_.clockwise = clockwise.count;
    counted_.area = plane_.area(twice_area_);
    report_.none(prefix_ + "orientation", clockwise, "triangles that are flat or clockwise (CGAL, exact)");
  }

  /// Returns the corner of the other triangle at an inner edge, as the image next to the corners of this one.
  bool is_delaunay(const Side& one, const Side& other) const {
    const auto [a, b, c] = mesh_.corners(mesh_.triangles[one.triangle]);
    const std::int64_t apex = mesh_.triangles[other.triangle][other.corner];
    // Across the edge from the corner one.corner: of its images the one that the other triangle has.
    const Point start = std::array{a, b, c}[(one.corner + 1) % 3];
    const Point d = mesh_.periods.near(mesh_.at(apex), start);
    return !is_left_turn(a, b, c) || !is_inside_circle(a, b, c, d);
  }

  void check_edges() {
    const std::vector<Side> sides = sides_of(mesh_);
    Tally crowded, not_delaunay, not_facets, without_triangle;
    std::set<Facet> facets(mesh_.facets.begin(), mesh_.facets.end()), rim;
    for (std::size_t k = 0; k < sides.size();) {
      std::size_t end = k;
      while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high)
        ++end;
      ++counted_.edges;
      const Facet edge{sides[k].low, sides[k].high};
      const bool pair = end - k == 2 && sides[k].forward != sides[k + 1].forward;
      if (end - k > 2 || (end - k == 2 && !pair))
        crowded.note([&] { return place_of(mesh_, edge); });
      if (end - k == 1)
        rim.insert(sides[k].forward ? edge : Facet{edge[1], edge[0]});
      if (pair && !is_delaunay(sides[k], sides[k + 1]))
        not_delaunay.note([&] { return place_of(mesh_, edge); });
      k = end;
    }
    for (const Facet& edge : rim)
      if (!facets.contains(edge))
        not_facets.note([&] { return place_of(mesh_, edge); });
    for (const Facet& facet : facets)
      if (!rim.contains(facet))
        without_triangle.note([&] { return place_of(mesh_, facet); });
    for (std::size_t k = facets.size(); k < mesh_.facets.size(); ++k)
      without_triangle.note([] { return std::string("a facet that is listed twice"); });
    counted_.not_delaunay = not_delaunay.count;
    report_.none(prefix_ + "manifold", crowded,
                 "edges with more than two triangles, or with two triangles on the same side");
    report_.none(prefix_ + "delaunay", not_delaunay, "inner edges that are not locally Delaunay (CGAL, exact)");
    report_.none(prefix_ + "rim", not_facets, "edges with only one triangle that are not facets");
    report_.none(prefix_ + "facets", without_triangle,
                 "facets that do not have exactly one triangle, or have it on their right side");
  }

  void check_points() {
    Components components(mesh_.points.size());
    std::vector<char> used(mesh_.points.size(), 0);
    for (const Triangle& t : mesh_.triangles)
      for (const std::int64_t id : t) {
        used[static_cast<std::size_t>(id)] = 1;
        components.join(t[0], id);
      }
    Tally unused;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i])
        unused.note([&] { return fmt::format("point {} at {}", i, place_of(mesh_.points[i])); });
      else
        counted_.components += components.root(static_cast<std::int64_t>(i)) == static_cast<std::int64_t>(i);
    }
    counted_.unused = unused.count;
    report_.none(prefix_ + "unused_points", unused, "points without a triangle");
  }

  void follow_loops() {
    std::map<std::int64_t, std::size_t> from;
    Tally branches, open;
    for (std::size_t k = 0; k < mesh_.facets.size(); ++k)
      if (!from.emplace(mesh_.facets[k][0], k).second)
        branches.note([&] { return place_of(mesh_, mesh_.facets[k]); });
    std::vector<char> seen(mesh_.facets.size(), 0);
    for (std::size_t first = 0; first < seen.size(); ++first) {
      Loop loop;
      for (std::size_t k = first; !seen[k];) {
        seen[k] = 1;
        loop.facets.push_back(k);
        const auto next = from.find(mesh_.facets[k][1]);
        if (next == from.end())
          break;
        k = next->second;
      }
      if (loop.facets.empty())
        continue;
      if (mesh_.facets[loop.facets.back()][1] != mesh_.facets[first][0])
        open.note([&] { return place_of(mesh_, mesh_.facets[loop.facets.back()]); });
      loops_.push_back(std::move(loop));
    }
    counted_.loops = std::ssize(loops_);
    loops_are_sound_ = branches.count == 0 && open.count == 0;
    report_.none(prefix_ + "simple_loops", branches, "points at which two loops of facets meet");
    report_.none(prefix_ + "closed_loops", open, "chains of facets that do not return to their start");
  }

  /// A surface of the plane or of a strip: 2 for each component, less 1 for each loop. A torus may have a handle.
  void check_euler() {
    counted_.euler_characteristic =
        std::ssize(mesh_.points) - counted_.unused - counted_.edges + std::ssize(mesh_.triangles);
    std::int64_t expected = 2 * counted_.components - counted_.loops;
    if (mesh_.periods.x > 0 && mesh_.periods.y > 0 && counted_.euler_characteristic == expected - 2)
      expected -= 2;
    report_.equal(prefix_ + "euler", expected, counted_.euler_characteristic,
                  fmt::format("points - edges + triangles of {} components with {} boundary loops", counted_.components,
                              counted_.loops));
  }

  Point step(std::size_t facet) const {
    const Point a = mesh_.at(mesh_.facets[facet][0]);
    return mesh_.periods.near(mesh_.at(mesh_.facets[facet][1]), a) - a;
  }

  /// @brief Returns twice the area on the left of a loop, which shows its kind; unrolled in a periodic container. A
  /// loop that winds around it gets the area between it and a fixed point: the sum over all loops is that of the
  /// region, except for whole containers.
  Integer twice_area_left_of(Loop& loop) const {
    const Point origin = mesh_.at(mesh_.facets[loop.facets[0]][0]);
    Integer area = 0;
    Point at = origin;
    for (const std::size_t k : loop.facets) {
      const Point to = at + step(k);
      area += plane_.twice_area(origin, at, to);
      at = to;
    }
    const Point winding = at - origin;
    loop.kind = winding.x != 0 || winding.y != 0 ? "band" : area > 0 ? "outer" : "hole";
    return area + 2 * plane_.cross(origin - mesh_.points[0], winding);
  }

  void check_area() {
    if (!loops_are_sound_) {
      report_.skip(prefix_ + "area", "the facets do not form closed loops without crossings");
      return;
    }
    Integer polygon = 0, triangles = twice_area_;
    for (Loop& loop : loops_)
      polygon += twice_area_left_of(loop);
    if (mesh_.periods.x > 0 && mesh_.periods.y > 0) {
      const Integer whole = 2 * plane_.cross({mesh_.periods.x, 0}, {0, mesh_.periods.y});
      polygon = ((polygon % whole) + whole) % whole;
      if (polygon == 0)
        polygon = whole;
    }
    report_.add(prefix_ + "area", polygon == triangles, fmt::format("{:.17g}", plane_.area(polygon)),
                fmt::format("{:.17g}", plane_.area(triangles)),
                "area inside the loops of facets, compared with the sum over the triangles (Boost, exact integers)");
  }

  void check_tags() {
    const std::vector<double> ids = file_.column("/trime_mpi/tags/edge_id");
    const std::vector<double> counts = file_.column("/trime_mpi/tags/edge_count");
    const std::vector<double> lengths = file_.column("/trime_mpi/tags/edge_length_sum");
    const std::size_t curves = file_.names("/trime_mpi/curves/curve_name").size();
    const std::size_t parts =
        file_.names("/trime_mpi/tags/part_name").size() + (mesh_.split_pairs.empty() ? 0 : curves);
    Tally wrong;
    std::set<std::int64_t> seen;
    std::map<double, std::size_t> rows;
    for (std::size_t row = 0; row < ids.size(); ++row)
      rows.emplace(ids[row], row);
    for (const Loop& loop : loops_) {
      const std::int64_t tag = mesh_.facet_tags[loop.facets[0]];
      double length = 0;
      for (const std::size_t k : loop.facets) {
        length += std::hypot(step(k).x, step(k).y);
        const std::int64_t part = mesh_.facet_parts[k];
        if (mesh_.facet_tags[k] != tag || part < 0 || part >= static_cast<std::int64_t>(parts))
          wrong.note([&] { return fmt::format("tag or part of facet {}: {}", k, place_of(mesh_, mesh_.facets[k])); });
      }
      const auto known = rows.find(static_cast<double>(tag));
      const std::size_t row = known == rows.end() ? ids.size() : known->second;
      if (row >= std::min({ids.size(), counts.size(), lengths.size()}) || !seen.insert(tag).second ||
          counts[row] != static_cast<double>(loop.facets.size()) || std::fabs(lengths[row] - length) > 1e-9 * length)
        wrong.note([&] {
          return fmt::format("loop of tag {}, {} facets, length {:.12g}: no such row in /trime_mpi/tags", tag,
                             loop.facets.size(), length);
        });
    }
    if (ids.size() != loops_.size())
      wrong.note([&] { return fmt::format("/trime_mpi/tags has {} loops, the mesh {}", ids.size(), loops_.size()); });
    report_.none(
        prefix_ + "tags", wrong,
        "facets and loops with a tag that another loop has, too, or with a tag that differs from /trime_mpi/tags");
    check_boundary_array();
  }

  void check_boundary_array() {
    std::vector<std::int64_t> expected(mesh_.points.size(), 0);
    for (const Loop& loop : loops_)
      for (const std::size_t k : loop.facets)
        expected[static_cast<std::size_t>(mesh_.facets[k][0])] = mesh_.facet_tags[k];
    Tally wrong;
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (mesh_.boundary[i] != expected[i])
        wrong.note([&] {
          return fmt::format("point {} at {}: expected {}, found {}", i, place_of(mesh_.points[i]), expected[i],
                             mesh_.boundary[i]);
        });
    report_.none(prefix_ + "boundary_array", wrong,
                 "points whose value in `boundary` is not the tag of their loop (for inner points: 0)");
  }

  void check_fixed() {
    Tally wrong;
    for (std::size_t i = 0; i < mesh_.fixed.size(); ++i) {
      if (mesh_.fixed[i] != 0 && mesh_.fixed[i] != 1)
        wrong.note([&] { return fmt::format("point {}: {}", i, mesh_.fixed[i]); });
      counted_.corners += mesh_.fixed[i] == 1 && mesh_.boundary[i] != 0;
    }
    report_.none(prefix_ + "fixed_array", wrong, "values of `fixed` that are neither 0 nor 1");
  }

  void check_depth() {
    if (mesh_.depth.empty())
      return;
    Tally wrong;
    for (std::size_t i = 0; i < mesh_.depth.size(); ++i)
      if (!std::isfinite(mesh_.depth[i]))
        wrong.note([&] { return fmt::format("point {} at {}", i, place_of(mesh_.points[i])); });
    report_.none(prefix_ + "depth_array", wrong, "points whose depth is not a number");
  }

  const StoredFile& file_;
  const Mesh& mesh_;
  const std::string prefix_;
  Report& report_;
  IntegerPlane plane_;
  Counted counted_;
  Integer twice_area_ = 0;
  std::vector<Loop> loops_;
  bool loops_are_sound_ = false;
};

} // namespace

Counted check_surface(const StoredFile& file, const Mesh& mesh, Report& report) {
  return Surface(file, mesh, "", report).run();
}

Counted check_joined_surface(const StoredFile& file, const Mesh& joined, Report& report) {
  return Surface(file, joined, "joined_", report).run();
}

} // namespace trime_check
