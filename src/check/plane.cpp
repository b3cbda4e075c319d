// SPDX-License-Identifier: BSD-3-Clause
#include "plane.hpp"

#include "curve.hpp"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace trime_check {
namespace {

constexpr double straight = 1e-9; // [longer side of the rings] an edge in the plane may be so far from its curve
constexpr int most_halvings = 14;
constexpr double half_circle = 180, across = 270; // [degrees] wider edges lead across the date line
constexpr double on_meridian = 1e-9;              // [degrees]

struct Close {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Object = std::unique_ptr<PJ, Close>;

class Projection {
public:
  Projection(const std::string& from, const std::string& to) : context_(proj_context_create()) {
    proj_log_level(context_.get(), PJ_LOG_NONE);
    proj_context_set_enable_network(context_.get(), 0);
    const Object source = system(from.empty() ? "OGC:CRS84" : from), target = system(to);
    if (!source || !target)
      return;
    const Object unbound(proj_get_type(source.get()) == PJ_TYPE_BOUND_CRS
                             ? proj_get_source_crs(context_.get(), source.get())
                             : proj_clone(context_.get(), source.get()));
    const PJ_TYPE type = unbound ? proj_get_type(unbound.get()) : PJ_TYPE_UNKNOWN;
    is_geographic_ = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
    const Object way(proj_create_crs_to_crs_from_pj(context_.get(), source.get(), target.get(), nullptr, nullptr));
    if (way)
      way_.reset(proj_normalize_for_visualization(context_.get(), way.get()));
  }

  bool is_known() const { return way_ != nullptr; }
  bool is_geographic() const { return is_geographic_; }

  std::optional<Point> apply(Point p) const {
    proj_errno_reset(way_.get());
    const PJ_COORD found = proj_trans(way_.get(), PJ_FWD, proj_coord(p.x, p.y, 0, 0));
    if (!std::isfinite(found.xy.x) || !std::isfinite(found.xy.y))
      return std::nullopt;
    return Point{found.xy.x, found.xy.y};
  }

private:
  Object system(const std::string& name) const {
    const bool is_plain = name.starts_with("+") && name.find("+type=crs") == std::string::npos;
    Object found(proj_create(context_.get(), (is_plain ? name + " +type=crs" : name).c_str()));
    return found && proj_is_crs(found.get()) ? std::move(found) : Object();
  }

  std::unique_ptr<PJ_CONTEXT, Close> context_;
  Object way_;
  bool is_geographic_ = false;
};

double distance_from_side(Point p, Point a, Point b) {
  const Point d = b - a, u = p - a;
  const double whole = d.x * d.x + d.y * d.y;
  const double share = whole > 0 ? std::clamp((u.x * d.x + u.y * d.y) / whole, 0.0, 1.0) : 0;
  return std::hypot(u.x - share * d.x, u.y - share * d.y);
}

/// Follows the edges of rings in the plane.
class EdgeFollower {
public:
  EdgeFollower(const Projection& projection, double allowed) : projection_(projection), allowed_(allowed) {}

  /// Appends the inner vertices of an edge. @return whether all of them have a place in the plane
  bool follow(Point from, Point to, Ring& ring) const {
    if (projection_.is_geographic() && std::fabs(to.x - from.x) > across)
      to.x -= to.x > from.x ? 2 * half_circle : -2 * half_circle;
    const std::optional<Point> a = projection_.apply(from), b = projection_.apply(to);
    return a && b && halve({from, *a}, {to, *b}, most_halvings, ring);
  }

private:
  struct End {
    Point in_file, in_plane;
  };

  bool halve(const End& a, const End& b, int halvings, Ring& ring) const {
    bool leaves = false;
    for (const double share : {0.25, 0.5, 0.75}) {
      const std::optional<Point> p = projection_.apply(between(a, b, share));
      if (!p)
        return false;
      leaves = leaves || distance_from_side(*p, a.in_plane, b.in_plane) > allowed_;
    }
    if (!leaves || halvings == 0)
      return true;
    const Point middle = between(a, b, 0.5);
    const End end{middle, *projection_.apply(middle)};
    if (!halve(a, end, halvings - 1, ring))
      return false;
    ring.push_back(end.in_plane);
    return halve(end, b, halvings - 1, ring);
  }

  static Point between(const End& a, const End& b, double share) {
    return {a.in_file.x + share * (b.in_file.x - a.in_file.x), a.in_file.y + share * (b.in_file.y - a.in_file.y)};
  }

  const Projection& projection_;
  double allowed_;
};

bool has_edge_on_date_line(const std::vector<Ring>& rings) {
  const auto is_on = [](Point p) { return std::fabs(std::fabs(p.x) - half_circle) <= on_meridian; };
  return std::ranges::any_of(rings, [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      if (is_on(ring[k]) && is_on(ring[(k + 1) % ring.size()]))
        return true;
    return false;
  });
}

std::optional<std::vector<Point>> project_with(const Projection& projection, const std::vector<Point>& points) {
  std::vector<Point> found;
  for (const Point p : points) {
    const std::optional<Point> place = projection.apply(p);
    if (!place)
      return std::nullopt;
    found.push_back(*place);
  }
  return found;
}

} // namespace

DateLine unroll(std::vector<Ring>& rings, const std::string& from) {
  if (!Projection(from, "OGC:CRS84").is_geographic() || !has_edge_on_date_line(rings))
    return DateLine::free;
  std::vector<std::pair<double, double>> ranges; // of longitudes
  for (const Ring& ring : rings) {
    const Box box = box_of({ring});
    ranges.emplace_back(box.min.x, box.max.x);
  }
  std::ranges::sort(ranges);
  double reached = ranges[0].second;
  const auto free = std::ranges::find_if(ranges, [&](const auto& range) {
    if (range.first > reached)
      return true;
    reached = std::max(reached, range.second);
    return false;
  });
  if (free == ranges.end())
    return DateLine::closed;
  for (Ring& ring : rings)
    if (box_of({ring}).max.x <= reached)
      for (Point& p : ring)
        p.x = std::fabs(p.x + half_circle) <= on_meridian ? half_circle : p.x + 2 * half_circle;
  for (Ring& ring : rings)
    for (Point& p : ring)
      if (std::fabs(p.x - half_circle) <= on_meridian)
        p.x = half_circle;
  return DateLine::unrolled;
}

ProjectedRings project(const std::vector<Ring>& rings, const std::string& from, const std::string& to) {
  const Projection projection(from, to);
  if (!projection.is_known())
    return {{}, false, "PROJ does not know the reference systems of contour and mesh"};
  const ProjectedRings outside{{}, false, "a vertex has no place in the plane of the mesh"};
  ProjectedRings found;
  for (const Ring& ring : rings) {
    std::optional<Ring> plain = project_with(projection, ring);
    if (!plain)
      return outside;
    found.rings.push_back(std::move(*plain));
  }
  const Box box = box_of(found.rings);
  const EdgeFollower follower(projection, straight * std::max(box.max.x - box.min.x, box.max.y - box.min.y));
  for (std::size_t r = 0; r < rings.size(); ++r) {
    Ring whole;
    for (std::size_t k = 0; k < rings[r].size(); ++k) {
      whole.push_back(found.rings[r][k]);
      if (!follower.follow(rings[r][k], rings[r][(k + 1) % rings[r].size()], whole))
        return outside;
    }
    found.bent = found.bent || whole.size() > found.rings[r].size();
    found.rings[r] = std::move(whole);
  }
  return found;
}

std::optional<std::vector<Point>> project(const std::vector<Point>& points, const std::string& from,
                                          const std::string& to) {
  const Projection projection(from, to);
  return projection.is_known() ? project_with(projection, points) : std::nullopt;
}

} // namespace trime_check
