// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/divided_lines.hpp"

#include "geometry/piece_parts.hpp"

#include <algorithm>
#include <cmath>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

// [1] A curve gives its name to a part of an interface if it follows more than this share of it.
constexpr double least_followed = 0.5;

/// Turns an arc round.
void reverse(InnerArc& arc) {
  std::ranges::reverse(arc.pieces);
  std::vector<char> is_corner;
  for (Piece& piece : arc.pieces) {
    is_corner.push_back(piece.corner ? 1 : 0);
    piece = geometry::reversed(piece);
  }
  for (std::size_t k = 0; k < arc.pieces.size(); ++k) // the corner at the start of a piece is now at its end
    arc.pieces[(k + 1) % arc.pieces.size()].corner = is_corner[k] != 0;
  std::swap(arc.left, arc.right);
  std::swap(arc.start_wedge, arc.end_wedge);
  arc.lost_area = -arc.lost_area;
}

} // namespace

void DividedLines::add(const Foot& foot) {
  std::vector<Vec2>& feet = feet_[foot.at];
  if (std::ranges::find(feet, foot.place) == feet.end())
    feet.push_back(foot.place);
}

void DividedLines::bend(const Foot& foot) {
  add(foot);
  bent_.insert(foot.at);
}

const std::vector<Vec2>* DividedLines::feet_on(std::size_t piece) const {
  const auto found = feet_.find(piece);
  return found == feet_.end() ? nullptr : &found->second;
}

double DividedLines::way_of(std::size_t at, Vec2 p) const {
  return lines_[at].way + way_on(*lines_[at].piece, nearest_on(*lines_[at].piece, p));
}

void DividedLines::follow(const ArcCuts& cuts, const SampleRun& run, int part) {
  const Sample* last = nullptr; // that is near
  for (std::size_t k = run.first; k <= run.last; ++k) {
    const Sample& one = cuts.samples[k];
    if (!one.is_near())
      continue;
    const Sample* before = std::exchange(last, &one);
    if (before == nullptr || lines_[one.at].arc == LinePieces::rim || lines_[one.at].arc != lines_[before->at].arc)
      continue;
    const auto number = static_cast<std::size_t>(lines_[one.at].arc);
    const InnerArc& arc = arcs_[number];
    if (arc.left == arc.right || arc.pieces.front().part >= 0)
      continue;
    double from = way_of(before->at, before->place), to = way_of(one.at, one.place);
    const double whole = lines_.length_of(number);
    const bool is_ring = arc.pieces.front().start == arc.pieces.back().end;
    if (is_ring && std::fabs(to - from) > 0.5 * whole) // over the place where the ring begins
      (from < to ? from : to) += whole;
    if (std::fabs(to - from) > longest_way_beside(*before, one))
      continue;
    followed_[number].push_back({std::fmin(from, to), std::fmax(from, to), to < from, part});
  }
}

std::vector<InnerArc> DividedLines::parts_of(std::size_t number) const {
  const InnerArc& given = arcs_[number];
  const double whole = lines_.length_of(number);
  std::vector<Part> parts(1, {given, 0, whole});
  parts[0].arc.pieces.clear();
  bool is_divided = false;
  for (std::size_t k = 0; k < given.pieces.size(); ++k)
    is_divided = add_divided(lines_.first_of(number) + k, parts) || is_divided;
  if (parts.back().arc.pieces.empty())
    parts.pop_back();
  parts.back().to = whole;
  if (given.closed && is_divided)
    close(parts, whole);
  else if (const auto found = begins_at_.find(number); found != begins_at_.end())
    std::rotate(parts[0].arc.pieces.begin(), parts[0].arc.pieces.begin() + found->second, parts[0].arc.pieces.end());
  std::vector<InnerArc> made;
  for (Part& part : parts) {
    name(part, number, whole);
    made.push_back(std::move(part.arc));
  }
  return made;
}

/// Adds a piece to the last part; a new part begins at each foot on it. Returns whether there is one.
bool DividedLines::add_divided(std::size_t at, std::vector<Part>& made) const {
  const Piece& given = *lines_[at].piece;
  const auto found = feet_.find(at);
  if (found == feet_.end()) {
    made.back().arc.pieces.push_back(given);
    return false;
  }
  const auto end_here = [&](double way) {
    if (made.back().arc.pieces.empty())
      return;
    made.back().to = way;
    made.push_back({made.back().arc, way, way});
    made.back().arc.pieces.clear();
    made.back().arc.lost_area = 0; // all of it belongs to the first part
  };
  std::vector<Vec2> feet = found->second;
  std::ranges::sort(feet, {}, [&](Vec2 p) { return way_on(given, p); });
  if (is_bent(at)) {
    Vec2 last = given.start;
    for (const Vec2 foot : feet)
      made.back().arc.lost_area += 0.5 * cross(foot - given.start, std::exchange(last, foot) - given.start);
    made.back().arc.lost_area += 0.5 * cross(given.end - given.start, last - given.start);
    made.back().arc.is_simplified = true;
  }
  Piece rest = given;
  for (const Vec2 foot : feet) {
    if (foot != given.start && foot != given.end) {
      made.back().arc.pieces.push_back(geometry::divided(rest, foot)[0]);
      rest = geometry::divided(rest, foot)[1];
      rest.corner = false;
    }
    if (foot != given.end)
      end_here(lines_[at].way + way_on(given, foot));
  }
  made.back().arc.pieces.push_back(rest);
  if (std::ranges::find(feet, given.end) != feet.end())
    end_here(lines_[at].way + given.length());
  return true;
}

/// Makes open arcs of the parts of a ring. If no arc ends where the ring begins, the last part goes on with the first.
void DividedLines::close(std::vector<Part>& parts, double whole) const {
  for (Part& part : parts)
    part.arc.closed = false;
  const Vec2 begin = parts.front().arc.pieces.front().start;
  const bool ends_here = std::ranges::any_of(
      feet_, [&](const auto& one) { return std::ranges::find(one.second, begin) != one.second.end(); });
  if (ends_here || parts.size() == 1)
    return;
  std::vector<Piece>& last = parts.back().arc.pieces;
  last.insert(last.end(), parts.front().arc.pieces.begin(), parts.front().arc.pieces.end());
  parts.back().to = whole + parts.front().to;
  parts.erase(parts.begin());
}

/// Names a part of an interface after the first curve that follows more than half of it.
void DividedLines::name(Part& part, std::size_t number, double whole) const {
  const auto found = followed_.find(number);
  if (found == followed_.end())
    return;
  struct Way {
    double from, to;
    bool is_backward;
  };
  std::map<int, std::vector<Way>> by_curve; // what each follows of this part
  for (const Followed& one : found->second)
    for (const double turn : {-whole, 0.0, whole}) {
      const double from = std::fmax(part.from, one.from + turn), to = std::fmin(part.to, one.to + turn);
      if (from < to && (turn == 0 || arcs_[number].closed))
        by_curve[one.part].push_back({from, to, one.is_backward});
    }
  for (auto& [curve, ways] : by_curve) {
    std::ranges::sort(ways, {}, [](const Way& way) { return std::pair(way.from, way.to); });
    double covered = 0, end = part.from, forward = 0;
    for (const Way& way : ways) {
      covered += std::fmax(0, way.to - std::fmax(way.from, end));
      end = std::fmax(end, way.to);
      forward += way.is_backward ? way.from - way.to : way.to - way.from;
    }
    if (!(covered > least_followed * (part.to - part.from)))
      continue;
    for (Piece& piece : part.arc.pieces)
      piece.part = curve;
    if (forward < 0)
      reverse(part.arc);
    return;
  }
}

} // namespace trime::generalise
