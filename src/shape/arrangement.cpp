// SPDX-License-Identifier: BSD-3-Clause
#include "shape/arrangement.hpp"

#include "geometry/box_tree.hpp"
#include "geometry/predicates.hpp"
#include "shape/crossings.hpp"
#include "shape/part_images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace trime::shape {

namespace {

using geometry::Box;
using geometry::BoxTree;
using geometry::Frame;
using geometry::length;
using geometry::orient2d;
using geometry::Piece;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::SegmentTree;
using geometry::squared_length;
using geometry::Vec2;

std::size_t vertex_count(const std::vector<PlacedPart>& parts) {
  std::size_t count = 0;
  for (const PlacedPart& placed : parts)
    count += placed.part->as_polygon() != nullptr ? placed.part->as_polygon()->grid.segments().size() : 4;
  return count;
}

/// Number of lines in the bins of a part that may be examined for each line or circle of another part, and of this
/// part, before the part gets a tree: that costs as much.
constexpr std::int64_t enough_looks = 32;

/// [lattice steps] Around what is looked for: more than vertices are moved by merging, plus what counts as on a curve.
constexpr double safe_steps = 64;

Box inflated(Box box, double margin) {
  return {box.min - Vec2{margin, margin}, box.max + Vec2{margin, margin}};
}

Box box_of(const Segment& s) {
  Box box;
  box.include(s.a);
  box.include(s.b);
  return box;
}

Box box_of(const Circle& circle) {
  const Vec2 radius{circle.radius, circle.radius};
  return {circle.center - radius, circle.center + radius};
}

Box box_of(const PlacedPart& placed) {
  const Box box = box_of(*placed.part);
  return {box.min + placed.shift, box.max + placed.shift};
}

/// The numbers of list[k] for the boxes k that meet `box`, ascending like the list.
std::vector<std::size_t> listed(const BoxTree& tree, const std::vector<std::size_t>& list, const Box& box) {
  std::vector<std::size_t> found = tree.meeting(box);
  for (std::size_t& k : found)
    k = list[k];
  return found;
}

} // namespace

Arrangement::Arrangement(const std::vector<PlacedPart>& parts, const Frame& frame)
    : parts_(parts), frame_(frame), tolerance_(on_curve_steps * frame.step()),
      vertices_(frame.lattice(), vertex_count(parts)), first_line_(parts.size(), 0) {
  lines_.reserve(vertex_count(parts));
  // Contours first: the first vertex at a place keeps its coordinates.
  for (const bool contours : {true, false})
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (const Polygon* polygon = parts[k].part->as_polygon(); polygon && parts[k].part->is_contour() == contours) {
        first_line_[k] = static_cast<LocalIndex>(lines_.size());
        add_polygon(k);
      }
  add_circles();
  cross_all();
  make_pieces();
  join_twins();
  lines_ = {};
  splits_ = {};
  vertices_.forget_search();
}

/// Pairs whose boxes are apart have nothing to do with each other. The others are crossed in the order of the parts,
/// since a crossing may become a vertex that an earlier one has made.
void Arrangement::cross_all() {
  const std::size_t last = parts_.empty() || parts_.back().index >= 0 ? parts_.size() : parts_.size() - 1;
  searches_.resize(parts_.size());
  std::vector<std::size_t> polygons;
  std::vector<Box> polygon_boxes, circle_boxes;
  for (std::size_t k = 0; k < last; ++k)
    if (parts_[k].part->as_polygon() != nullptr) {
      polygons.push_back(k);
      polygon_boxes.push_back(box_of(parts_[k]));
    }
  for (const Circle& circle : circles_)
    circle_boxes.push_back(box_of(circle));
  const BoxTree polygon_tree(polygon_boxes), circle_tree(circle_boxes);
  const double margin = safe_steps * frame_.step();
  const auto cross_with_circles = [&](std::size_t a, const Box& around) {
    for (const std::size_t circle : circle_tree.meeting(around))
      cross_polygon_circle(a, static_cast<LocalIndex>(circle));
  };
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const Box around = inflated(polygon_boxes[k], margin);
    for (const std::size_t b : listed(polygon_tree, polygons, around))
      if (b > polygons[k] || (b == polygons[k] && parts_[b].part->is_curve()))
        cross_polygons(polygons[k], b);
    cross_with_circles(polygons[k], around);
  }
  for (std::size_t a = 0; a < circles_.size(); ++a)
    for (const std::size_t b : circle_tree.meeting(inflated(circle_boxes[a], margin)))
      if (b > a)
        cross_circles(static_cast<LocalIndex>(a), static_cast<LocalIndex>(b));
  if (last < parts_.size()) {
    const Box around = inflated(box_of(parts_[last]), margin);
    for (const std::size_t a : listed(polygon_tree, polygons, around))
      cross_polygons(a, last);
    cross_with_circles(last, around);
  }
  searches_ = {};
}

void Arrangement::cross_circles(LocalIndex a, LocalIndex b) {
  ++pairs_;
  const Crossings crossings = circle_crossings(circles_[a], circles_[b], tolerance_);
  for (int k = 0; k < crossings.count; ++k) {
    const LocalIndex v = vertices_.insert(frame_.snap(crossings.at[k]), VertexTable::nobody);
    split_circle(a, v);
    split_circle(b, v);
  }
}

void Arrangement::add_polygon(std::size_t place) {
  const Polygon& polygon = *parts_[place].part->as_polygon();
  const Vec2 shift = parts_[place].shift;
  const int part = static_cast<int>(place);
  for (const Polygon::Ring& ring : polygon.rings) {
    const std::size_t first = lines_.size();
    for (LocalIndex k = 0; k < ring.count; ++k)
      lines_.push_back({vertices_.insert(polygon.grid.segments()[ring.first + k].a + shift, part), 0, part});
    for (LocalIndex k = 0; k < ring.count; ++k)
      lines_[first + k].to = lines_[first + (k + 1) % ring.count].from;
    if (ring.open)
      lines_.back().to = vertices_.insert(polygon.grid.segments()[ring.first + ring.count - 1].b + shift, part);
    for (std::size_t k = first; k < lines_.size() && parts_[place].part->is_curve(); ++k) { // it may meet itself
      vertices_.set_shared(lines_[k].from);
      vertices_.set_shared(lines_[k].to);
    }
    if (ring.reversed)
      for (LocalIndex k = 0; k < ring.count; ++k)
        std::swap(lines_[first + k].from, lines_[first + k].to);
  }
}

/// Among equal circles the first one is kept.
void Arrangement::add_circles() {
  std::vector<Circle> all;
  std::vector<int> places;
  std::vector<Box> centers;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (const Circle* given = parts_[k].part->as_circle()) {
      all.push_back({given->center + parts_[k].shift, given->radius});
      places.push_back(static_cast<int>(k));
      centers.push_back(inflated({all.back().center, all.back().center}, tolerance_));
    }
  const BoxTree tree(centers);
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> number(all.size(), none); // in circles_, of those that are kept
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::size_t same = none;
    tree.for_each_meeting(centers[k], [&](std::size_t other) {
      if (number[other] < same && length(all[other].center - all[k].center) <= tolerance_ &&
          std::fabs(all[other].radius - all[k].radius) <= tolerance_)
        same = number[other];
    });
    if (same != none) {
      circle_parts_[same].push_back(places[k]);
      continue;
    }
    number[k] = circles_.size();
    circles_.push_back(all[k]);
    circle_parts_.push_back({places[k]});
  }
}

void Arrangement::cross_polygons(std::size_t a, std::size_t b) {
  ++pairs_;
  if (parts_[a].part->as_polygon()->grid.segments().size() > parts_[b].part->as_polygon()->grid.segments().size())
    std::swap(a, b);
  const LocalIndex count = static_cast<LocalIndex>(parts_[a].part->as_polygon()->grid.segments().size());
  const SegmentGrid& other = parts_[b].part->as_polygon()->grid;
  for (LocalIndex s = first_line_[a]; s < first_line_[a] + count; ++s) {
    if (wants_tree(b)) {
      cross_by_tree(s, b);
      continue;
    }
    const Segment moved = moved_back(s, b);
    const std::int64_t before = line_pairs_;
    other.for_each_near(box_for(moved), moved, safe_steps * frame_.step(), [&](LocalIndex t) {
      ++line_pairs_;
      cross_lines(s, first_line_[b] + t);
      return true;
    });
    ++searches_[b].lines;
    searches_[b].looked_at += line_pairs_ - before;
  }
}

/// Where lines of a part may lie that meet this one: vertices have moved by merging.
Box Arrangement::box_for(const Segment& moved) const {
  return inflated(box_of(moved), VertexTable::merge_steps * frame_.step());
}

/// Long slanted lines side by side crowd the bins. True if that was so until now; the part has a tree then.
bool Arrangement::wants_tree(std::size_t b) {
  LineSearch& search = searches_[b];
  if (search.tree)
    return true;
  const std::span<const Segment> segments = parts_[b].part->as_polygon()->grid.segments();
  if (search.looked_at <= enough_looks * (search.lines + std::ssize(segments)))
    return false;
  search.tree.emplace(segments, safe_steps * frame_.step());
  return true;
}

/// Does what the bins would do, in the same order, but only with those lines of b for which it makes a difference: a
/// crossing may become a vertex that an earlier one has made.
void Arrangement::cross_by_tree(LocalIndex s, std::size_t b) {
  const Segment moved = moved_back(s, b);
  std::vector<LocalIndex> met;
  searches_[b].tree->for_each_near(moved, [&](LocalIndex t) {
    ++line_pairs_;
    if (contact_of(s, first_line_[b] + t).any())
      met.push_back(t);
    return true;
  });
  if (met.empty())
    return;
  std::sort(met.begin(), met.end());
  const SegmentGrid& other = parts_[b].part->as_polygon()->grid;
  other.for_each_bin_near(box_for(moved), moved, safe_steps * frame_.step(),
                          [&](std::span<const LocalIndex> bin) { // both are ascending
                            const std::span<const LocalIndex> all(met), few = bin.size() < all.size() ? bin : all,
                                                                        many = bin.size() < all.size() ? all : bin;
                            line_pairs_ += std::ssize(few);
                            for (const LocalIndex t : few)
                              if (std::binary_search(many.begin(), many.end(), t))
                                cross_lines(s, first_line_[b] + t);
                            return true;
                          });
}

Arrangement::Place Arrangement::place_on(LocalIndex line, LocalIndex vertex) const {
  if (vertex == lines_[line].from || vertex == lines_[line].to)
    return Place::at_end;
  const Segment s = segment(line);
  const Vec2 d = s.b - s.a, u = vertices_.point(vertex) - s.a;
  const double along = accurate_dot(u, d), whole = squared_length(d);
  if (along <= 0 || along >= whole || std::fabs(accurate_cross(d, u)) > tolerance_ * std::sqrt(whole))
    return Place::apart;
  return Place::between;
}

Arrangement::Contact Arrangement::contact_of(LocalIndex s, LocalIndex t) const {
  Contact contact;
  const Line a = lines_[s], b = lines_[t];
  if (a.from == a.to || b.from == b.to)
    return contact;
  const Place places[] = {place_on(t, a.from), place_on(t, a.to), place_on(s, b.from), place_on(s, b.to)};
  for (std::size_t k = 0; k < 4; ++k)
    contact.on[k] = places[k] == Place::between;
  if (std::any_of(std::begin(places), std::end(places), [](Place place) { return place != Place::apart; }))
    return contact;
  const Segment p = segment(s), q = segment(t);
  contact.crossing =
      orient2d(p.a, p.b, q.a) * orient2d(p.a, p.b, q.b) < 0 && orient2d(q.a, q.b, p.a) * orient2d(q.a, q.b, p.b) < 0;
  return contact;
}

/// Lines of one curve are crossed once.
void Arrangement::cross_lines(LocalIndex s, LocalIndex t) {
  if (lines_[s].part == lines_[t].part && t <= s)
    return;
  const Contact contact = contact_of(s, t);
  const Line a = lines_[s], b = lines_[t];
  const LocalIndex ends[] = {a.from, a.to, b.from, b.to};
  for (std::size_t k = 0; k < 4; ++k)
    if (contact.on[k])
      split_line(k < 2 ? t : s, ends[k]);
  if (!contact.crossing)
    return;
  const LocalIndex v = vertices_.insert(frame_.snap(line_crossing(segment(s), segment(t))), VertexTable::nobody);
  split_line(s, v);
  split_line(t, v);
}

/// The lines of a polygon that may meet a box, ascending: vertices are numbered in the order of the lines.
std::vector<LocalIndex> Arrangement::lines_near(std::size_t a, Box box) {
  std::vector<LocalIndex> near;
  const auto add = [&](LocalIndex s) {
    near.push_back(first_line_[a] + s);
    return true;
  };
  box = {box.min - parts_[a].shift, box.max - parts_[a].shift};
  if (wants_tree(a)) {
    searches_[a].tree->for_each_in(box, add);
  } else {
    parts_[a].part->as_polygon()->grid.for_each_near(box, add);
    ++searches_[a].lines;
    searches_[a].looked_at += std::ssize(near);
  }
  line_pairs_ += std::ssize(near);
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

void Arrangement::cross_polygon_circle(std::size_t a, LocalIndex circle) {
  ++pairs_;
  const Circle& disc = circles_[circle];
  const double merged = VertexTable::merge_steps * frame_.step(); // how far vertices of the grid's segments have moved
  const auto around = [&](double reach) {
    return Box{disc.center - Vec2{reach, reach}, disc.center + Vec2{reach, reach}};
  };
  const Box reach = around(disc.radius + merged);
  for (const LocalIndex line : lines_near(a, around(disc.radius + 2 * merged))) {
    const Segment s = segment(line);
    if (std::fmax(s.a.x, s.b.x) >= reach.min.x && std::fmin(s.a.x, s.b.x) <= reach.max.x &&
        std::fmax(s.a.y, s.b.y) >= reach.min.y && std::fmin(s.a.y, s.b.y) <= reach.max.y)
      add_contact(line, circle);
  }
}

void Arrangement::add_contact(LocalIndex line, LocalIndex circle) {
  if (lines_[line].from == lines_[line].to)
    return;
  for (const LocalIndex end : {lines_[line].from, lines_[line].to})
    if (std::fabs(signed_distance(vertices_.point(end), circles_[circle])) <= tolerance_)
      split_circle(circle, end);
  const Crossings crossings = segment_circle_crossings(segment(line), circles_[circle], tolerance_);
  for (int k = 0; k < crossings.count; ++k) {
    const LocalIndex v = vertices_.insert(frame_.snap(crossings.at[k]), VertexTable::nobody);
    split_line(line, v);
    split_circle(circle, v);
  }
}

void Arrangement::split_line(LocalIndex line, LocalIndex vertex) {
  vertices_.set_shared(vertex);
  splits_.push_back({line, vertex});
}

void Arrangement::split_circle(LocalIndex circle, LocalIndex vertex) {
  vertices_.set_shared(vertex);
  splits_.push_back({static_cast<LocalIndex>(lines_.size()) + circle, vertex});
}

} // namespace trime::shape
