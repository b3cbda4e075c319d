// SPDX-License-Identifier: BSD-3-Clause
#include "contours/ring_repair.hpp"

#include "contours/faults.hpp"
#include "contours/map_features.hpp"
#include "contours/rules.hpp"
#include "geometry/box_tree.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace trime::contours {
namespace {

using geometry::Box;
using geometry::cross;
using geometry::dot;
using geometry::Vec2;

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// A vertex of the ring after edges were divided; the edge to the next one has its line and marker.
struct Corner {
  Vec2 place;
  std::size_t vertex; // of the given ring: this one, or the start of the edge that was divided
};

/// The ring with vertices on its edges.
std::vector<Corner> divided(const ContourRing& ring, double tolerance) {
  const std::vector<Vec2>& p = ring.points;
  const std::size_t n = p.size();
  std::vector<Box> boxes;
  for (const Vec2 point : p)
    boxes.push_back({point, point});
  const geometry::BoxTree tree(boxes);
  std::vector<Corner> corners;
  std::vector<std::pair<double, std::size_t>> on_edge; // along it
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = p[k], b = p[(k + 1) % n], d = b - a;
    corners.push_back({a, k});
    Box box;
    box.include(a);
    box.include(b);
    box = {box.min - Vec2{tolerance, tolerance}, box.max + Vec2{tolerance, tolerance}};
    on_edge.clear();
    const double whole = squared_length(d);
    tree.for_each_meeting(box, [&](std::size_t j) {
      const Vec2 u = p[j] - a;
      const double along = dot(u, d);
      if (p[j] != a && p[j] != b && along > 0 && along < whole &&
          std::fabs(cross(d, u)) <= tolerance * std::sqrt(whole))
        on_edge.emplace_back(along, j);
    });
    std::sort(on_edge.begin(), on_edge.end());
    for (const auto& [along, j] : on_edge)
      if (corners.back().place != p[j])
        corners.push_back({p[j], k});
  }
  return corners;
}

/// Edge k leads from corner k to the next one.
class Seams {
public:
  explicit Seams(std::vector<Corner> corners) : corners_(std::move(corners)), partner_(corners_.size(), none) {
    std::vector<std::size_t> order(corners_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      const std::array<double, 4> x = key(a), y = key(b);
      return x != y ? x < y : a < b;
    });
    std::vector<std::size_t> open; // edges between the same two places, all in one direction
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k == 0 || key(order[k]) != key(order[k - 1]))
        open.clear();
      if (!open.empty() && place(open.back()) != place(order[k])) {
        partner_[order[k]] = open.back();
        partner_[open.back()] = order[k];
        open.pop_back();
      } else {
        open.push_back(order[k]);
      }
    }
  }

  bool any() const {
    return std::any_of(partner_.begin(), partner_.end(), [](std::size_t edge) { return edge != none; });
  }

  std::vector<ContourRing> rings(const ContourRing& given) const {
    std::vector<ContourRing> rings;
    std::vector<char> used(corners_.size(), 0);
    for (std::size_t first = 0; first < corners_.size(); ++first) {
      if (used[first] != 0 || partner_[first] != none)
        continue;
      ContourRing ring;
      ring.polygon = given.polygon;
      for (std::size_t edge = first; used[edge] == 0; edge = after_seams(edge)) {
        used[edge] = 1;
        ring.points.push_back(place(edge));
        ring.lines.push_back(given.lines[corners_[edge].vertex]);
        if (!given.markers.empty())
          ring.markers.push_back(given.markers[corners_[edge].vertex]);
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

  /// One for each tip, and one for each group of edges without a tip.
  std::vector<Seam> list() const {
    std::vector<char> seen(corners_.size(), 0);
    std::vector<Seam> seams;
    for (std::size_t first = 0; first < corners_.size(); ++first) {
      if (seen[first] != 0 || partner_[first] == none)
        continue;
      std::vector<std::size_t> group{first}, tips;
      seen[first] = 1;
      for (std::size_t k = 0; k < group.size(); ++k) {
        const std::size_t edge = group[k];
        if (partner_[edge] == next(edge))
          tips.push_back(next(edge));
        for (const std::size_t other : {partner_[edge], next(edge)})
          if (partner_[other] != none && seen[other] == 0) {
            seen[other] = 1;
            group.push_back(other);
          }
      }
      for (const std::size_t tip : tips)
        seams.push_back({corners_[tip].vertex, place(tip), true});
      if (tips.empty())
        seams.push_back({corners_[first].vertex, place(first), false});
    }
    std::stable_sort(seams.begin(), seams.end(), [](const Seam& a, const Seam& b) { return a.vertex < b.vertex; });
    return seams;
  }

private:
  Vec2 place(std::size_t corner) const { return corners_[corner].place; }
  std::size_t next(std::size_t edge) const { return edge + 1 == corners_.size() ? 0 : edge + 1; }
  /// The edge that follows once the cancelled ones are gone.
  std::size_t after_seams(std::size_t edge) const {
    std::size_t following = next(edge);
    while (partner_[following] != none)
      following = next(partner_[following]);
    return following;
  }
  /// Equal for edges between the same two places.
  std::array<double, 4> key(std::size_t edge) const {
    Vec2 a = place(edge), b = place(next(edge));
    if (geometry::lexicographically_less(b, a))
      std::swap(a, b);
    return {a.x, a.y, b.x, b.y};
  }

  std::vector<Corner> corners_;
  std::vector<std::size_t> partner_; // the edge that cancels each edge
};

} // namespace

RepairedRing repair_ring(const ContourRing& ring, double tolerance) {
  const Seams seams(divided(ring, tolerance));
  if (!seams.any())
    return {{ring}, {}};
  return {seams.rings(ring), seams.list()};
}

void add_faults(FaultList& faults, const RepairedRing& repaired, const ContourRing& ring, const PlaceText& text) {
  if (repaired.rings.empty()) {
    add_fault(faults, HasArea::no, [&]() -> Fault {
      return {text.where(ring.lines[0]),
              fmt::format("the ring that starts here at {} encloses no area", text.point(ring.points[0])),
              "remove the ring", "the ring is left out"};
    });
    return;
  }
  for (const Seam& seam : repaired.seams)
    add_fault(faults, HasArea::no, [&]() -> Fault {
      const std::string where = text.where(ring.lines[seam.vertex]), place = text.point(seam.place);
      if (seam.is_spike)
        return {
            where,
            fmt::format("the ring turns straight back at {}: the edges before and after this vertex overlap", place),
            "remove the spike", "the spike is removed"};
      return {
          where,
          fmt::format("the ring runs along an edge in both directions near {}, as if to reach an inner ring", place),
          "make the inner ring a separate ring", "the two edges are removed"};
    });
}

void repair_rings(Contour& contour) {
  const PlaceText text{[&](int line) { return where(contour, line); },
                       [](Vec2 p) { return fmt::format("({}, {})", p.x, p.y); }};
  std::vector<ContourRing> rings;
  for (ContourRing& ring : contour.rings) {
    Box box;
    for (const Vec2 p : ring.points)
      box.include(p);
    RepairedRing repaired = repair_ring(ring, ContourRules::repaired_share * std::fmax(box.width(), box.height()));
    if (repaired.seams.empty()) {
      rings.push_back(std::move(ring));
      continue;
    }
    add_faults(contour.faults, repaired, ring, text);
    for (ContourRing& left : repaired.rings)
      rings.push_back(std::move(left));
  }
  contour.rings = std::move(rings);
}

} // namespace trime::contours
