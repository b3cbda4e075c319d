// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/boundary_chain.hpp"

#include "polygon/chord_curve.hpp"
#include "polygon/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::polygon {

using geometry::Vec2;

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

BoundaryCurve::CurvePlace BoundaryCurve::place(LocalIndex loop, double arc) const {
  const Arcs& arcs = arcs_[at(loop)];
  const geometry::Loop& curve = boundary_.loops[at(loop)];
  const double length = arcs.starts.back(), turns = arc >= length ? 1 : arc < 0 ? -1 : 0;
  arc -= turns * length;
  const std::size_t piece = arcs.piece(arc);
  const double along = arc - arcs.starts[piece];
  const geometry::Piece& on = curve.pieces[piece];
  return {static_cast<LocalIndex>(piece), along, on.point(along) + turns * curve.winding, on.tangent(along)};
}

namespace {

/// How far places of the curve lie from a chord, one after the other.
class StrayedFrom {
public:
  explicit StrayedFrom(const geometry::Segment& chord)
      : chord_(chord), rounding_(1e-9 * geometry::squared_length(chord.b - chord.a)) {}

  void look(Vec2 p, double arc) {
    if (const double distance = geometry::squared_distance(p, chord_); distance > squared_) {
      squared_ = distance;
      result_.farthest = arc;
    }
    result_.leaves_disc |= geometry::dot(chord_.a - p, chord_.b - p) > rounding_;
  }
  void turn(double cosine) {
    result_.bent |= cosine < PolygonRules::cosine_of_bent;
    result_.sharp |= cosine < PolygonRules::cosine_of_sharp;
  }
  BoundaryCurve::Strayed result() {
    result_.deviation = std::sqrt(squared_);
    return result_;
  }

private:
  const geometry::Segment& chord_;
  const double rounding_;
  double squared_ = 0;
  BoundaryCurve::Strayed result_;
};

} // namespace

BoundaryCurve::Strayed BoundaryCurve::strayed(LocalIndex loop, double from, double to,
                                              const geometry::Segment& chord) const {
  const std::vector<double>& starts = arcs_[at(loop)].starts;
  const geometry::Loop& curve = boundary_.loops[at(loop)];
  if (to < from)
    to += starts.back();
  const CurvePlace first = place(loop, from);
  StrayedFrom stray(chord);
  Vec2 moved = chord.a - first.point;
  double turns = from >= starts.back() ? 1 : from < 0 ? -1 : 0;
  double passed = from - first.along; // arc at the start of the piece
  std::size_t k = static_cast<std::size_t>(first.piece);
  for (std::size_t visited = 0; visited <= curve.pieces.size() && passed < to; ++visited) {
    const geometry::Piece& piece = curve.pieces[k];
    const double length = starts[k + 1] - starts[k];
    if (passed > from) {
      stray.look(piece.start + moved, starts[k] + turns * starts.back()); // bit for bit that of the junction
      const geometry::Piece& before = curve.pieces[k == 0 ? curve.pieces.size() - 1 : k - 1];
      stray.turn(geometry::dot(before.tangent(before.length()), piece.tangent(0)));
    }
    for (int quarter = 1; piece.circular && quarter < 4; ++quarter) {
      const double low = std::fmax(from - passed, 0), high = std::fmin(to - passed, length);
      const double along = low + 0.25 * quarter * (high - low);
      stray.look(piece.point(along) + moved, passed + along);
    }
    passed += length;
    if (++k == curve.pieces.size()) {
      k = 0;
      ++turns;
      moved = moved + curve.winding;
    }
  }
  return stray.result();
}

BoundaryChain::BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve)
    : curve_(curve), sites_(boundary), is_gone_(boundary.sites.size(), 0) {
  for (std::size_t loop = 0; loop + 1 < boundary.loop_start.size(); ++loop)
    loops_.resize(at(boundary.loop_start[loop + 1]), static_cast<LocalIndex>(loop));
}

void BoundaryChain::place(LocalIndex site, double arc, geometry::Vec2 position) {
  const BoundaryCurve::CurvePlace on = curve_.place(loop(site), arc);
  BoundarySite& its = sites_.sites[at(site)];
  its.position = position;
  its.piece = on.piece;
  its.along = on.along;
}

/// To the image of the next site that is near.
void BoundaryChain::close_chord(LocalIndex site) {
  BoundarySite& its = sites_.sites[at(site)];
  const geometry::Vec2 end = sites_.sites[at(its.next)].position;
  its.next_shift = sites_.periods.nearest_image(end, its.position) - end;
}

/// Patches that do not overlap change each site once, only one of them divides a chord, and all know which sites there
/// are. @param edits by site, insertions into a chord by their arcs
void BoundaryChain::check(std::span<const BoundaryEdit> edits) const {
  for (std::size_t k = 0; k < edits.size(); ++k) {
    const BoundaryEdit& edit = edits[k];
    const auto fail = [&](const char* what) {
      throw InternalError(fmt::format("{}, at ({}, {})", what, edit.position.x, edit.position.y));
    };
    if (is_gone_[at(edit.site)])
      fail("there is a change of a boundary site that was removed before");
    if (k == 0 || edits[k - 1].site != edit.site)
      continue;
    const BoundaryEdit& other = edits[k - 1];
    if (edit.kind != EditKind::insert || edit.patch != other.patch || edit.arc == other.arc)
      fail("there are two changes of the same boundary site or boundary edge");
  }
}

void BoundaryChain::move_or_remove(const BoundaryEdit& edit, std::vector<LocalIndex>& changed) {
  if (edit.kind == EditKind::move) {
    place(edit.site, edit.arc, edit.position);
    changed.push_back(edit.site);
    return;
  }
  const BoundarySite& its = sites_.sites[at(edit.site)];
  sites_.sites[at(its.previous)].next = its.next;
  sites_.sites[at(its.next)].previous = its.previous;
  is_gone_[at(edit.site)] = 1;
  changed.push_back(its.previous);
}

/// Behind the site that the edit names.
void BoundaryChain::insert(const BoundaryEdit& edit, std::vector<LocalIndex>& changed) {
  const auto made = static_cast<LocalIndex>(sites_.sites.size());
  BoundarySite site = sites_.sites[at(edit.site)];
  site.previous = edit.site;
  site.corner = false;
  sites_.sites[at(site.next)].previous = made;
  sites_.sites[at(edit.site)].next = made;
  sites_.sites.push_back(site);
  loops_.push_back(loop(edit.site));
  is_gone_.push_back(0);
  place(made, edit.arc, edit.position);
  changed.push_back(made);
  changed.push_back(edit.site);
}

std::vector<LocalIndex> BoundaryChain::apply(std::vector<BoundaryEdit> edits) {
  const auto insertions = std::stable_partition(edits.begin(), edits.end(),
                                                [](const BoundaryEdit& edit) { return edit.kind != EditKind::insert; });
  std::sort(edits.begin(), insertions, [](const BoundaryEdit& a, const BoundaryEdit& b) { return a.site < b.site; });
  check({edits.begin(), insertions});
  std::vector<LocalIndex> changed;
  for (auto edit = edits.begin(); edit != insertions; ++edit)
    move_or_remove(*edit, changed);
  const auto way = [&](const BoundaryEdit& edit) { // from the site before
    const double arc = edit.arc - curve_.arc(loop(edit.site), sites_.sites[at(edit.site)]);
    return arc >= 0 ? arc : arc + curve_.length(loop(edit.site));
  };
  std::sort(insertions, edits.end(), [&](const BoundaryEdit& a, const BoundaryEdit& b) {
    return a.site != b.site ? a.site < b.site : way(a) > way(b); // the last comes first: each goes behind `site`
  });
  check({insertions, edits.end()});
  for (auto edit = insertions; edit != edits.end(); ++edit)
    insert(*edit, changed);
  std::erase_if(changed, [&](LocalIndex site) { return is_gone_[at(site)] != 0; });
  for (const LocalIndex site : changed) {
    close_chord(site);
    close_chord(sites_.sites[at(site)].previous);
  }
  return changed;
}

/// The sites along the loops, by the indices that they have.
std::vector<LocalIndex> BoundaryChain::list_along_loops() {
  const std::size_t loops = sites_.loop_start.size() - 1;
  std::vector<LocalIndex> first(loops, -1), order;
  for (LocalIndex k = static_cast<LocalIndex>(sites_.sites.size()) - 1; k >= 0; --k)
    if (!is_gone_[at(k)])
      first[at(loop(k))] = k;
  for (std::size_t l = 0; l < loops; ++l) {
    if (LocalIndex k = first[l]; k >= 0)
      do
        order.push_back(k);
      while ((k = sites_.sites[at(k)].next) != first[l]);
    sites_.loop_start[l + 1] = static_cast<LocalIndex>(order.size());
  }
  return order;
}

std::vector<LocalIndex> BoundaryChain::renumber() {
  const std::vector<LocalIndex> order = list_along_loops();
  std::vector<LocalIndex> new_index(sites_.sites.size(), -1), loops;
  for (std::size_t k = 0; k < order.size(); ++k)
    new_index[at(order[k])] = static_cast<LocalIndex>(k);
  std::vector<BoundarySite> sites;
  for (const LocalIndex k : order) {
    BoundarySite& site = sites.emplace_back(sites_.sites[at(k)]);
    site.previous = new_index[at(site.previous)];
    site.next = new_index[at(site.next)];
    loops.push_back(loop(k));
  }
  sites_.sites = std::move(sites);
  loops_ = std::move(loops);
  is_gone_.assign(order.size(), 0);
  sites_.shortest = std::numeric_limits<double>::infinity();
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(order.size()); ++k) {
    close_chord(k);
    const geometry::Segment chord = sites_.chord(k);
    sites_.shortest = std::fmin(sites_.shortest, geometry::length(chord.b - chord.a));
  }
  name_parts(curve_.boundary(), sites_);
  return new_index;
}

} // namespace trime::polygon
