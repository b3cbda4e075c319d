// SPDX-License-Identifier: BSD-3-Clause
#include "shape/contour_messages.hpp"

#include "contours/map_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trime::shape {
namespace {

using contours::line_or_feature;
using contours::where;
using geometry::cross;
using geometry::dot;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

constexpr std::size_t most_told = 5; // warnings of a kind
constexpr double half_turn = 180;    // [degrees] an edge that is wider leads across the date line

bool in_box_of(const Segment& s, Vec2 p) {
  return p.x >= std::fmin(s.a.x, s.b.x) && p.x <= std::fmax(s.a.x, s.b.x) && p.y >= std::fmin(s.a.y, s.b.y) &&
         p.y <= std::fmax(s.a.y, s.b.y);
}

/// A point that both segments have, to within rounding; for messages only.
Vec2 meeting_point(const Segment& s, const Segment& t) {
  const Vec2 d = s.b - s.a, e = t.b - t.a;
  const double determinant = cross(d, e);
  if (determinant == 0)
    return in_box_of(s, t.a) ? t.a : in_box_of(s, t.b) ? t.b : s.a;
  return s.a + (cross(t.a - s.a, e) / determinant) * d;
}

/// Returns whether a ring of longitudes and latitudes jumps from one side of the meridian of 180 degrees to the other.
bool crosses_date_line(const std::vector<Vec2>& ring) {
  constexpr double largest_longitude = 2 * half_turn, largest_latitude = 0.5 * half_turn;
  bool jumps = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 here = ring[k], next = ring[k + 1 < ring.size() ? k + 1 : 0];
    if (std::fabs(here.x) > largest_longitude || std::fabs(here.y) > largest_latitude)
      return false;
    jumps = jumps || std::fabs(here.x - next.x) > half_turn;
  }
  return jumps;
}

/// Returns what a user can do where edges of a file of lines meet.
/// @param same both edges belong to one ring
const char* remedy_of_lines(bool same, bool crossing) {
  if (same)
    return crossing ? "a ring must not cross itself; is a blank line between two rings missing?"
                    : "a ring touches itself; is a blank line between two rings missing?";
  return crossing ? "two rings must not cross; to join areas, make each one a separate part and unite them in "
                    "'geometry', or dissolve their common borders first, as QGIS does"
                  : "two rings touch or overlap along an edge, or cross at a vertex; make each one a separate part and "
                    "unite them in 'geometry', or dissolve their common borders first, as QGIS does";
}

} // namespace

std::pair<std::size_t, int> ring_and_line_of(std::span<const LatticeRing> rings, LocalIndex segment) {
  auto index = at(segment);
  std::size_t ring = 0;
  while (index >= rings[ring].points.size())
    index -= rings[ring++].points.size();
  return {ring, rings[ring].lines[index]};
}

std::string ContourMessages::in_file(Vec2 p) const {
  Vec2 original = normalization_.undo(p);
  double least = HUGE_VAL;
  for (const contours::ContourRing& ring : contour_.rings)
    for (std::size_t k = 0; k < ring.in_file.size(); ++k) {
      const std::size_t next = k + 1 == ring.in_file.size() ? 0 : k + 1;
      const Vec2 a = normalization_.apply(ring.points[k]), d = normalization_.apply(ring.points[next]) - a;
      const double share = squared_length(d) > 0 ? std::clamp(dot(p - a, d) / squared_length(d), 0.0, 1.0) : 0;
      if (const double distance = squared_length(a + share * d - p); distance < least) {
        least = distance;
        const Vec2 along = ring.in_file[next] - ring.in_file[k];
        const bool wraps = contour_.in_degrees && std::fabs(along.x) > half_turn;
        original = wraps ? ring.in_file[share < 0.5 ? k : next] : ring.in_file[k] + share * along;
      }
    }
  return contour_.in_degrees ? fmt::format("longitude {:.10g}, latitude {:.10g}", original.x, original.y)
                             : fmt::format("({:.12g}, {:.12g})", original.x, original.y);
}

contours::PlaceText ContourMessages::place_text() const {
  return {[this](int line) { return where(contour_, line); }, [this](Vec2 p) { return in_file(p); }};
}

void ContourMessages::tell_touches(const std::vector<RingTouch>& touches, double gap,
                                   std::vector<std::string>& warnings) const {
  const std::size_t told = std::min(touches.size(), most_told);
  for (const RingTouch& touch : std::span(touches).first(told))
    warnings.push_back(
        fmt::format("{}: two rings touch at {} (the other one: {}); they are moved apart by "
                    "{:.2g} there, so that no triangles meet across this point: nothing is connected there, whatever "
                    "meshing.connect says",
                    where(contour_, touch.line), in_file(touch.place), line_or_feature(contour_, touch.other_line),
                    gap / normalization_.scale));
  if (told < touches.size())
    warnings.push_back(fmt::format("{}: rings touch in {} more places and are moved apart there", contour_.source,
                                   touches.size() - told));
}

/// The second of two edges, for a message that begins with the line of the first.
std::string ContourMessages::other_edge(int line, int other_line) const {
  if (line == other_line)
    return contour_.features.empty() ? "another edge" : "another edge of this feature";
  return (contour_.features.empty() ? "the edge that starts at " : "an edge of ") +
         line_or_feature(contour_, other_line);
}

contours::Fault ContourMessages::meeting(std::span<const LatticeRing> rings, const SegmentGrid& grid,
                                         const SegmentPair& pair, bool united) const {
  const Segment &s = grid.segments()[at(pair[0])], &t = grid.segments()[at(pair[1])];
  const auto [first_ring, line] = ring_and_line_of(rings, pair[0]);
  const auto [second_ring, other_line] = ring_and_line_of(rings, pair[1]);
  const bool same = first_ring == second_ring, crossing = meeting_of(s, t) == Meeting::crossing;
  const bool is_map = contour_.is_map,
             one_polygon = rings[first_ring].polygon == rings[second_ring].polygon && rings[first_ring].polygon != 0;
  const char* remedy =
      is_map && crosses_date_line(rings[first_ring].points)
          ? "the ring seems to cross the meridian of 180 degrees; set 'projection = auto' in [shape], which joins both "
            "sides"
      : is_map && same        ? "a ring must neither cross nor touch itself; ogr2ogr -makevalid may repair it"
      : is_map && one_polygon ? "rings of one polygon must not cross; ogr2ogr -makevalid may repair it"
      : united                ? "closed lines form one polygon together and must not cross; make polygons of them"
      : is_map ? "polygons of a map must neither overlap nor share borders; set 'overlap = union' in the "
                 "section of this contour to unite them"
               : remedy_of_lines(same, crossing);
  return {where(contour_, line),
          fmt::format("{} {} {} near {}", contour_.features.empty() ? "the edge that starts here" : "an edge",
                      crossing ? "crosses" : "touches", other_edge(line, other_line), in_file(meeting_point(s, t))),
          remedy, ""};
}

void ContourMessages::tell_pieces(const Polygon& polygon, std::span<const LatticeRing> rings,
                                  std::vector<std::string>& warnings) const {
  if (contour_.is_map || contour_.is_raster)
    return;
  const std::span<const Segment> segments = polygon.grid.segments();
  std::vector<int> starts; // lines of the rings that are not holes
  double largest = 0;
  std::size_t main = 0;
  for (std::size_t k = 0; k < polygon.rings.size(); ++k) {
    const Polygon::Ring& ring = polygon.rings[k];
    const Vec2 origin = segments[ring.first].a;
    double twice_area = 0;
    for (const Segment& s : segments.subspan(ring.first, ring.count))
      twice_area += cross(s.a - origin, s.b - origin);
    if ((twice_area > 0) == ring.reversed)
      continue;
    if (std::fabs(twice_area) > largest) {
      largest = std::fabs(twice_area);
      main = starts.size();
    }
    starts.push_back(rings[k].lines[0]);
  }
  std::size_t told = 0;
  for (std::size_t k = 0; k < starts.size(); ++k)
    if (k != main && ++told <= most_told)
      warnings.push_back(fmt::format("{}: the ring that starts here lies outside the area of all others and becomes a "
                                     "separate piece",
                                     where(contour_, starts[k])));
  if (told > most_told)
    warnings.push_back(fmt::format("{}: {} more rings become separate pieces", contour_.source, told - most_told));
}

} // namespace trime::shape
