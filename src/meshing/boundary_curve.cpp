// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/boundary_curve.hpp"

#include "meshing/chord_curve.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::meshing {

using geometry::Vec2;

namespace {

constexpr double cosine_of_bent = 0.99996, cosine_of_sharp = 0.8660254037844386; // half a degree, 30 degrees

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace

BoundaryCurve::BoundaryCurve(const geometry::Boundary& boundary) : boundary_(boundary) {
  for (const geometry::Loop& loop : boundary.loops) {
    Arcs arcs{{0}, {}, 0};
    for (const geometry::Piece& piece : loop.pieces)
      arcs.starts.push_back(arcs.starts.back() + piece.length());
    arcs.cells_per_arc = static_cast<double>(loop.pieces.size()) / arcs.starts.back();
    for (std::size_t k = 0; k < arcs.starts.size(); ++k)
      arcs.first_in_cell.resize(std::max(arcs.first_in_cell.size(), arcs.cell(arcs.starts[k]) + 1),
                                static_cast<std::uint32_t>(k));
    arcs.first_in_cell.push_back(static_cast<std::uint32_t>(arcs.starts.size()));
    arcs_.push_back(std::move(arcs));
  }
}

std::size_t BoundaryCurve::Arcs::cell(double arc) const {
  const double place = arc * cells_per_arc;
  return place > 0 ? static_cast<std::size_t>(std::fmin(place, static_cast<double>(starts.size()))) : 0;
}

/// The last one that begins at this arc or before, in [0, pieces - 1]. Cells are monotone in the arc, so that no start
/// in a cell before lies behind it, and none in a cell behind lies before it.
std::size_t BoundaryCurve::Arcs::piece(double arc) const {
  const std::size_t its_cell = std::min(cell(arc), first_in_cell.size() - 2);
  const auto begin = starts.begin();
  const auto above = std::upper_bound(begin + first_in_cell[its_cell], begin + first_in_cell[its_cell + 1], arc);
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - begin - 1, 0, std::ssize(starts) - 2));
}

BoundaryCurve::Place BoundaryCurve::place(LocalIndex loop, double arc) const {
  const Arcs& arcs = arcs_[at(loop)];
  const geometry::Loop& curve = boundary_.loops[at(loop)];
  const double length = arcs.starts.back(), turns = arc >= length ? 1 : arc < 0 ? -1 : 0;
  arc -= turns * length;
  const std::size_t piece = arcs.piece(arc);
  const double along = arc - arcs.starts[piece];
  const geometry::Piece& on = curve.pieces[piece];
  return {static_cast<LocalIndex>(piece), along, on.point(along) + turns * curve.winding, on.tangent(along)};
}

BoundaryCurve::Strayed BoundaryCurve::strayed(LocalIndex loop, double from, double to,
                                              const geometry::Segment& chord) const {
  const std::vector<double>& starts = arcs_[at(loop)].starts;
  const geometry::Loop& curve = boundary_.loops[at(loop)];
  if (to < from)
    to += starts.back();
  const Place first = place(loop, from);
  const Vec2 shift = chord.a - first.point;
  const double rounding = 1e-9 * geometry::squared_length(chord.b - chord.a);
  Strayed result;
  double squared = 0;
  const auto look = [&](Vec2 p, double arc) {
    if (const double distance = geometry::squared_distance(p, chord); distance > squared) {
      squared = distance;
      result.farthest = arc;
    }
    result.leaves_disc |= geometry::dot(chord.a - p, chord.b - p) > rounding;
  };
  Vec2 moved = shift;
  double turns = from >= starts.back() ? 1 : from < 0 ? -1 : 0;
  double passed = from - first.along; // arc at the start of the piece
  std::size_t k = static_cast<std::size_t>(first.piece);
  for (std::size_t visited = 0; visited <= curve.pieces.size() && passed < to; ++visited) {
    const geometry::Piece& piece = curve.pieces[k];
    const double length = starts[k + 1] - starts[k];
    if (passed > from) {
      look(piece.start + moved, starts[k] + turns * starts.back()); // bit for bit that of the junction
      const geometry::Piece& before = curve.pieces[k == 0 ? curve.pieces.size() - 1 : k - 1];
      const double cosine = geometry::dot(before.tangent(before.length()), piece.tangent(0));
      result.bent |= cosine < cosine_of_bent;
      result.sharp |= cosine < cosine_of_sharp;
    }
    for (int quarter = 1; piece.circular && quarter < 4; ++quarter) {
      const double low = std::fmax(from - passed, 0), high = std::fmin(to - passed, length);
      const double along = low + 0.25 * quarter * (high - low);
      look(piece.point(along) + moved, passed + along);
    }
    passed += length;
    if (++k == curve.pieces.size()) {
      k = 0;
      ++turns;
      moved = moved + curve.winding;
    }
  }
  result.deviation = std::sqrt(squared);
  return result;
}

LocalIndex loop_of(const BoundarySites& boundary, LocalIndex site) {
  const auto above = std::upper_bound(boundary.loop_start.begin(), boundary.loop_start.end(), site);
  return static_cast<LocalIndex>(above - boundary.loop_start.begin()) - 1;
}

namespace {

/// @brief Sorts the insertions into one chord by their way from its first site.
/// @return behind the last of them
std::size_t order_insertions(std::vector<BoundaryEdit>& edits, std::size_t first, double arc, double length) {
  std::size_t past = first;
  while (past < edits.size() && edits[past].site == edits[first].site)
    ++past;
  const auto way = [&](const BoundaryEdit& edit) { return edit.arc >= arc ? edit.arc - arc : edit.arc - arc + length; };
  std::sort(edits.begin() + static_cast<std::ptrdiff_t>(first), edits.begin() + static_cast<std::ptrdiff_t>(past),
            [&](const BoundaryEdit& a, const BoundaryEdit& b) { return way(a) < way(b); });
  for (std::size_t k = first; k < past; ++k)
    if (edits[k].kind != BoundaryEdit::Kind::insert ||
        (k > first && (edits[k].patch != edits[first].patch || !(way(edits[k - 1]) < way(edits[k])))))
      throw InternalError(fmt::format("two changes of one boundary site or chord, at ({}, {})", edits[k].position.x,
                                      edits[k].position.y));
  return past;
}

} // namespace

std::vector<LocalIndex> edit_boundary(BoundarySites& boundary, const BoundaryCurve& curve,
                                      std::vector<BoundaryEdit>& edits, std::vector<LocalIndex>& inserted) {
  std::sort(edits.begin(), edits.end(), [](const BoundaryEdit& a, const BoundaryEdit& b) {
    return a.site != b.site ? a.site < b.site : a.kind < b.kind;
  });
  inserted.assign(edits.size(), -1);
  const BoundarySites old = std::move(boundary);
  boundary = old;
  boundary.sites.clear();
  boundary.loop_start.assign(1, 0);
  std::vector<LocalIndex> new_index(old.sites.size(), -1);
  std::size_t next = 0;
  const auto put = [&](BoundarySite site, const BoundaryEdit& edit, const BoundaryCurve::Place& place) {
    site.position = edit.position;
    site.piece = place.piece;
    site.along = place.along;
    boundary.sites.push_back(site);
    return static_cast<LocalIndex>(boundary.sites.size()) - 1;
  };
  for (std::size_t loop = 0; loop + 1 < old.loop_start.size(); ++loop) {
    const auto number = static_cast<LocalIndex>(loop);
    const LocalIndex first = boundary.loop_start.back();
    for (LocalIndex k = old.loop_start[loop]; k < old.loop_start[loop + 1]; ++k) {
      const BoundarySite& site = old.sites[at(k)];
      double arc = curve.arc(number, site);
      if (next < edits.size() && edits[next].site == k && edits[next].kind != BoundaryEdit::Kind::insert) {
        const BoundaryEdit& edit = edits[next++];
        if (edit.kind == BoundaryEdit::Kind::slide) {
          arc = edit.arc;
          new_index[at(k)] = put(site, edit, curve.place(number, arc));
        }
      } else {
        new_index[at(k)] = static_cast<LocalIndex>(boundary.sites.size());
        boundary.sites.push_back(site);
      }
      const std::size_t past = next < edits.size() && edits[next].site == k
                                   ? order_insertions(edits, next, arc, curve.length(number))
                                   : next;
      for (; next < past; ++next) {
        inserted[next] = put(site, edits[next], curve.place(number, edits[next].arc));
        boundary.sites.back().corner = false;
      }
    }
    const auto end = static_cast<LocalIndex>(boundary.sites.size());
    for (LocalIndex k = first; k < end; ++k) {
      BoundarySite& site = boundary.sites[at(k)];
      site.previous = k == first ? end - 1 : k - 1;
      site.next = k + 1 == end ? first : k + 1;
    }
    boundary.loop_start.push_back(end);
  }
  TRIME_ASSERT(next == edits.size(), "edits of boundary sites that do not exist");
  boundary.shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < boundary.sites.size(); ++k) {
    BoundarySite& site = boundary.sites[k];
    const Vec2 end = boundary.sites[at(site.next)].position, image = boundary.periods.nearest_image(end, site.position);
    site.next_shift = image - end;
    boundary.shortest = std::fmin(boundary.shortest, geometry::length(image - site.position));
  }
  name_parts(curve.boundary(), boundary);
  return new_index;
}

} // namespace trime::meshing
