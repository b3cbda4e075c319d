// SPDX-License-Identifier: BSD-3-Clause
// Cuts the curves at their crossings: pieces from vertex to vertex, each kept once.
#include "geometry/predicates.hpp"
#include "shape/arrangement.hpp"
#include "shape/crossings.hpp"

#include <algorithm>
#include <array>

namespace trime::shape {

using geometry::orient2d;
using geometry::Segment;
using geometry::Vec2;

namespace {

/// Order by angle from 0 to 2 pi around the origin; exact.
bool comes_before(Vec2 u, Vec2 v) {
  const auto lower = [](Vec2 w) { return w.y < 0 || (w.y == 0 && w.x < 0); };
  if (lower(u) != lower(v))
    return lower(v);
  return orient2d({0, 0}, u, v) > 0;
}

} // namespace

void Arrangement::make_pieces() {
  const LocalIndex lines = static_cast<LocalIndex>(lines_.size());
  for (std::size_t k = 0; k < circles_.size(); ++k)
    for (const Vec2 p : quadrant_vertices(circles_[k]))
      splits_.push_back({lines + static_cast<LocalIndex>(k), vertices_.insert(p, circle_parts_[k][0])});
  std::sort(splits_.begin(), splits_.end(), [](const Split& a, const Split& b) {
    return a.curve != b.curve ? a.curve < b.curve : a.vertex < b.vertex;
  });
  const auto same = [](const Split& a, const Split& b) { return a.curve == b.curve && a.vertex == b.vertex; };
  splits_.erase(std::unique(splits_.begin(), splits_.end(), same), splits_.end());
  pieces_.reserve(lines_.size() + splits_.size());
  const Split *split = splits_.data(), *end = split + splits_.size();
  for (LocalIndex curve = 0; curve < lines + static_cast<LocalIndex>(circles_.size()); ++curve) {
    const Split* first = split;
    while (split < end && split->curve == curve)
      ++split;
    if (curve < lines)
      chain_line(curve, first, split);
    else
      chain_circle(curve - lines, first, split);
  }
}

void Arrangement::chain_line(LocalIndex line, const Split* first, const Split* last) {
  const Line& l = lines_[line];
  const Segment s = segment(line);
  std::vector<std::pair<double, LocalIndex>> between; // position along the line, vertex
  for (const Split* split = first; split < last; ++split)
    if (split->vertex != l.from && split->vertex != l.to)
      between.emplace_back(accurate_dot(vertices_.point(split->vertex) - s.a, s.b - s.a), split->vertex);
  std::sort(between.begin(), between.end());
  LocalIndex from = l.from;
  for (const auto& stop : between) {
    pieces_.push_back({from, stop.second, -1, l.part, 0, 0});
    from = stop.second;
  }
  if (from != l.to)
    pieces_.push_back({from, l.to, -1, l.part, 0, 0});
}

void Arrangement::chain_circle(LocalIndex circle, const Split* first, const Split* last) {
  const Vec2 center = circles_[circle].center;
  std::vector<LocalIndex> around;
  for (const Split* split = first; split < last; ++split)
    around.push_back(split->vertex);
  std::sort(around.begin(), around.end(), [&](LocalIndex a, LocalIndex b) {
    return comes_before(vertices_.point(a) - center, vertices_.point(b) - center);
  });
  const std::vector<int>& parts = circle_parts_[circle];
  for (std::size_t k = 0; k < around.size(); ++k) {
    pieces_.push_back({around[k], around[(k + 1) % around.size()], circle, parts[0],
                       static_cast<LocalIndex>(twins_.size()), static_cast<LocalIndex>(parts.size()) - 1});
    for (std::size_t j = 1; j < parts.size(); ++j)
      twins_.push_back({parts[j], true});
  }
}

void Arrangement::join_twins() {
  // Coincident segments have both ends on several parts, so few pieces need to be sorted.
  std::vector<LocalIndex> suspects;
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    if (pieces_[k].circle < 0 && vertices_.is_shared(pieces_[k].from) && vertices_.is_shared(pieces_[k].to))
      suspects.push_back(static_cast<LocalIndex>(k));
  const auto key = [&](LocalIndex k) {
    return std::array<LocalIndex, 3>{std::min(pieces_[k].from, pieces_[k].to), std::max(pieces_[k].from, pieces_[k].to),
                                     k};
  };
  std::sort(suspects.begin(), suspects.end(), [&](LocalIndex a, LocalIndex b) { return key(a) < key(b); });
  std::vector<bool> dropped(pieces_.size(), false);
  for (std::size_t k = 0, next = 0; k < suspects.size(); k = next) {
    Piece& kept = pieces_[suspects[k]];
    const auto first = key(suspects[k]);
    kept.first_twin = static_cast<LocalIndex>(twins_.size());
    for (next = k + 1; next < suspects.size(); ++next) {
      const auto other = key(suspects[next]);
      if (other[0] != first[0] || other[1] != first[1])
        break;
      const Piece& twin = pieces_[suspects[next]];
      twins_.push_back({twin.part, twin.from == kept.from});
      dropped[suspects[next]] = true;
    }
    kept.twin_count = static_cast<LocalIndex>(next - k) - 1;
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    if (!dropped[k])
      pieces_[count++] = pieces_[k];
  pieces_.resize(count);
}

} // namespace trime::shape
