// SPDX-License-Identifier: BSD-3-Clause
// From the arrangement of the parts to the boundary of the region: classify the pieces, check, chain into loops.
// In a periodic container the images of all parts are cut at the border of the container, too; opposite points of the
// border are one node, and the chains are unrolled.
#include "shape/make_boundary.hpp"

#include "geometry/piece_parts.hpp"

#include "geometry/box_tree.hpp"
#include "shape/arrangement.hpp"
#include "shape/boundary_area.hpp"
#include "shape/inner_pieces.hpp"
#include "shape/part_images.hpp"
#include "shape/parts_beside.hpp"
#include "shape/region_sides.hpp"
#include "shape/region_state.hpp"
#include "shape/small_faces.hpp"
#include "shape/vertex_table.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace trime::shape {

namespace {

using geometry::Boundary;
using geometry::Box;
using geometry::cross;
using geometry::Frame;
using geometry::length;
using geometry::lexicographically_less;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

/// Cuts a periodic container out of the images of the parts; reaches beyond all parts along the other axis.
Part cutting_part(const Frame& frame) {
  Box box = frame.reach();
  if (frame.periods().x > 0) {
    box.min.x = frame.inner().min.x;
    box.max.x = frame.inner().max.x;
  }
  if (frame.periods().y > 0) {
    box.min.y = frame.inner().min.y;
    box.max.y = frame.inner().max.y;
  }
  return Part::rectangle("the border of the container", box, frame);
}

// [least width] The rest between regions is a gap if it is narrower and has no name.
constexpr double widest_gap = 3.5;

class BoundaryMaker {
public:
  BoundaryMaker(const Region& region, std::span<const Part> parts, const Frame& frame, const InnerParts& inner)
      : region_(region), frame_(frame), given_(parts), inner_(inner), sides_(inner.division, names_of(parts)),
        domain_(domain_part(frame)), cut_(cutting_part(frame)), placed_(place(parts)), arrangement_(placed_, frame),
        inside_(arrangement_, placed_, inner, first_curve(), region.text()) {
    boundary_.part_names = names_of(parts);
    if (region.parts().back() == static_cast<int>(parts.size()))
      boundary_.part_names.emplace_back(domain_name);
    boundary_.periods = frame.periods();
  }

  /// @param owned the parts, to be freed; or null
  geometry::Domain make(std::vector<Part>* owned) {
    classify();
    if (!kept_.empty())
      check_container();
    link();
    note_curves();
    if (owned != nullptr && !frame_.periods().any() && !have_markers(given_)) {
      given_ = {};
      owned->clear(); // placed_ still knows their numbers
    }
    chain();
    if (frame_.periods().any())
      finish_periodic_area();
    if (boundary_.loops.empty() && !boundary_.covers_torus)
      throw GeometryError(
          fmt::format("the geometry '{}' is empty: no point lies in it; check the parts and the order of the operands",
                      region_.text()));
    check_area(boundary_, region_.text(), frame_);
    const double least = least_region_area();
    if (sides_.any())
      sides_.check(least, region_.text());
    std::vector<std::int32_t> markers = name_markers(boundary_, given_, frame_);
    geometry::InnerCurves curves = inside_.curves(on_boundary_, *nodes_, boundary_);
    geometry::Domain domain(frame_, std::move(boundary_), std::move(markers));
    geometry::Regions regions = sides_.regions(curves.arcs, domain.boundary(), least, region_.text());
    regions.absorbed = absorbed_;
    domain.set_regions(std::move(regions));
    domain.set_curves(std::move(curves));
    return domain;
  }

private:
  static constexpr int cut_index = -1;

  /// A piece of the arrangement, directed so that the region lies on its left.
  struct Kept {
    LocalIndex from, to, piece;
    bool reversed;
    int region; ///< of the division
  };

  static std::vector<std::string> names_of(std::span<const Part> parts) {
    std::vector<std::string> names;
    for (const Part& part : parts)
      names.push_back(part.name());
    return names;
  }

  /// The parts that occur, ascending by index, with their images; the cutting part last.
  std::vector<PlacedPart> place(std::span<const Part> parts) {
    std::vector<PlacedPart> placed;
    std::vector<int> used = sides_.parts();
    used.insert(used.end(), region_.parts().begin(), region_.parts().end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const int index : used) {
      const auto count = static_cast<int>(parts.size());
      const Part& part = index < count    ? parts[index]
                         : index == count ? domain_
                                          : inner_.division.parts[static_cast<std::size_t>(index - count - 1)];
      check_frame(part, frame_);
      for (const Vec2 shift : image_shifts(part, frame_))
        placed.push_back({&part, index, shift});
    }
    for (std::size_t k = 0; k < std::min(inner_.curves.size(), inner_.kinds.size()); ++k)
      if (frame_.periods().any() && inner_.kinds[k].split)
        throw GeometryError(fmt::format("curve '{}': curves of a periodic container cannot be split yet; expected "
                                        "split = false, or a container without periods",
                                        inner_.curves[k].name()));
    for (std::size_t k = 0; k < inner_.curves.size(); ++k)
      for (const Vec2 shift : image_shifts(inner_.curves[k], frame_))
        placed.push_back({&inner_.curves[k], first_curve() + static_cast<int>(k), shift});
    if (frame_.periods().any())
      placed.push_back({&cut_, cut_index, {}});
    return placed;
  }
  /// The index of the first curve; parts and the domain have lower ones.
  int first_curve() const { return static_cast<int>(given_.size() + 1 + inner_.division.parts.size()); }
  /// Does the part occur in the expression of the shape, and not only in that of a region?
  bool bounds_shape(int place) const {
    return std::binary_search(region_.parts().begin(), region_.parts().end(),
                              placed_[static_cast<std::size_t>(place)].index);
  }
  bool has_inside() const { return !inner_.curves.empty() || sides_.any(); }
  bool is_curve(int place) const { return placed_[static_cast<std::size_t>(place)].index >= first_curve(); }

  /// The first part of the shape along the piece.
  int index_of(const Arrangement::Piece& piece) const {
    int place = piece.part;
    for (LocalIndex t = piece.first_twin; !bounds_shape(place) && t < piece.first_twin + piece.twin_count; ++t)
      place = arrangement_.twins()[t].part;
    return placed_[static_cast<std::size_t>(place)].index;
  }
  bool holds(RegionState& state, const std::vector<int>& places) const;
  geometry::BoxTree tree_of_places() const;
  /// Where a vertex lies once it is an exact image of its node.
  Vec2 place_of(LocalIndex vertex) const { return nodes_->point(nodes_->node(vertex)) + nodes_->shift(vertex); }
  Vec2 middle(const Arrangement::Piece& piece) const;
  void classify();
  Side side_of(RegionState& state, const std::vector<int>& places) const;
  void set_region(const std::vector<int>& places, const Piece& piece, Side& side);
  Piece piece_of(const Arrangement::Piece& source) const;
  void keep_if_border(LocalIndex k, const Side& left, const Side& right);
  void keep(LocalIndex k, const Side& left, const Side& right);
  void keep_divided(std::vector<std::array<Side, 2>>& sides);
  void note_curves();
  double least_region_area() const;
  void check_container() const;
  void link();
  [[noreturn]] void report_node(LocalIndex node) const;
  void chain();
  Piece finished(const Kept& kept, Vec2 offset) const;
  void add_loop(std::vector<LocalIndex>& cycle);
  void finish_periodic_area();

  const Region& region_;
  const Frame& frame_;
  std::span<const Part> given_;
  const InnerParts& inner_;
  RegionSides sides_;
  const Part domain_, cut_;
  const std::vector<PlacedPart> placed_;
  const Arrangement arrangement_;
  InnerPieces inside_;
  std::vector<Kept> kept_;
  std::optional<Quotient> nodes_;
  std::vector<LocalIndex> next_;                // the kept piece that leaves each node, or -1
  std::vector<char> on_boundary_, meets_curve_; // by node; empty if there are no curves and regions
  std::vector<int> parts_of_side_;              // work space
  geometry::AbsorbedFaces absorbed_;
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

/// Is the region where these placed parts are, and no others? A part is where any of its images is.
/// @param state without parts; it is so after, too
bool BoundaryMaker::holds(RegionState& state, const std::vector<int>& places) const {
  for (const int place : places)
    if (const int index = placed_[static_cast<std::size_t>(place)].index;
        index != cut_index && index <= static_cast<int>(given_.size()))
      state.enter(index);
  const bool held = state.contains();
  for (const int place : places)
    if (const int index = placed_[static_cast<std::size_t>(place)].index;
        index != cut_index && index <= static_cast<int>(given_.size()))
      state.leave(index);
  return held;
}

geometry::BoxTree BoundaryMaker::tree_of_places() const {
  std::vector<Box> boxes;
  for (const PlacedPart& placed : placed_) {
    const Box box = box_of(*placed.part);
    boxes.push_back({box.min + placed.shift, box.max + placed.shift});
  }
  return geometry::BoxTree(boxes);
}

/// Asks only the parts with a box that holds the middle of the piece: it is outside of all others. Pieces come along
/// the curves, so that their middles are near each other.
void BoundaryMaker::classify() {
  const geometry::BoxTree tree = tree_of_places();
  RegionState state(region_, given_.size() + 1);
  PartsBeside beside(placed_.size());
  std::vector<InsideWalk> walks;
  for (const PlacedPart& placed : placed_)
    walks.emplace_back(*placed.part);
  const std::vector<Arrangement::Piece>& pieces = arrangement_.pieces();
  kept_.reserve(pieces.size());
  std::vector<std::array<Side, 2>> sides;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Arrangement::Piece& piece = pieces[k];
    beside.begin();
    beside.set(piece.part, true);
    for (LocalIndex t = piece.first_twin; t < piece.first_twin + piece.twin_count; ++t)
      beside.set(arrangement_.twins()[t].part, arrangement_.twins()[t].along);
    beside.divide();
    const Vec2 p = middle(piece);
    tree.for_each_meeting({p, p}, [&](std::size_t place) {
      if (!beside.has(place) && !is_curve(static_cast<int>(place)) && walks[place].inside(p - placed_[place].shift))
        beside.add_on_both(static_cast<int>(place));
    });
    Side left = side_of(state, beside.left()), right = side_of(state, beside.right());
    if (!sides_.any()) {
      keep(static_cast<LocalIndex>(k), left, right);
      continue;
    }
    const Piece along = piece_of(piece);
    set_region(beside.left(), along, left);
    set_region(beside.right(), reversed(along), right);
    sides.push_back({left, right});
  }
  if (sides_.any())
    keep_divided(sides);
}

void BoundaryMaker::keep(LocalIndex k, const Side& left, const Side& right) {
  keep_if_border(k, left, right);
  if (has_inside())
    inside_.look_at(k, left, right, middle(arrangement_.pieces()[k]));
}

/// Keeps the pieces between regions, once small faces belong to their neighbours.
/// @param sides left and right side of each piece
void BoundaryMaker::keep_divided(std::vector<std::array<Side, 2>>& sides) {
  const Division& division = inner_.division;
  if (division.least_perimeter > 0 || division.least_width > 0) {
    std::vector<LabelledPiece> pieces;
    const auto label = [](const Side& side) { return side.is_region ? side.region : -1; };
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto& [left, right] = sides[k];
      const Arrangement::Piece& piece = arrangement_.pieces()[k];
      const bool on_curve = inside_.is_on_curve(piece) && label(left) >= 0;
      if (label(left) != label(right) || on_curve)
        pieces.push_back(
            {piece.from, piece.to, piece_of(piece), label(left), label(right), static_cast<LocalIndex>(k), on_curve});
    }
    std::vector<char> is_border(sides.size(), 0);
    absorbed_ = absorb_small_faces(pieces, {division.least_perimeter, division.least_width,
                                            (division.rest.empty() ? widest_gap : 1) * division.least_width});
    for (const LabelledPiece& piece : pieces) {
      auto& [left, right] = sides[static_cast<std::size_t>(piece.number)];
      is_border[static_cast<std::size_t>(piece.number)] = 1;
      left.region = std::max(0, piece.left);
      right.region = std::max(0, piece.right);
    }
    for (std::size_t k = 0; k < sides.size(); ++k)
      if (is_border[k] == 0) // the same region on both sides by now
        sides[k][1].region = sides[k][0].region;
  }
  for (std::size_t k = 0; k < sides.size(); ++k)
    keep(static_cast<LocalIndex>(k), sides[k][0], sides[k][1]);
}

/// Sets the region of the left side of a piece, and counts the area under the piece for it, if the side lies in the
/// container.
void BoundaryMaker::set_region(const std::vector<int>& places, const Piece& piece, Side& side) {
  parts_of_side_.clear();
  for (const int place : places)
    if (const int index = placed_[static_cast<std::size_t>(place)].index; !is_curve(place) && index != cut_index)
      parts_of_side_.push_back(index);
  const double twice_area = side.in_container ? twice_area_under({piece}, frame_.inner().min) : 0;
  side.region = sides_.at(parts_of_side_, side.is_region, twice_area, piece.start);
}

/// Notes which nodes lie on the boundary, and where curves meet it.
void BoundaryMaker::note_curves() {
  if (!has_inside())
    return;
  on_boundary_.assign(static_cast<std::size_t>(nodes_->size()), 0);
  meets_curve_ = on_boundary_;
  for (const Kept& kept : kept_)
    on_boundary_[static_cast<std::size_t>(nodes_->node(kept.from))] = 1;
  for (const CurvePiece& piece : inside_.pieces())
    for (const LocalIndex end : {piece.from, piece.to})
      meets_curve_[static_cast<std::size_t>(nodes_->node(end))] = 1;
}

/// An area that is not larger than rounding errors along the boundary and the border of a periodic container.
double BoundaryMaker::least_region_area() const {
  const double least = least_area(boundary_, frame_);
  const Box& box = frame_.inner();
  return frame_.periods().any() ? least + VertexTable::merge_steps * frame_.step() * (box.width() + box.height())
                                : least;
}

Side BoundaryMaker::side_of(RegionState& state, const std::vector<int>& places) const {
  const auto is_cut = [&](int place) { return placed_[static_cast<std::size_t>(place)].index == cut_index; };
  const bool cuts = placed_.back().index == cut_index;
  return {holds(state, places), !cuts || std::any_of(places.begin(), places.end(), is_cut)};
}

/// Keeps pieces with the region on one side only; of a piece on the border of a periodic container and its image on
/// the other side that one whose region lies in the container.
void BoundaryMaker::keep_if_border(LocalIndex k, const Side& left, const Side& right) {
  const Arrangement::Piece& piece = arrangement_.pieces()[k];
  if (left.is_region && !right.is_region && left.in_container)
    kept_.push_back({piece.from, piece.to, k, false, left.region});
  else if (right.is_region && !left.is_region && right.in_container)
    kept_.push_back({piece.to, piece.from, k, true, right.region});
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
    const double excess = std::max(frame_.periods().x > 0 ? 0 : std::max(box.min.x - p.x, p.x - box.max.x),
                                   frame_.periods().y > 0 ? 0 : std::max(box.min.y - p.y, p.y - box.max.y));
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
      "the geometry '{}' {} the container [{}, {}] x [{}, {}]: part '{}' reaches {}, {:.3g} beyond it; "
      "enlarge [domain], move the part, or intersect with 'domain'",
      region_.text(), outside == kept_.size() ? "lies outside" : "lies partly outside", box.min.x, box.max.x, box.min.y,
      box.max.y, boundary_.part_names[index_of(arrangement_.pieces()[farthest->piece])], Place(p), worst));
}

void BoundaryMaker::link() {
  std::vector<LocalIndex> used;
  used.reserve(2 * kept_.size());
  for (const Kept& kept : kept_)
    used.insert(used.end(), {kept.from, kept.to});
  const std::size_t on_boundary = used.size();
  for (const CurvePiece& piece : inside_.pieces())
    used.insert(used.end(), {piece.from, piece.to});
  nodes_.emplace(arrangement_.vertices(), used, frame_);
  used.resize(on_boundary);
  const LocalIndex count = nodes_->size();
  std::vector<LocalIndex> arrivals(count, 0), departures(count, 0);
  next_.assign(count, -1);
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    next_[nodes_->node(kept_[k].from)] = static_cast<LocalIndex>(k);
    ++departures[nodes_->node(kept_[k].from)];
    ++arrivals[nodes_->node(kept_[k].to)];
  }
  for (const LocalIndex vertex : used)
    if (const LocalIndex node = nodes_->node(vertex); arrivals[node] != 1 || departures[node] != 1)
      report_node(node);
}

void BoundaryMaker::report_node(LocalIndex node) const {
  std::set<std::string> names;
  int arrivals = 0, departures = 0;
  for (const Kept& kept : kept_) {
    const bool arrives = nodes_->node(kept.to) == node, departs = nodes_->node(kept.from) == node;
    if (arrives || departs)
      names.insert(boundary_.part_names[index_of(arrangement_.pieces()[kept.piece])]);
    arrivals += arrives ? 1 : 0;
    departures += departs ? 1 : 0;
  }
  std::string list;
  for (const std::string& name : names)
    list += fmt::format("{}'{}'", list.empty() ? "" : ", ", name);
  const Vec2 p = nodes_->point(node);
  if (arrivals == departures)
    throw GeometryError(fmt::format("the boundary of the geometry '{}' touches itself at {} (part {}); "
                                    "expected curves that do not meet: move the parts apart, or make them overlap; or "
                                    "put contours that touch into one file, whose rings may touch in a vertex. No "
                                    "triangles meet across a point, whatever meshing.connect says",
                                    region_.text(), Place(p, 12), list));
  throw GeometryError(
      fmt::format("boundaries of parts of the geometry '{}' nearly coincide at {} (part {}): they are "
                  "nearer than about {:.2g} to each other but not equal; make them equal, or move them apart",
                  region_.text(), Place(p, 12), list, VertexTable::merge_steps * frame_.step()));
}

void BoundaryMaker::chain() {
  std::vector<bool> used(kept_.size(), false);
  std::vector<LocalIndex> cycle;
  for (std::size_t first = 0; first < kept_.size(); ++first) {
    if (used[first])
      continue;
    cycle.clear();
    for (LocalIndex k = static_cast<LocalIndex>(first); !used[k]; k = next_[nodes_->node(kept_[k].to)]) {
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

/// The piece as it lies in the arrangement.
Piece BoundaryMaker::piece_of(const Arrangement::Piece& source) const {
  const Vec2 from = arrangement_.vertices().point(source.from), to = arrangement_.vertices().point(source.to);
  if (source.circle >= 0)
    return make_arc(arrangement_.circles()[source.circle], from, to);
  Piece piece;
  piece.start = from;
  piece.end = to;
  return piece;
}

/// The piece moved by `offset`.
Piece BoundaryMaker::finished(const Kept& kept, Vec2 offset) const {
  const Arrangement::Piece& source = arrangement_.pieces()[kept.piece];
  const Vec2 from = place_of(source.from) + offset, to = place_of(source.to) + offset;
  Piece piece;
  if (source.circle >= 0) {
    Circle circle = arrangement_.circles()[source.circle];
    circle.center = circle.center + offset;
    piece = make_arc(circle, from, to);
    if (kept.reversed)
      piece = reversed(piece);
  } else {
    piece.start = kept.reversed ? to : from;
    piece.end = kept.reversed ? from : to;
  }
  piece.part = index_of(source);
  piece.region = kept.region;
  piece.corner = !meets_curve_.empty() && meets_curve_[static_cast<std::size_t>(nodes_->node(kept.from))] != 0;
  return piece;
}

void BoundaryMaker::add_loop(std::vector<LocalIndex>& cycle) {
  const auto canonical_start = [&](LocalIndex k) {
    return frame_.periods().wrap(nodes_->point(nodes_->node(kept_[k].from)));
  };
  const auto smallest = std::min_element(cycle.begin(), cycle.end(), [&](LocalIndex a, LocalIndex b) {
    return lexicographically_less(canonical_start(a), canonical_start(b));
  });
  std::rotate(cycle.begin(), smallest, cycle.end());
  Loop loop;
  loop.pieces.reserve(cycle.size());
  const Vec2 start = canonical_start(cycle.front());
  Vec2 at = start;
  for (const LocalIndex k : cycle) {
    loop.pieces.push_back(finished(kept_[k], at - place_of(kept_[k].from)));
    at = loop.pieces.back().end;
  }
  loop.winding = at - start;
  double twice_area = twice_area_under(loop.pieces, start);
  if (is_sliver(loop, twice_area, frame_))
    return;
  // Returns what a winding loop lacks to a closed one; the sum over all loops does not depend on the origin.
  if (loop.winds())
    twice_area += 2 * cross(start - frame_.inner().min, loop.winding);
  loop.outer = loop.winds() || twice_area > 0;
  boundary_.area += 0.5 * twice_area;
  boundary_.loops.push_back(std::move(loop));
}

void BoundaryMaker::finish_periodic_area() {
  const double torus = frame_.periods().x * frame_.periods().y;
  if (torus == 0)
    return;
  if (boundary_.loops.empty()) { // all of the torus, or nothing
    const Vec2 p = frame_.lattice().snap(0.5 * (frame_.inner().min + frame_.inner().max));
    std::vector<int> around;
    for (std::size_t place = 0; place < placed_.size(); ++place)
      if (!is_curve(static_cast<int>(place)) && placed_[place].part->inside(p - placed_[place].shift))
        around.push_back(static_cast<int>(place));
    RegionState state(region_, given_.size() + 1);
    boundary_.covers_torus = holds(state, around);
    boundary_.area = boundary_.covers_torus ? torus : 0;
    return;
  }
  settle_area_on_torus(boundary_, torus);
}

} // namespace

geometry::Domain make_boundary(const Region& region, std::span<const Part> parts, const Frame& frame,
                               const InnerParts& inner) {
  return BoundaryMaker(region, parts, frame, inner).make(nullptr);
}

geometry::Domain make_boundary(const Region& region, std::vector<Part>&& parts, const Frame& frame,
                               const InnerParts& inner) {
  return BoundaryMaker(region, parts, frame, inner).make(&parts);
}

} // namespace trime::shape
