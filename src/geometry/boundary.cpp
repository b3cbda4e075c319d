// SPDX-License-Identifier: BSD-3-Clause
#include "trime/geometry/boundary.hpp"

#include "core/angle.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>

namespace trime::geometry {
namespace {

/// Does the ray from the centre of an arc through p meet the arc?
bool faces_arc(const Piece& arc, Vec2 p) {
  if (arc.start == arc.end)
    return true;
  const bool ccw = arc.sweep > 0;
  const Vec2 from = (ccw ? arc.start : arc.end) - arc.center, to = (ccw ? arc.end : arc.start) - arc.center;
  const Vec2 q = p - arc.center;
  if (std::fabs(arc.sweep) <= pi)
    return cross(from, q) >= 0 && cross(q, to) >= 0;
  return !(cross(to, q) > 0 && cross(q, from) > 0);
}

void include_arc(Box& box, const Piece& arc) {
  const Vec2 extremes[] = {{arc.radius, 0}, {0, arc.radius}, {-arc.radius, 0}, {0, -arc.radius}};
  for (const Vec2 extreme : extremes)
    if (faces_arc(arc, arc.center + extreme))
      box.include(arc.center + extreme);
}

} // namespace

double Piece::length() const {
  return circular ? radius * std::fabs(sweep) : geometry::length(end - start);
}

Vec2 Piece::point(double s) const {
  const double whole = length();
  if (s <= 0)
    return start;
  if (s >= whole)
    return end;
  const double t = s / whole;
  if (!circular)
    return start + t * (end - start);
  const SinCos direction = sin_cos(start_angle + t * sweep);
  return center + radius * Vec2{direction.cos, direction.sin};
}

Vec2 Piece::tangent(double s) const {
  if (!circular)
    return (1.0 / geometry::length(end - start)) * (end - start);
  const double t = std::clamp(s / length(), 0.0, 1.0);
  const SinCos direction = sin_cos(start_angle + t * sweep);
  const double sign = sweep > 0 ? 1 : -1;
  return {-sign * direction.sin, sign * direction.cos};
}

double Piece::distance(Vec2 p) const {
  if (!circular)
    return std::sqrt(squared_distance(p, {start, end}));
  if (faces_arc(*this, p))
    return std::fabs(geometry::length(p - center) - radius);
  return std::sqrt(std::fmin(squared_length(p - start), squared_length(p - end)));
}

Box Piece::covering_box() const {
  Box box;
  box.include(start);
  box.include(end);
  if (circular) {
    const double margin = 0.5 * length(); // no point of an arc is farther from an end than half its length
    box.min = box.min - Vec2{margin, margin};
    box.max = box.max + Vec2{margin, margin};
  }
  return box;
}

double Loop::length() const {
  double sum = 0;
  for (const Piece& piece : pieces)
    sum += piece.length();
  return sum;
}

double Loop::turn_degrees(std::size_t i) const {
  const Piece& before = pieces[(i + pieces.size() - 1) % pieces.size()];
  const Vec2 in = before.tangent(before.length()), out = pieces[i].tangent(0);
  return std::fabs(angle_of(cross(in, out), dot(in, out))) * degrees_per_radian;
}

int Boundary::components() const {
  int outer = 0, winding = 0;
  for (const Loop& loop : loops)
    (loop.winds() ? winding : outer) += loop.outer ? 1 : 0;
  return outer + winding / 2 + (covers_torus ? 1 : 0);
}

int Regions::pair_of(int a, int b) const {
  const std::array<int, 2> pair{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(pairs.begin(), pairs.end(), pair);
  return found != pairs.end() && *found == pair ? static_cast<int>(found - pairs.begin()) : -1;
}

std::string Domain::line_name(int curve, int left, int right) const {
  if (curve >= 0)
    return "curve '" + curves_.names[static_cast<std::size_t>(curve)] + "'";
  return "interface '" + regions_.pair_name(static_cast<std::size_t>(regions_.pair_of(left, right))) + "'";
}

int Boundary::holes() const {
  return static_cast<int>(std::count_if(loops.begin(), loops.end(), [](const Loop& loop) { return !loop.outer; }));
}

int Boundary::euler_characteristic() const {
  int sum = 0;
  for (const Loop& loop : loops)
    sum += loop.winds() ? 0 : loop.outer ? 1 : -1;
  return sum;
}

double Boundary::length() const {
  double sum = 0;
  for (const Loop& loop : loops)
    sum += loop.length();
  return sum;
}

Box Boundary::bounding_box() const {
  Box box;
  for (const Loop& loop : loops)
    for (const Piece& piece : loop.pieces) {
      box.include(piece.start);
      box.include(piece.end);
      if (piece.circular)
        include_arc(box, piece);
    }
  return box;
}

namespace {

/// Lattice steps by which a shape's vertices may be moved beyond the container, with much room.
constexpr double reach_in_steps = 64;

std::string text_of(const Box& box) {
  return fmt::format("[{:.9g}, {:.9g}] x [{:.9g}, {:.9g}]", box.min.x, box.max.x, box.min.y, box.max.y);
}

void check_periods(const Boundary& boundary, const Frame& frame) {
  const Periods &found = boundary.periods, &expected = frame.periods();
  if (found.x != expected.x || found.y != expected.y || (expected.any() && found.min != expected.min))
    throw GeometryError(fmt::format(
        "the boundary does not belong to the container {}: expected the periods ({:.9g}, {:.9g}) of the container, "
        "found ({:.9g}, {:.9g}); use the frame in which the shape was made",
        text_of(frame.container()), expected.x, expected.y, found.x, found.y));
}

void check_parts(const Boundary& boundary, std::size_t markers) {
  const std::size_t names = boundary.part_names.size();
  if (markers != names)
    throw GeometryError(
        fmt::format("expected a marker for each of the {} parts of the boundary, found {} markers", names, markers));
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (piece.part < 0 || static_cast<std::size_t>(piece.part) >= names)
        throw GeometryError(fmt::format("a piece of loop {} names part {}, but the boundary has {} names of parts: "
                                        "give Boundary::part_names a name for each part",
                                        loop.tag, piece.part, names));
}

/// Compares vertices with a frame.
class VertexCheck {
public:
  explicit VertexCheck(const Frame& frame) : frame_(frame) {
    const Periods& periods = frame.periods(); // loops of a periodic container lie within one image of it
    const double margin = reach_in_steps * frame.step();
    const Vec2 around{periods.x + margin, periods.y + margin};
    allowed_ = {frame.container().min - around, frame.container().max + around};
  }

  void check(Vec2 p, int tag) const {
    check_inside(p, tag);
    if (frame_.lattice().snap(p) != p)
      throw GeometryError(fmt::format(
          "the boundary does not belong to the container {}: expected vertices on its lattice, whose step is {:.9g}, "
          "found ({:.17g}, {:.17g}) on loop {}; make the shape in this frame, or snap vertices with Frame::snap",
          text_of(frame_.container()), frame_.step(), p.x, p.y, tag));
  }

  void check_inside(Vec2 p, int tag) const {
    if (!allowed_.contains(p)) // nor is NaN
      throw GeometryError(
          fmt::format("the boundary leaves the container {}: expected all of it inside, found the point "
                      "({:.9g}, {:.9g}) of loop {}; use the frame in which the shape was made, or a "
                      "larger one",
                      text_of(frame_.container()), p.x, p.y, tag));
  }

private:
  const Frame& frame_;
  Box allowed_;
};

void check_loop(const Loop& loop, const VertexCheck& vertices) {
  for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
    const Piece& piece = loop.pieces[k];
    vertices.check(piece.start, loop.tag);
    if (piece.circular)
      for (const double share : {0.25, 0.5, 0.75}) // an arc may leave the container between its ends
        vertices.check_inside(piece.point(share * piece.length()), loop.tag);
    const bool is_last = k + 1 == loop.pieces.size();
    const Vec2 next = is_last ? loop.pieces.front().start + loop.winding : loop.pieces[k + 1].start;
    if (piece.end != next)
      throw GeometryError(fmt::format("loop {} of the boundary is not closed: expected the next piece to start at "
                                      "({:.17g}, {:.17g}), found ({:.17g}, {:.17g})",
                                      loop.tag, piece.end.x, piece.end.y, next.x, next.y));
  }
}

} // namespace

Domain::Domain(const Frame& frame, Boundary boundary, std::vector<std::int32_t> part_markers)
    : frame_(frame), boundary_(std::move(boundary)), part_markers_(std::move(part_markers)) {
  if (part_markers_.empty())
    part_markers_.resize(boundary_.part_names.size(), 0);
  check_periods(boundary_, frame_);
  check_parts(boundary_, part_markers_.size());
  const VertexCheck vertices(frame_);
  for (const Loop& loop : boundary_.loops)
    check_loop(loop, vertices);
}

} // namespace trime::geometry
