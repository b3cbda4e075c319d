// SPDX-License-Identifier: BSD-3-Clause
#include "shape/contour_polygon.hpp"

#include "contours/faults.hpp"
#include "contours/map_features.hpp"
#include "contours/ring_repair.hpp"
#include "geometry/predicates.hpp"
#include "shape/contour_messages.hpp"
#include "shape/dissolve.hpp"
#include "shape/lattice_rings.hpp"
#include "shape/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace trime::shape {

namespace {

using contours::line_or_feature;
using contours::where;
using geometry::dot;
using geometry::Frame;
using geometry::orient2d;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

bool is_collinear(const std::vector<Vec2>& p) {
  for (std::size_t k = 2; k < p.size(); ++k)
    if (orient2d(p[0], p[1], p[k]) != 0)
      return false;
  return true;
}

/// Does the ring turn straight back at a vertex?
bool has_spike(const std::vector<Vec2>& p) {
  const std::size_t n = p.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 before = p[(k + n - 1) % n], here = p[k], after = p[(k + 1) % n];
    if (orient2d(before, here, after) == 0 && dot(before - here, after - here) > 0)
      return true;
  }
  return false;
}

/// The rings on the lattice while they are made and checked.
class Placement {
public:
  Placement(const contours::Contour& contour, const contours::Normalization& normalization, const Frame& frame,
            const TouchOptions& touches)
      : contour_(contour), normalization_(normalization), messages_(contour, normalization), frame_(frame),
        touches_(touches), faults_(contour.faults) {}

  Polygon make(std::vector<std::string>& warnings) {
    check_date_line();
    for (const contours::ContourRing& ring : contour_.rings)
      add_ring(ring, warnings);
    std::vector<std::string> notes;
    if (touches_.dissolve)
      list_crossings_in_polygons();
    if (touches_.dissolve || rings_.empty())
      check_faults();
    if (touches_.dissolve)
      unite(notes, warnings);
    for (const RepeatedRing& ring : drop_repeated(rings_))
      warnings.push_back(fmt::format("{}: the ring that starts here was given before, at {}; it is used once{}",
                                     where(contour_, ring.line), line_or_feature(contour_, ring.first_line),
                                     ring.loses_markers ? ", with the names or markers that stand there" : ""));
    SegmentGrid grid(segments_of(rings_));
    const std::vector<int> markers = markers_of_segments();
    const SegmentGrid given = markers.empty() ? SegmentGrid{} : grid;
    const bool keeps_touches = touches_.keep_touches && (contour_.is_raster || touches_.dissolve); // area on the left
    if (const std::vector<SegmentPair> meetings = find_meetings(rings_, grid); !meetings.empty() && !keeps_touches)
      separate(meetings, grid, warnings);
    check_faults();
    contours::tell_repaired(faults_, contour_.source, warnings);
    Polygon polygon;
    polygon.grid = std::move(grid);
    for (LocalIndex first = 0; const LatticeRing& ring : rings_) {
      polygon.rings.push_back({first, static_cast<LocalIndex>(ring.points.size()), false});
      first += polygon.rings.back().count;
    }
    if (!markers
             .empty()) // where rings are parted segments move by a few steps of the lattice, and may fall into several
      for (const Segment& s : polygon.grid.segments())
        polygon.markers.push_back(markers[at(given.nearest(0.5 * (s.a + s.b)).segment)]);
    polygon.marker_names = contour_.marker_names;
    polygon.notes = std::move(notes);
    if (!keeps_touches) // where rings touch, nesting is unclear
      orient(polygon);
    messages_.tell_pieces(polygon, rings_, warnings);
    return polygon;
  }

  static void orient(Polygon& polygon);

private:
  void add_ring(const contours::ContourRing& ring, std::vector<std::string>& warnings);
  void add_checked(contours::ContourRing ring);
  void check_date_line() const;
  void check_faults() const;
  void unite(std::vector<std::string>& notes, std::vector<std::string>& warnings);
  void separate(const std::vector<SegmentPair>& meetings, SegmentGrid& grid, std::vector<std::string>& warnings);
  void repair_self_meetings(const std::vector<SegmentPair>& meetings);
  void add_seams(const contours::RepairedRing& repaired, const contours::ContourRing& ring);
  void list_meetings(const SegmentGrid& grid, std::span<const SegmentPair> pairs);
  void list_crossings_in_polygons();
  void explain(const std::vector<SegmentPair>& meetings);
  void list_seams_in_file();
  std::vector<int> markers_of_segments() const;

  const contours::Contour& contour_;
  const contours::Normalization& normalization_;
  const ContourMessages messages_;
  const Frame& frame_;
  const TouchOptions& touches_;
  std::vector<LatticeRing> rings_;
  contours::FaultList faults_;
  std::set<int> with_seams_; // first lines of the rings for which something without area is listed
};

/// Returns the markers of all segments of the rings; empty if no segment has one.
std::vector<int> Placement::markers_of_segments() const {
  std::vector<int> markers;
  if (std::all_of(rings_.begin(), rings_.end(), [](const LatticeRing& ring) { return ring.markers.empty(); }))
    return markers;
  for (const LatticeRing& ring : rings_) {
    markers.insert(markers.end(), ring.markers.begin(), ring.markers.end());
    if (ring.markers.empty())
      markers.resize(markers.size() + ring.points.size(), 0);
  }
  if (std::all_of(markers.begin(), markers.end(), [](int marker) { return marker == 0; }))
    return {};
  return markers;
}

void Placement::add_ring(const contours::ContourRing& ring, std::vector<std::string>& warnings) {
  std::vector<Vec2> points;
  std::vector<int> lines, markers;
  const bool marked = !ring.markers.empty();
  points.reserve(ring.points.size());
  lines.reserve(ring.points.size());
  markers.reserve(ring.markers.size());
  for (std::size_t k = 0; k < ring.points.size(); ++k) {
    const Vec2 p = frame_.snap(normalization_.apply(ring.points[k]));
    if (!frame_.reach().contains(p))
      throw GeometryError(
          fmt::format("{}: vertex ({}, {}) lies far outside the container [{}, {}] x [{}, {}]; enlarge [domain] or set "
                      "normalize = true",
                      where(contour_, ring.lines[k]), ring.points[k].x, ring.points[k].y, frame_.container().min.x,
                      frame_.container().max.x, frame_.container().min.y, frame_.container().max.y));
    if (!points.empty() && points.back() == p) {
      if (marked)
        markers.back() = ring.markers[k];
      continue;
    }
    points.push_back(p);
    lines.push_back(ring.lines[k]);
    if (marked)
      markers.push_back(ring.markers[k]);
  }
  while (points.size() > 1 && points.front() == points.back())
    points.pop_back();
  if (points.size() < ring.points.size())
    warnings.push_back(fmt::format("{}: {} vertices of the ring that starts here are nearer than {:.3g} to the one "
                                   "before; they are merged",
                                   where(contour_, ring.lines[0]), ring.points.size() - points.size(),
                                   frame_.step() / normalization_.scale));
  lines.resize(points.size());
  if (marked)
    markers.resize(points.size());
  add_checked({std::move(points), std::move(lines), std::move(markers), {}, ring.polygon});
}

/// Adds a ring without what has no area, which becomes a fault.
void Placement::add_checked(contours::ContourRing ring) {
  const auto take = [this](contours::ContourRing& one) {
    if (!is_collinear(one.points)) {
      rings_.push_back({std::move(one.points), std::move(one.lines), std::move(one.markers), one.polygon});
      return;
    }
    contours::add_fault(faults_, contours::HasArea::no, [&]() -> contours::Fault {
      return {messages_.place_text().where(one.lines.empty() ? 0 : one.lines[0]),
              fmt::format("the ring that starts here at {} encloses no area: all its vertices lie on one line",
                          one.points.empty() ? "nowhere" : messages_.in_file(one.points[0])),
              "remove the ring", "the ring is left out"};
    });
  };
  if (is_collinear(ring.points) || (touches_.faults != contours::Faults::repair && !has_spike(ring.points)))
    return take(ring);
  contours::RepairedRing repaired = contours::repair_ring(ring, ShapeRules::on_edge * frame_.step());
  if (!repaired.seams.empty())
    add_seams(repaired, ring);
  for (contours::ContourRing& left : repaired.rings)
    take(left);
}

void Placement::add_seams(const contours::RepairedRing& repaired, const contours::ContourRing& ring) {
  contours::add_faults(faults_, repaired, ring, messages_.place_text());
  with_seams_.insert(ring.lines[0]);
}

/// Lines that end at both sides of the date line are a ring only if they are projected.
void Placement::check_date_line() const {
  if (contour_.joins_date_line && !contour_.in_degrees)
    throw GeometryError(fmt::format("{}: lines end at longitudes 180 and -180; set 'projection = auto' in [shape], "
                                    "which joins both sides",
                                    contour_.source));
}

/// Throws if there are faults that are not repaired, or if nothing is left.
void Placement::check_faults() const {
  contours::check_faults(faults_, contour_.source,
                         rings_.empty() ? contours::Faults::refuse : touches_.faults); // a repair would leave nothing
}

/// Replaces the rings by those around the union of all polygons.
void Placement::unite(std::vector<std::string>& notes, std::vector<std::string>& warnings) {
  Dissolved dissolved =
      dissolve(rings_, frame_, {contour_.source, touches_.widest_gap, [this](Vec2 p) { return messages_.in_file(p); }});
  rings_ = std::move(dissolved.rings);
  const double scale = normalization_.scale;
  notes.push_back(
      fmt::format("{}: {} polygon{} united into an outline of {} ring{}; they share borders of length {:.4g} "
                  "and overlap by an area of {:.4g}",
                  contour_.source, dissolved.polygons, dissolved.polygons == 1 ? " is" : "s are", rings_.size(),
                  rings_.size() == 1 ? "" : "s", dissolved.shared_length / scale,
                  std::fmax(0, dissolved.overlap) / (scale * scale)));
  if (const std::size_t lost = dissolved.covered.size(); lost > 0)
    warnings.push_back(fmt::format("{}: this polygon lies inside of others and disappears in their union{}; if it is a "
                                   "hole, make it a hole of the polygon around it, or a separate part to be subtracted "
                                   "in 'geometry'",
                                   where(contour_, dissolved.covered[0]),
                                   lost == 1 ? "" : fmt::format(", and so do {} more", lost - 1)));
  if (dissolved.gaps > 0)
    notes.push_back(fmt::format("{}: {} gap{} between polygons, narrower than {:.3g} and {:.4g} in area, {} closed",
                                contour_.source, dissolved.gaps, dissolved.gaps == 1 ? "" : "s",
                                touches_.widest_gap / scale, dissolved.gap_area / (scale * scale),
                                dissolved.gaps == 1 ? "is" : "are"));
}

/// Separates rings that touch, less far where they would cross then.
void Placement::separate(const std::vector<SegmentPair>& meetings, SegmentGrid& grid,
                         std::vector<std::string>& warnings) {
  const std::vector<LatticeRing> given = rings_;
  const double least = ShapeRules::touch_gap * frame_.step();
  for (double gap = std::fmax(least, touches_.gap);; gap = std::fmax(least, ShapeRules::smaller_gap * gap)) {
    rings_ = given;
    const std::vector<RingTouch> touches = part_touches(rings_, meetings, grid, frame_, {touches_.outside, false, gap});
    SegmentGrid separated(segments_of(rings_));
    if (const std::vector<SegmentPair> left = find_meetings(rings_, separated); left.empty()) {
      messages_.tell_touches(touches, gap, warnings);
      grid = std::move(separated);
      return;
    } else if (gap == least) {
      rings_ = given;
      explain(meetings);
      check_faults();
      return;
    }
  }
}

/// @brief Lists why rings meet that cannot be separated: what has no area, and then all meetings that are left without
/// it. A repair has left out before what has no area, so that only meetings are listed then. Afterwards there are
/// faults for which check_faults throws, because the rings are no longer those of the contour.
void Placement::explain(const std::vector<SegmentPair>& meetings) {
  if (touches_.faults != contours::Faults::repair) {
    repair_self_meetings(meetings);
    list_seams_in_file();
  }
  const SegmentGrid grid(segments_of(rings_));
  part_touches(rings_, find_meetings(rings_, grid), grid, frame_,
               {touches_.outside, false, ShapeRules::touch_gap * frame_.step()});
  const SegmentGrid separated(segments_of(rings_));
  list_meetings(separated, find_meetings(rings_, separated));
}

/// Adds what has no area in the file, where a projection has moved two edges apart that cancel each other there. Rings
/// for which something without area is listed already are left out.
void Placement::list_seams_in_file() {
  for (const contours::ContourRing& ring : contour_.rings) {
    if (ring.in_file.empty() || with_seams_.count(ring.lines[0]) > 0)
      continue;
    contours::Contour one;
    one.source = contour_.source;
    one.features = contour_.features;
    one.is_map = contour_.is_map;
    one.rings.push_back(ring);
    one.rings[0].points = std::exchange(one.rings[0].in_file, {});
    contours::repair_rings(one);
    contours::add_faults(faults_, one.faults);
    if (!one.faults.empty())
      with_seams_.insert(ring.lines[0]);
  }
}

/// Repairs rings that meet themselves; what they lose is a fault.
void Placement::repair_self_meetings(const std::vector<SegmentPair>& meetings) {
  std::set<std::size_t> meeting_themselves;
  for (const auto& [i, j] : meetings)
    if (const std::size_t ring = ring_and_line_of(rings_, i).first; ring == ring_and_line_of(rings_, j).first)
      meeting_themselves.insert(ring);
  std::vector<LatticeRing> given = std::exchange(rings_, {});
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (meeting_themselves.count(k) == 0) {
      rings_.push_back(std::move(given[k]));
      continue;
    }
    const contours::ContourRing ring{given[k].points, given[k].lines, given[k].markers, {}, given[k].polygon};
    contours::RepairedRing repaired = contours::repair_ring(ring, ShapeRules::on_edge * frame_.step());
    if (!repaired.seams.empty())
      add_seams(repaired, ring);
    for (contours::ContourRing& left : repaired.rings)
      rings_.push_back({std::move(left.points), std::move(left.lines), std::move(left.markers), left.polygon});
  }
}

/// Adds a fault for each pair of rings that meet, and for each ring that meets itself, unless something without area is
/// listed for this ring, which may be the reason.
void Placement::list_meetings(const SegmentGrid& grid, std::span<const SegmentPair> pairs) {
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (const SegmentPair& pair : pairs) {
    const std::size_t first = ring_and_line_of(rings_, pair[0]).first, second = ring_and_line_of(rings_, pair[1]).first;
    if ((first != second || with_seams_.count(rings_[first].lines[0]) == 0) && seen.insert({first, second}).second)
      contours::add_fault(faults_, contours::HasArea::yes,
                          [&] { return messages_.meeting(rings_, grid, pair, touches_.dissolve); });
  }
}

/// Lists the crossings within each polygon, which the even-odd rule would turn into holes of the union.
void Placement::list_crossings_in_polygons() {
  std::map<int, std::vector<LatticeRing>> by_polygon;
  for (const LatticeRing& ring : rings_)
    by_polygon[ring.polygon].push_back(ring);
  std::vector<LatticeRing> all = std::exchange(rings_, {});
  for (auto& [number, rings] : by_polygon) {
    rings_ = std::move(rings);
    const SegmentGrid grid(segments_of(rings_));
    std::vector<SegmentPair> meetings = find_meetings(rings_, grid);
    std::erase_if(meetings, [&](const SegmentPair& pair) {
      return meeting_of(grid.segments()[at(pair[0])], grid.segments()[at(pair[1])]) != Meeting::crossing;
    });
    list_meetings(grid, meetings);
  }
  rings_ = std::move(all);
}

void Placement::orient(Polygon& polygon) {
  const std::span<const Segment> segments = polygon.grid.segments();
  for (Polygon::Ring& ring : polygon.rings) {
    LocalIndex top = 0; // highest start, rightmost of those
    for (LocalIndex k = 1; k < ring.count; ++k) {
      const Vec2 p = segments[ring.first + k].a, q = segments[ring.first + top].a;
      if (p.y > q.y || (p.y == q.y && p.x > q.x))
        top = k;
    }
    const Segment &out = segments[ring.first + top], &in = segments[ring.first + (top + ring.count - 1) % ring.count];
    const bool ccw = orient2d(in.a, out.a, out.b) > 0;
    // Just above its top a ring is outside of itself, and `inside` looks just above: what it finds is the nesting.
    const bool hole = polygon.grid.inside(out.a);
    ring.reversed = ccw == hole;
  }
}

} // namespace

Polygon make_contour_polygon(const contours::Contour& contour, const contours::Normalization& normalization,
                             const Frame& frame, std::vector<std::string>& warnings, const TouchOptions& touches) {
  return Placement(contour, normalization, frame, touches).make(warnings);
}

void orient_rings(Polygon& polygon) {
  Placement::orient(polygon);
}

Polygon make_simple_polygon(const std::vector<Vec2>& ring) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < ring.size(); ++k)
    segments.push_back({ring[k], ring[(k + 1) % ring.size()]});
  Polygon polygon;
  polygon.rings.push_back({0, static_cast<LocalIndex>(segments.size()), false});
  polygon.grid = SegmentGrid(std::move(segments));
  Placement::orient(polygon);
  return polygon;
}

} // namespace trime::shape
