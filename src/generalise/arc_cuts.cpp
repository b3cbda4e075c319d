// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/arc_cuts.hpp"

#include "generalise/rules.hpp"
#include "geometry/piece_parts.hpp"

namespace trime::generalise {
namespace {

// [h] The line may lead so far in addition to three times the way between the samples.
constexpr double longest_jump = 1.0;

using geometry::InnerArc;
using geometry::Lattice;
using geometry::Piece;
using geometry::Vec2;

/// The pieces from one sample to another one.
std::vector<Piece> part_of(const std::vector<Piece>& pieces, const Sample& from, const Sample& to,
                           const Lattice& lattice) {
  const Vec2 start = lattice.snap(from.place), end = lattice.snap(to.place);
  std::vector<Piece> part;
  for (std::size_t k = from.piece; k <= to.piece && (start != end || from.piece < to.piece); ++k) {
    Piece piece = pieces[k];
    if ((k == from.piece && start == piece.end) || (k == to.piece && end == piece.start))
      continue;
    if (k == to.piece && end != piece.end)
      piece = geometry::divided(piece, end)[0];
    if (k == from.piece && start != piece.start) {
      piece = geometry::divided(piece, start)[1];
      piece.corner = false;
    }
    part.push_back(piece);
  }
  return part;
}

} // namespace

bool Sample::is_near() const {
  return distance < GeneraliseRules::rim_distance * h;
}

double longest_way_beside(const Sample& before, const Sample& behind) {
  return longest_jump * behind.h + 3 * (behind.way - before.way);
}

Piece ArcCuts::edge(Vec2 from, Vec2 to, const Lattice& lattice) const {
  Piece edge;
  edge.start = lattice.snap(from);
  edge.end = lattice.snap(to);
  edge.part = given->pieces.front().part;
  edge.region = given->pieces.front().region;
  return edge;
}

std::vector<InnerArc> ArcCuts::rest(const Lattice& lattice) const {
  std::vector<InnerArc> made;
  std::size_t from = 0; // the first sample that is left
  std::optional<Foot> foot;
  const auto add = [&](std::size_t last, const std::optional<Foot>& end) {
    InnerArc& left = made.emplace_back(*given);
    left.closed = false;
    left.pieces = part_of(given->pieces, samples[from], samples[last], lattice);
    if (foot)
      left.pieces.insert(left.pieces.begin(), edge(foot->place, samples[from].place, lattice));
    if (end)
      left.pieces.push_back(edge(samples[last].place, end->place, lattice));
  };
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!is_end(runs[k], 0))
      add(runs[k].first - 1, feet[k][0]);
    from = runs[k].last + 1;
    foot = feet[k][1];
  }
  if (from < samples.size())
    add(samples.size() - 1, std::nullopt);
  if (given->closed && made.size() > 1) { // the ring began between two runs
    std::vector<Piece>& last = made.back().pieces;
    last.insert(last.end(), made.front().pieces.begin(), made.front().pieces.end());
    made.erase(made.begin());
  }
  return made;
}

} // namespace trime::generalise
