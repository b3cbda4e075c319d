// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/arc_chords.hpp"

#include "generalise/curve_places.hpp"
#include "generalise/rules.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

/// All circular pieces of interfaces.
class CircularPieces {
public:
  explicit CircularPieces(const std::vector<InnerArc>& arcs) {
    geometry::Boundary all;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      if (arcs[k].left == arcs[k].right)
        continue;
      geometry::Loop circles;
      for (const Piece& piece : arcs[k].pieces)
        if (piece.circular) {
          circles.pieces.push_back(piece);
          arc_of_.push_back(k);
        }
      if (!circles.pieces.empty())
        all.loops.push_back(std::move(circles));
    }
    tree_ = geometry::PieceTree(all);
  }
  bool empty() const { return arc_of_.empty(); }

  /// Marks the arcs that a curve follows.
  void mark_followed(const InnerArc& curve, const sizing::SizeField& size, std::vector<char>& is_followed) const {
    const std::array<Vec2, 2> ends{curve.pieces.front().start, curve.pieces.back().end};
    const auto is_near = [&](Vec2 p, double reach, double h) {
      return !tree_.within(p, reach + GeneraliseRules::grown_distance * GeneraliseRules::snap_distance * h).empty();
    };
    // A curve that has more places than can be visited is compared at its first places only.
    std::ignore = visit_places(std::span(curve.pieces), is_near, [&](std::size_t k, double along) {
      const Vec2 p = curve.pieces[k].point(along);
      const double h = sizing::checked_size(size, p);
      mark_near(p, h, curve.closed ? nullptr : &ends, is_followed);
      return h;
    });
  }

private:
  void mark_near(Vec2 p, double h, const std::array<Vec2, 2>* ends, std::vector<char>& is_followed) const {
    const double to_end =
        ends == nullptr ? INFINITY : std::fmin(geometry::length((*ends)[0] - p), geometry::length((*ends)[1] - p));
    if (to_end < GeneraliseRules::place_step * h)
      return; // it may lie on the interface
    const double reach = std::fmin(GeneraliseRules::snap_distance * h, GeneraliseRules::narrow_share * to_end);
    for (const std::size_t k : tree_.within(p, reach))
      is_followed[arc_of_[k]] = 1;
  }

  std::vector<std::size_t> arc_of_; // by piece of the tree
  geometry::PieceTree tree_;
};

/// Chords in place of the circular pieces of an arc.
void make_chords(InnerArc& arc, const ArcRequest& request) {
  std::vector<Piece> pieces;
  for (const Piece& piece : arc.pieces) {
    if (!piece.circular) {
      pieces.push_back(piece);
      continue;
    }
    const int chords = chords_along(piece, request.size);
    for (int k = 0; k < chords; ++k) {
      Piece& chord = pieces.emplace_back();
      chord.start = k == 0 ? piece.start : pieces[pieces.size() - 2].end;
      chord.end = k + 1 == chords ? piece.end : request.lattice.snap(piece.point(piece.length() * (k + 1) / chords));
      chord.part = piece.part;
      chord.corner = k == 0 && piece.corner;
      arc.lost_area += area_on_chord(geometry::length(chord.end - chord.start), piece.sweep / chords);
    }
  }
  arc.pieces = std::move(pieces);
  arc.is_simplified = true;
}

} // namespace

int chords_along(const Piece& piece, const sizing::SizeField& size) {
  if (!piece.circular)
    return 1;
  double h = sizing::checked_size(size, piece.start);
  for (const Vec2 p : {piece.point(0.5 * piece.length()), piece.end})
    h = std::fmin(h, sizing::checked_size(size, p));
  const double step =
      std::fmin(GeneraliseRules::arc_step, std::sqrt(8 * GeneraliseRules::arc_depth * h / piece.radius));
  return std::max(1, static_cast<int>(std::ceil(std::fabs(piece.sweep) / step)));
}

double area_on_chord(double length, double sweep) {
  if (sweep == 0)
    return 0;
  const double radius = length / (2 * std::sin(0.5 * std::fabs(sweep)));
  return 0.5 * radius * radius * (sweep - std::sin(sweep));
}

std::optional<Partition> with_chords_along_curves(const Partition& given, const ArcRequest& request) {
  const std::vector<InnerArc>& arcs = given.curves.arcs;
  const CircularPieces circles(arcs);
  if (circles.empty())
    return std::nullopt;
  std::vector<char> is_followed(arcs.size(), 0);
  for (const InnerArc& arc : arcs)
    if (arc.left == arc.right)
      circles.mark_followed(arc, request.size, is_followed);
  if (std::ranges::find(is_followed, 1) == is_followed.end())
    return std::nullopt;
  Partition made = given;
  for (std::size_t k = 0; k < arcs.size(); ++k)
    if (is_followed[k] != 0)
      make_chords(made.curves.arcs[k], request);
  return made;
}

} // namespace trime::generalise
