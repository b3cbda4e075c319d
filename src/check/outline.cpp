// SPDX-License-Identifier: BSD-3-Clause
#include "outline.hpp"

#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace trime_check {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;

/// The polygons to which an edge belongs, once for each time that they run along it.
using Owners = std::vector<int>;

struct JoinOwners {
  Owners operator()(Owners a, const Owners& b) const {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }
};

using Traits = CGAL::Arr_curve_data_traits_2<CGAL::Arr_segment_traits_2<Kernel>, Owners, JoinOwners>;
/// A face knows whether the union covers it.
enum class Cover : char { unknown, outside, inside };
using Arrangement = CGAL::Arrangement_2<Traits, CGAL::Arr_face_extended_dcel<Traits, Cover>>;
using Halfedge = Arrangement::Halfedge_handle;

/// The edges of polygons, divided where they meet.
class Outline {
public:
  Outline(const std::vector<Ring>& rings, const std::vector<int>& polygon) {
    std::vector<Traits::Curve_2> edges;
    for (std::size_t r = 0; r < rings.size(); ++r)
      for (std::size_t k = 0; k < rings[r].size(); ++k) {
        const Point a = rings[r][k], b = rings[r][(k + 1) % rings[r].size()];
        if (a.x != b.x || a.y != b.y)
          edges.emplace_back(Kernel::Segment_2({a.x, a.y}, {b.x, b.y}), Owners{polygon[r]});
      }
    CGAL::insert(arrangement_, edges.begin(), edges.end());
    for (auto face = arrangement_.faces_begin(); face != arrangement_.faces_end(); ++face)
      face->set_data(Cover::unknown);
    cover();
  }

  std::vector<Ring> rings() {
    std::vector<Ring> found;
    std::set<const void*> used;
    for (auto edge = arrangement_.halfedges_begin(); edge != arrangement_.halfedges_end(); ++edge) {
      if (!is_outline(edge) || used.count(&*edge) > 0)
        continue;
      Ring& ring = found.emplace_back();
      for (Halfedge at = edge; used.insert(&*at).second; at = after(at))
        ring.push_back({CGAL::to_double(at->source()->point().x()), CGAL::to_double(at->source()->point().y())});
    }
    return found;
  }

private:
  struct Visit {
    Arrangement::Face_handle face;
    std::set<int> around; // polygons that cover the face
  };

  /// Goes from face to face, from the unbounded one.
  void cover() {
    std::vector<Visit> visits{{arrangement_.unbounded_face(), {}}};
    visits[0].face->set_data(Cover::outside);
    while (!visits.empty()) {
      const Visit visit = std::move(visits.back());
      visits.pop_back();
      const auto look_around = [&](Arrangement::Ccb_halfedge_circulator edge) {
        const auto first = edge;
        do
          cross(edge, visit.around, visits);
        while (++edge != first);
      };
      for (auto ccb = visit.face->outer_ccbs_begin(); ccb != visit.face->outer_ccbs_end(); ++ccb)
        look_around(*ccb);
      for (auto ccb = visit.face->inner_ccbs_begin(); ccb != visit.face->inner_ccbs_end(); ++ccb)
        look_around(*ccb);
    }
  }

  static void cross(Halfedge edge, std::set<int> around, std::vector<Visit>& visits) {
    const Arrangement::Face_handle other = edge->twin()->face();
    if (other->data() != Cover::unknown)
      return;
    for (const int owner : edge->curve().data())
      if (!around.insert(owner).second)
        around.erase(owner);
    other->set_data(around.empty() ? Cover::outside : Cover::inside);
    visits.push_back({other, std::move(around)});
  }

  static bool is_outline(Halfedge edge) {
    return edge->face()->data() == Cover::inside && edge->twin()->face()->data() == Cover::outside;
  }

  /// The next edge of the outline around the same sector of what is inside.
  static Halfedge after(Halfedge edge) {
    Halfedge next = edge->next();
    while (!is_outline(next))
      next = next->twin()->next();
    return next;
  }

  Arrangement arrangement_;
};

} // namespace

std::vector<Ring> outline(const std::vector<Ring>& rings, const std::vector<int>& polygon) {
  return Outline(rings, polygon).rings();
}

std::vector<Point> new_vertices(const std::vector<Ring>& outline, const std::vector<Ring>& input) {
  std::set<std::pair<double, double>> known;
  for (const Ring& ring : input)
    for (const Point p : ring)
      known.emplace(p.x, p.y);
  std::vector<Point> found;
  for (const Ring& ring : outline)
    for (const Point p : ring)
      if (known.count({p.x, p.y}) == 0)
        found.push_back(p);
  return found;
}

void drop_narrow_holes(std::vector<Ring>& rings, double width) {
  std::erase_if(rings, [width](const Ring& ring) {
    double twice_area = 0, length = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k] - ring[0], b = ring[(k + 1) % ring.size()] - ring[0];
      twice_area += a.x * b.y - a.y * b.x;
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
    return twice_area < 0 && -twice_area < width * length;
  });
}

} // namespace trime_check
