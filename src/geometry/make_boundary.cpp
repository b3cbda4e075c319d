// SPDX-License-Identifier: BSD-3-Clause
// From the arrangement of the parts to the boundary of the region: classify the pieces, check, chain into loops.
#include "arrangement.hpp"
#include "trime/core/angle.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/shape.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace trime::geometry {

namespace {

/// The container as a part.
Part domain_part(const Frame& frame) {
  return Part::rectangle(std::string(domain_name), frame.inner(), frame);
}

double twice_area_under(const Piece& piece, Vec2 origin) {
  double area = cross(piece.start - origin, piece.end - origin);
  if (piece.circular)
    area += piece.radius * piece.radius * (piece.sweep - sin_cos(piece.sweep).sin);
  return area;
}

Piece reversed_arc(Piece arc) {
  const Vec2 from = arc.end - arc.center;
  std::swap(arc.start, arc.end);
  arc.start_angle = angle_of(from.y, from.x);
  arc.sweep = -arc.sweep;
  return arc;
}

class BoundaryMaker {
public:
  BoundaryMaker(const Region& region, std::span<const Part> parts, const Frame& frame)
      : region_(region), frame_(frame), domain_(domain_part(frame)), placed_(place(region, parts)),
        arrangement_(placed_, frame) {
    for (const Part& part : parts)
      boundary_.part_names.push_back(part.name());
    if (region.parts().back() == static_cast<int>(parts.size()))
      boundary_.part_names.emplace_back(domain_name);
  }

  Boundary make() {
    classify();
    if (!kept_.empty())
      check_container();
    link();
    chain();
    if (boundary_.loops.empty())
      throw GeometryError(fmt::format("the region '{}' is empty: no part of the plane lies in it", region_.text()));
    return std::move(boundary_);
  }

private:
  /// A piece of the arrangement, directed so that the region lies on its left.
  struct Kept {
    LocalIndex from, to, piece;
    bool reversed;
  };

  std::vector<PlacedPart> place(const Region& region, std::span<const Part> parts) const {
    std::vector<PlacedPart> placed;
    for (const int index : region.parts())
      placed.push_back({index < static_cast<int>(parts.size()) ? &parts[index] : &domain_, index});
    return placed;
  }

  Vec2 middle(const Arrangement::Piece& piece) const;
  void classify();
  void check_container() const;
  void link();
  [[noreturn]] void report_vertex(LocalIndex vertex) const;
  void chain();
  Piece finished(const Kept& kept) const;
  void add_loop(std::vector<LocalIndex>& cycle);

  const Region& region_;
  const Frame& frame_;
  const Part domain_;
  const std::vector<PlacedPart> placed_;
  const Arrangement arrangement_;
  std::vector<Kept> kept_;
  std::vector<LocalIndex> next_; // the kept piece that leaves each vertex, or -1
  Boundary boundary_;
};

/// A lattice point next to the middle of the piece.
Vec2 BoundaryMaker::middle(const Arrangement::Piece& piece) const {
  const Vec2 a = arrangement_.vertices().point(piece.from), b = arrangement_.vertices().point(piece.to);
  if (piece.circle < 0)
    return frame_.lattice().snap(a + 0.5 * (b - a));
  const Circle& circle = arrangement_.circles()[piece.circle];
  const Vec2 bisector = (a - circle.center) + (b - circle.center);
  return frame_.lattice().snap(circle.center + (circle.radius / length(bisector)) * bisector);
}

void BoundaryMaker::classify() {
  std::vector<char> left(boundary_.part_names.size(), 0), right = left;
  const std::vector<Arrangement::Piece>& pieces = arrangement_.pieces();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Arrangement::Piece& piece = pieces[k];
    constexpr char unknown = 2;
    for (const PlacedPart& placed : placed_)
      left[placed.index] = unknown;
    left[piece.part] = 1;
    right[piece.part] = 0;
    for (LocalIndex t = piece.first_twin; t < piece.first_twin + piece.twin_count; ++t) {
      const Arrangement::Twin& twin = arrangement_.twins()[t];
      left[twin.part] = twin.along ? 1 : 0;
      right[twin.part] = twin.along ? 0 : 1;
    }
    const Vec2 p = middle(piece);
    for (const PlacedPart& placed : placed_)
      if (left[placed.index] == unknown)
        left[placed.index] = right[placed.index] = placed.part->inside(p) ? 1 : 0;
    const bool on_left = region_.contains([&](int part) { return left[part] != 0; });
    const bool on_right = region_.contains([&](int part) { return right[part] != 0; });
    if (on_left && !on_right)
      kept_.push_back({piece.from, piece.to, static_cast<LocalIndex>(k), false});
    else if (on_right && !on_left)
      kept_.push_back({piece.to, piece.from, static_cast<LocalIndex>(k), true});
  }
}

void BoundaryMaker::check_container() const {
  const Box& box = frame_.container();
  const double allowed = VertexTable::merge_steps * frame_.step();
  double worst = allowed;
  const Kept* farthest = nullptr;
  std::size_t outside = 0;
  // Arcs reach farthest at their ends or at quadrant vertices, which are ends, too.
  for (const Kept& kept : kept_) {
    const Vec2 p = arrangement_.vertices().point(kept.from);
    const double excess = std::max({box.min.x - p.x, p.x - box.max.x, box.min.y - p.y, p.y - box.max.y});
    outside += excess > allowed ? 1 : 0;
    if (excess > worst) {
      worst = excess;
      farthest = &kept;
    }
  }
  if (farthest == nullptr)
    return;
  const Vec2 p = arrangement_.vertices().point(farthest->from);
  throw GeometryError(fmt::format(
      "the region '{}' {} the container [{}, {}] x [{}, {}]: part '{}' reaches ({:.9g}, {:.9g}), {:.3g} "
      "beyond it; enlarge [domain], move the part, or intersect with 'domain'",
      region_.text(), outside == kept_.size() ? "lies outside" : "lies partly outside", box.min.x, box.max.x, box.min.y,
      box.max.y, boundary_.part_names[arrangement_.pieces()[farthest->piece].part], p.x, p.y, worst));
}

void BoundaryMaker::link() {
  const LocalIndex count = arrangement_.vertices().size();
  std::vector<LocalIndex> arrivals(count, 0), departures(count, 0);
  next_.assign(count, -1);
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    next_[kept_[k].from] = static_cast<LocalIndex>(k);
    ++departures[kept_[k].from];
    ++arrivals[kept_[k].to];
  }
  for (const Kept& kept : kept_)
    for (const LocalIndex v : {kept.from, kept.to})
      if (arrivals[v] != 1 || departures[v] != 1)
        report_vertex(v);
}

void BoundaryMaker::report_vertex(LocalIndex vertex) const {
  std::set<std::string> names;
  int arrivals = 0, departures = 0;
  for (const Kept& kept : kept_)
    if (kept.from == vertex || kept.to == vertex) {
      const Arrangement::Piece& piece = arrangement_.pieces()[kept.piece];
      names.insert(boundary_.part_names[piece.part]);
      arrivals += kept.to == vertex ? 1 : 0;
      departures += kept.from == vertex ? 1 : 0;
    }
  std::string list;
  for (const std::string& name : names)
    list += fmt::format("{}'{}'", list.empty() ? "" : ", ", name);
  const Vec2 p = arrangement_.vertices().point(vertex);
  if (arrivals == departures)
    throw GeometryError(fmt::format("the boundary of the region '{}' touches itself at ({:.12g}, {:.12g}) (part {}); "
                                    "expected curves that do not meet: move the parts apart, or make them overlap",
                                    region_.text(), p.x, p.y, list));
  throw GeometryError(fmt::format("boundaries of parts of the region '{}' nearly coincide at ({:.12g}, {:.12g}) (part "
                                  "{}): they are nearer than about {:.2g} to each other but not equal; make them "
                                  "equal, or move them apart",
                                  region_.text(), p.x, p.y, list, VertexTable::merge_steps * frame_.step()));
}

void BoundaryMaker::chain() {
  std::vector<bool> used(kept_.size(), false);
  std::vector<LocalIndex> cycle;
  for (std::size_t first = 0; first < kept_.size(); ++first) {
    if (used[first])
      continue;
    cycle.clear();
    for (LocalIndex k = static_cast<LocalIndex>(first); !used[k]; k = next_[kept_[k].to]) {
      used[k] = true;
      cycle.push_back(k);
    }
    add_loop(cycle);
  }
  std::sort(boundary_.loops.begin(), boundary_.loops.end(),
            [](const Loop& a, const Loop& b) { return lexicographically_less(a.pieces[0].start, b.pieces[0].start); });
  for (std::size_t k = 0; k < boundary_.loops.size(); ++k)
    boundary_.loops[k].tag = static_cast<int>(k) + 1;
}

Piece BoundaryMaker::finished(const Kept& kept) const {
  const Arrangement::Piece& source = arrangement_.pieces()[kept.piece];
  const Vec2 from = arrangement_.vertices().point(source.from), to = arrangement_.vertices().point(source.to);
  Piece piece;
  if (source.circle >= 0) {
    piece = make_arc(arrangement_.circles()[source.circle], from, to);
    if (kept.reversed)
      piece = reversed_arc(piece);
  } else {
    piece.start = kept.reversed ? to : from;
    piece.end = kept.reversed ? from : to;
  }
  piece.part = source.part;
  return piece;
}

void BoundaryMaker::add_loop(std::vector<LocalIndex>& cycle) {
  const VertexTable& vertices = arrangement_.vertices();
  const auto smallest = std::min_element(cycle.begin(), cycle.end(), [&](LocalIndex a, LocalIndex b) {
    return lexicographically_less(vertices.point(kept_[a].from), vertices.point(kept_[b].from));
  });
  std::rotate(cycle.begin(), smallest, cycle.end());
  Loop loop;
  loop.pieces.reserve(cycle.size());
  double twice_area = 0;
  for (const LocalIndex k : cycle) {
    loop.pieces.push_back(finished(kept_[k]));
    twice_area += twice_area_under(loop.pieces.back(), loop.pieces.front().start);
  }
  // Slivers of a few lattice steps, where sides of parts were meant to be equal, are no features.
  if (std::fabs(twice_area) <= VertexTable::merge_steps * frame_.step() * loop.length())
    return;
  loop.outer = twice_area > 0;
  boundary_.area += 0.5 * twice_area;
  boundary_.loops.push_back(std::move(loop));
}

} // namespace

Boundary make_boundary(const Region& region, std::span<const Part> parts, const Frame& frame) {
  return BoundaryMaker(region, parts, frame).make();
}

} // namespace trime::geometry
