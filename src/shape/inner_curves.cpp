// SPDX-License-Identifier: BSD-3-Clause
#include "shape/inner_curves.hpp"

#include "core/angle.hpp"
#include "geometry/inner_wedges.hpp"
#include "geometry/piece_parts.hpp"

#include <algorithm>
#include <utility>

namespace trime::shape {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

/// Follows pieces from vertex to vertex.
class PieceWalk {
public:
  PieceWalk(std::vector<CurvePiece> pieces, const std::vector<char>& on_boundary, const geometry::Periods& periods)
      : pieces_(std::move(pieces)), on_boundary_(on_boundary), periods_(periods), used_(pieces_.size(), 0) {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      ends_.emplace_back(pieces_[k].from, k);
      ends_.emplace_back(pieces_[k].to, k);
    }
    std::sort(ends_.begin(), ends_.end());
  }

  std::vector<InnerArc> arcs() {
    std::vector<InnerArc> found;
    for (std::size_t k = 0; k < pieces_.size(); ++k) // in the direction of the curve where that begins at a node
      if (used_[k] == 0 && is_node(pieces_[k].from))
        found.push_back(follow(k, pieces_[k].from));
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (used_[k] == 0 && is_node(pieces_[k].to))
        found.push_back(follow(k, pieces_[k].to));
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (used_[k] == 0)
        found.push_back(ring(k));
    std::stable_sort(found.begin(), found.end(), [](const InnerArc& a, const InnerArc& b) {
      return a.pieces.front().part < b.pieces.front().part;
    });
    return found;
  }

private:
  using End = std::pair<LocalIndex, std::size_t>; // vertex and piece

  std::pair<const End*, const End*> at_vertex(LocalIndex vertex) const {
    const auto low = std::lower_bound(ends_.begin(), ends_.end(), End{vertex, 0});
    auto high = low;
    while (high != ends_.end() && high->first == vertex)
      ++high;
    return {ends_.data() + (low - ends_.begin()), ends_.data() + (high - ends_.begin())};
  }

  bool is_node(LocalIndex vertex) const {
    const auto [low, high] = at_vertex(vertex);
    return on_boundary_[static_cast<std::size_t>(vertex)] != 0 || high - low != 2 ||
           pieces_[low->second].piece.part != pieces_[low[1].second].piece.part ||
           pair_of(pieces_[low->second]) != pair_of(pieces_[low[1].second]);
  }

  static std::pair<int, int> pair_of(const CurvePiece& piece) { return std::minmax({piece.left, piece.right}); }

  /// Appends a piece where the arc ends; the first one begins in the container.
  void append(const Piece& piece, InnerArc& arc) const {
    const Vec2 at = arc.pieces.empty() ? periods_.wrap(piece.start) : arc.pieces.back().end;
    arc.pieces.push_back(at == piece.start ? piece : moved(piece, at - piece.start));
  }

  /// From a vertex along a piece to the next node, or once around.
  InnerArc follow(std::size_t piece, LocalIndex from) {
    InnerArc arc;
    arc.left = pieces_[piece].from == from ? pieces_[piece].left : pieces_[piece].right;
    arc.right = pieces_[piece].from == from ? pieces_[piece].right : pieces_[piece].left;
    for (LocalIndex at = from;;) {
      const CurvePiece& next = pieces_[piece];
      used_[piece] = 1;
      append(next.from == at ? next.piece : reversed(next.piece), arc);
      at = next.from == at ? next.to : next.from;
      if (is_node(at))
        return arc;
      const auto [low, high] = at_vertex(at);
      piece = low->second == piece ? low[1].second : low->second;
      if (used_[piece] != 0)
        return arc;
    }
  }

  InnerArc ring(std::size_t piece) {
    InnerArc arc = follow(piece, pieces_[piece].from);
    arc.closed = true;
    arc.winding = arc.pieces.back().end - arc.pieces.front().start;
    const auto first = std::min_element(arc.pieces.begin(), arc.pieces.end(), [this](const Piece& a, const Piece& b) {
      return periods_.less(a.start, b.start);
    });
    std::rotate(arc.pieces.begin(), first, arc.pieces.end());
    if (periods_.any())
      for (Piece& rotated : std::exchange(arc.pieces, {}))
        append(rotated, arc);
    return arc;
  }

  std::vector<CurvePiece> pieces_;
  const std::vector<char>& on_boundary_;
  const geometry::Periods& periods_;
  std::vector<char> used_;
  std::vector<End> ends_;
};

} // namespace

Piece moved(Piece piece, Vec2 by) {
  piece.start = piece.start + by;
  piece.end = piece.end + by;
  piece.center = piece.center + by;
  return piece;
}

std::vector<InnerArc> join_pieces(std::vector<CurvePiece> pieces, const std::vector<char>& on_boundary,
                                  const geometry::Boundary& boundary) {
  std::vector<InnerArc> arcs = PieceWalk(std::move(pieces), on_boundary, boundary.periods).arcs();
  geometry::set_wedges(arcs, boundary);
  return arcs;
}

} // namespace trime::shape
