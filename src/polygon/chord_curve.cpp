// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/chord_curve.hpp"

#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>

namespace trime::polygon {

using geometry::Loop;
using geometry::Piece;
using geometry::Segment;
using geometry::Vec2;

namespace {

/// A stretch of one piece, from arc length `from` to `to`; the piece stands where `moved` takes it.
struct Stretch {
  const Piece& piece;
  double from, to;
  Vec2 moved;

  Vec2 point(double s) const { return piece.point(s) + moved; }
  Vec2 center() const { return piece.center + moved; }
  /// Signed angle of an arc.
  double turn() const { return piece.sweep * ((to - from) / piece.length()); }
};

/// Calls visit(Stretch) along the curve from site a to site b.
template <class Visit>
void for_each_stretch(const Loop& loop, const BoundarySite& a, const BoundarySite& b, const Visit& visit) {
  const auto n = static_cast<LocalIndex>(loop.pieces.size());
  const bool passes_start = b.piece < a.piece || (b.piece == a.piece && b.along <= a.along);
  const LocalIndex last = b.piece - a.piece + (passes_start ? n : 0);
  for (LocalIndex k = 0; k <= last; ++k) {
    const bool beyond = a.piece + k >= n;
    const Piece& piece = loop.pieces[static_cast<std::size_t>(a.piece + k - (beyond ? n : 0))];
    const double from = k == 0 ? a.along : 0, to = k == last ? b.along : piece.length();
    if (to > from)
      visit(Stretch{piece, from, to, beyond ? loop.winding : Vec2{}});
  }
}

double distance(Vec2 p, const Segment& chord) {
  return std::sqrt(squared_distance(p, chord));
}

/// @brief Largest distance of a stretch from a chord. On an arc it is at an end, or where the arc runs parallel to the
/// chord, or where it is farthest from an end of the chord.
double largest_distance(const Stretch& s, const Segment& chord) {
  double largest = std::fmax(distance(s.point(s.from), chord), distance(s.point(s.to), chord));
  if (!s.piece.circular)
    return largest;
  const SinCos middle = sin_cos(s.piece.start_angle + s.piece.sweep * (0.5 * (s.from + s.to) / s.piece.length()));
  const double reach = sin_cos(0.5 * std::fabs(s.turn())).cos; // of a direction on the arc along that of its middle
  const auto look = [&](Vec2 direction) {
    const double length = geometry::length(direction);
    if (!(length > 0) || dot(direction, {middle.cos, middle.sin}) < reach * length)
      return;
    largest = std::fmax(largest, distance(s.center() + (s.piece.radius / length) * direction, chord));
  };
  const Vec2 along = chord.b - chord.a;
  look({along.y, -along.x});
  look({-along.y, along.x});
  look(s.center() - chord.a);
  look(s.center() - chord.b);
  return largest;
}

/// Twice the area between an arc and its own chord, positive if the arc turns to the left.
double twice_arc_area(double radius, double turn) {
  return radius * radius * (turn - sin_cos(turn).sin);
}

/// The circle of a curve that is made of arcs of one circle.
class CommonCircle {
public:
  void add(const Stretch& s) {
    if (!any_) {
      radius_ = s.piece.circular ? s.piece.radius : 0;
      center_ = s.center();
      any_ = true;
    } else if (!s.piece.circular || s.piece.radius != radius_ || s.center() != center_) {
      radius_ = 0;
    }
  }
  double curvature() const { return radius_ > 0 ? 1 / radius_ : 0; }

private:
  bool any_ = false;
  double radius_ = 0;
  Vec2 center_;
};

ChordCurve compare(const Loop& loop, const BoundarySites& sites, LocalIndex k) {
  const BoundarySite &a = sites.sites[k], &b = sites.sites[a.next];
  const Vec2 start = loop.pieces[static_cast<std::size_t>(a.piece)].point(a.along);
  const Vec2 p = sites.periods.nearest_image(a.position, start); // where the loop is unrolled
  const Segment chord{p, p + (sites.chord(k).b - a.position)};
  ChordCurve result;
  result.offset = geometry::length(p - start);
  CommonCircle circle;
  double twice_area = 0;
  Vec2 at = p;
  for_each_stretch(loop, a, b, [&](const Stretch& s) {
    const Vec2 from = s.point(s.from), to = s.point(s.to);
    twice_area += cross(at - p, from - p) + cross(from - p, to - p);
    if (s.piece.circular)
      twice_area += twice_arc_area(s.piece.radius, s.turn());
    result.deviation = std::fmax(result.deviation, largest_distance(s, chord));
    circle.add(s);
    at = to;
  });
  result.area = 0.5 * (twice_area + cross(at - p, chord.b - p));
  result.curvature = circle.curvature();
  return result;
}

/// The piece of the loop at the middle of a chord.
const geometry::Piece& piece_in_the_middle(const Loop& loop, const BoundarySite& a, const BoundarySite& b) {
  if (a.piece == b.piece && b.along > a.along)
    return loop.pieces[static_cast<std::size_t>(a.piece)]; // most chords span one piece
  double length = 0, before = 0;
  for_each_stretch(loop, a, b, [&](const Stretch& s) { length += s.to - s.from; });
  const geometry::Piece* piece = &loop.pieces[static_cast<std::size_t>(a.piece)];
  for_each_stretch(loop, a, b, [&](const Stretch& s) {
    if (before < 0.5 * length)
      piece = &s.piece;
    before += s.to - s.from;
  });
  return *piece;
}

void assert_same_loops(const geometry::Boundary& boundary, const BoundarySites& sites) {
  TRIME_ASSERT(sites.loop_start.size() == boundary.loops.size() + 1,
               "the boundary sites have {} loops, but the boundary has {}", sites.loop_start.size(),
               boundary.loops.size() + 1);
}

} // namespace

std::vector<ChordCurve> compare_chords(const geometry::Boundary& boundary, const BoundarySites& sites, LocalIndex first,
                                       LocalIndex last) {
  assert_same_loops(boundary, sites);
  std::vector<ChordCurve> chords(static_cast<std::size_t>(last - first));
  thread_loop(last - first, 256, [&](std::ptrdiff_t item, int) {
    const LocalIndex k = first + static_cast<LocalIndex>(item);
    const auto after = std::upper_bound(sites.loop_start.begin(), sites.loop_start.end(), k);
    const Loop& loop = boundary.loops[static_cast<std::size_t>(after - sites.loop_start.begin()) - 1];
    chords[static_cast<std::size_t>(item)] = compare(loop, sites, k);
  });
  return chords;
}

void name_parts(const geometry::Boundary& boundary, BoundarySites& sites) {
  assert_same_loops(boundary, sites);
  for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop) {
    const LocalIndex first = sites.loop_start[loop];
    thread_loop(sites.loop_start[loop + 1] - first, 256, [&](std::ptrdiff_t k, int) {
      BoundarySite& site = sites.sites[static_cast<std::size_t>(first + k)];
      const geometry::Piece& piece =
          piece_in_the_middle(boundary.loops[loop], site, sites.sites[static_cast<std::size_t>(site.next)]);
      site.part = piece.part;
      site.region = piece.region;
    });
  }
}

double area_of_loops(const geometry::Boundary& boundary) {
  double twice_area = 0;
  for (const Loop& loop : boundary.loops) {
    const Vec2 origin = loop.pieces.front().start;
    for (const Piece& piece : loop.pieces) {
      twice_area += cross(piece.start - origin, piece.end - origin);
      if (piece.circular)
        twice_area += twice_arc_area(piece.radius, piece.sweep);
    }
    if (loop.winds()) // what it lacks to a closed one; the sum over all loops does not depend on the corner chosen here
      twice_area += 2 * cross(origin - boundary.periods.min, loop.winding);
  }
  const double area = 0.5 * twice_area, torus = boundary.periods.x * boundary.periods.y;
  return torus > 0 ? area - torus * std::floor(area / torus) : area;
}

std::vector<LoopSummary> summarize_loops(const geometry::Boundary& boundary, const BoundarySites& sites) {
  assert_same_loops(boundary, sites);
  std::vector<LoopSummary> loops;
  std::int32_t parts = 0;
  for (const BoundarySite& site : sites.sites)
    parts = std::max(parts, site.part + 1);
  std::vector<std::size_t> listed(static_cast<std::size_t>(parts), boundary.loops.size()); // the last loop that has it
  for (std::size_t index = 0; index < boundary.loops.size(); ++index) {
    const Loop& loop = boundary.loops[index];
    LoopSummary summary{loop.tag,
                        loop.winds() ? LoopSummary::Kind::band
                        : loop.outer ? LoopSummary::Kind::outer
                                     : LoopSummary::Kind::hole,
                        sites.loop_start[index + 1] - sites.loop_start[index],
                        0,
                        {}};
    for (LocalIndex k = sites.loop_start[index]; k < sites.loop_start[index + 1]; ++k) {
      const Segment chord = sites.chord(k);
      const std::int32_t part = sites.sites[k].part;
      summary.length += geometry::length(chord.b - chord.a);
      if (std::size_t& last = listed[static_cast<std::size_t>(part)]; last != index) {
        summary.parts.push_back(part);
        last = index;
      }
    }
    loops.push_back(std::move(summary));
  }
  return loops;
}

} // namespace trime::polygon
