// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/joining_parts.hpp"

#include "generalise/regions.hpp"
#include "generalise/rules.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace trime::generalise {
namespace {

using HalfEdge = Triangulation::HalfEdge;

/// Sets that are united; the lowest member stands for each set.
class Sets {
public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  LocalIndex root(LocalIndex a) {
    while (parent_[at(a)] != a)
      a = parent_[at(a)] = parent_[at(parent_[at(a)])];
    return a;
  }
  /// Returns true if they were two sets.
  bool unite(LocalIndex a, LocalIndex b) {
    a = root(a);
    b = root(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
    return a != b;
  }

private:
  std::vector<LocalIndex> parent_;
};

/// Parts first, then bodies and regions in the order of their first triangles.
class Judge {
public:
  Judge(const CurveMap& map, const std::vector<char>& labels, std::span<const NarrowPart> parts)
      : map_(map), mesh_(map.mesh()), labels_(labels), parts_(parts), inside_(parts.front().inside) {
    find_pieces();
    find_lids();
  }

  Verdict judge(bool keeps_thin) {
    choose_bodies(keeps_thin);
    join_bodies();
    for (const Piece& piece : pieces_)
      holds_staying_.push_back(piece.is_region && piece.stays);
    take_away();
    Verdict verdict;
    for (std::size_t k = 0; k < parts_.size(); ++k)
      verdict.goes.push_back(pieces_[k].goes);
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
      if (const LocalIndex piece = piece_of_[at(t)]; !is_part(piece) && pieces_[at(piece)].goes)
        verdict.rest.push_back(t);
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
      if (is_loose(piece_of_[at(t)]))
        verdict.loose.push_back(t);
    find_witnesses(verdict.witnesses);
    return verdict;
  }

private:
  struct Piece {
    bool is_region = false;  ///< on the other side
    bool stays = false;      ///< a body above the resolution, or a region with no small perimeter
    bool holds_kept = false; ///< a vertex that the user has asked for
    bool is_needed = false;
    bool goes = false;
    double area = 0;      ///< over h squared
    double perimeter = 0; ///< over h: of its edges between the sides
    double largest = -1;  ///< area of its largest triangle
    LocalIndex witness = Triangulation::none;
    std::vector<LocalIndex> neighbours; ///< of a part its bodies, of a body its parts, each once
  };

  bool is_on_side(LocalIndex t) const { return (labels_[at(t)] != 0) == inside_; }
  bool is_part(LocalIndex piece) const { return at(piece) < parts_.size(); }

  void find_pieces() {
    piece_of_.assign(labels_.size(), Triangulation::none);
    pieces_.resize(parts_.size());
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (const LocalIndex t : parts_[k].triangles)
        add(t, static_cast<LocalIndex>(k));
    std::vector<LocalIndex> open;
    for (LocalIndex first = 0; first < mesh_.triangle_count(); ++first) {
      if (piece_of_[at(first)] != Triangulation::none)
        continue;
      const auto piece = static_cast<LocalIndex>(pieces_.size());
      pieces_.emplace_back().is_region = !is_on_side(first);
      add(first, piece);
      open.push_back(first);
      while (!open.empty()) {
        const LocalIndex t = open.back();
        open.pop_back();
        for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e)
          if (const HalfEdge f = mesh_.twin(e); f != Triangulation::none)
            if (const LocalIndex there = Triangulation::triangle(f);
                piece_of_[at(there)] == Triangulation::none && is_on_side(there) == is_on_side(t)) {
              add(there, piece);
              open.push_back(there);
            }
      }
    }
    region_at_.assign(at(mesh_.vertex_count()), Triangulation::none);
    for (HalfEdge e = 0; e < 3 * mesh_.triangle_count(); ++e)
      if (const LocalIndex piece = piece_of_[at(Triangulation::triangle(e))]; pieces_[at(piece)].is_region)
        region_at_[at(mesh_.origin(e))] = piece;
  }

  /// Returns whether this is a body of a few triangles that would be cut off if all parts went. The largest body of a
  /// component is not.
  bool is_loose(LocalIndex k) const {
    const Piece& piece = pieces_[at(k)];
    return !is_part(k) && !piece.is_region && !piece.neighbours.empty() && !piece.holds_kept &&
           piece.area < GeneraliseRules::least_cut_off && largest_[at(component_[at(k)])] != k;
  }

  /// Adds a triangle to the piece.
  void add(LocalIndex t, LocalIndex index) {
    piece_of_[at(t)] = index;
    Piece& piece = pieces_[at(index)];
    const HalfEdge e = 3 * t;
    const geometry::Vec2 a = mesh_.point(mesh_.origin(e)), b = mesh_.point(mesh_.origin(e + 1)),
                         c = mesh_.point(mesh_.origin(e + 2));
    const double sizes[] = {map_.size(mesh_.origin(e)), map_.size(mesh_.origin(e + 1)), map_.size(mesh_.origin(e + 2))};
    const double h = (sizes[0] + sizes[1] + sizes[2]) / 3;
    const bool is_around = sizes[0] == 0 || sizes[1] == 0 || sizes[2] == 0; // at a corner of the box
    const double area = is_around ? INFINITY : 0.5 * cross(b - a, c - a) / (h * h);
    piece.area += area;
    if (area > piece.largest) {
      piece.largest = area;
      piece.witness = t;
    }
    for (HalfEdge f = e; f < e + 3; ++f)
      piece.holds_kept |= map_.is_kept(mesh_.origin(f));
    for (HalfEdge f = e; f < e + 3; ++f)
      if (mesh_.twin(f) != Triangulation::none && is_on_side(Triangulation::triangle(mesh_.twin(f))) != is_on_side(t)) {
        const LocalIndex from = mesh_.origin(f), to = mesh_.target(f);
        piece.perimeter += 2 * length(mesh_.point(to) - mesh_.point(from)) / (map_.size(from) + map_.size(to));
      }
  }

  void find_lids() {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      std::vector<LocalIndex>& bodies = pieces_[k].neighbours;
      for (const HalfEdge lid : parts_[k].lids)
        bodies.push_back(piece_of_[at(Triangulation::triangle(mesh_.twin(lid)))]);
      std::sort(bodies.begin(), bodies.end());
      bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
      for (const LocalIndex body : bodies)
        pieces_[at(body)].neighbours.push_back(static_cast<LocalIndex>(k));
    }
  }

  /// Chooses the bodies and regions that always stay, and the components that stay as they are.
  void choose_bodies(bool keeps_thin) {
    Sets sets(pieces_.size());
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (const LocalIndex body : pieces_[k].neighbours)
        sets.unite(static_cast<LocalIndex>(k), body);
    component_.resize(pieces_.size());
    std::vector<double> perimeter(pieces_.size());
    largest_.assign(pieces_.size(), Triangulation::none);
    for (LocalIndex k = 0; k < std::ssize(pieces_); ++k) {
      Piece& piece = pieces_[at(k)];
      const LocalIndex root = component_[at(k)] = sets.root(k);
      perimeter[at(root)] += piece.perimeter;
      if (piece.is_region)
        piece.stays = piece.area >= GeneraliseRules::least_body || piece.perimeter >= GeneraliseRules::small_component;
      else if (!is_part(k)) {
        piece.stays = piece.area >= GeneraliseRules::least_body || piece.holds_kept;
        if (LocalIndex& best = largest_[at(root)]; best == Triangulation::none || piece.area > pieces_[at(best)].area)
          best = k;
      }
    }
    is_thin_.resize(pieces_.size());
    for (LocalIndex root = 0; root < std::ssize(pieces_); ++root) {
      const LocalIndex best = largest_[at(root)];
      if (best == Triangulation::none || pieces_[at(best)].stays)
        continue;
      pieces_[at(best)].stays = true;
      is_thin_[at(root)] = inside_ && keeps_thin && perimeter[at(root)] >= GeneraliseRules::small_component;
    }
  }

  /// Finds the widest ways between the bodies that stay, and the bodies on these ways.
  void join_bodies() {
    std::vector<LocalIndex> order(parts_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](LocalIndex a, LocalIndex b) { return parts_[at(a)].width > parts_[at(b)].width; });
    Sets sets(pieces_.size());
    std::vector<std::vector<LocalIndex>> tree(pieces_.size());
    for (const LocalIndex part : order)
      for (const LocalIndex body : pieces_[at(part)].neighbours)
        if (sets.unite(part, body)) {
          tree[at(part)].push_back(body);
          tree[at(body)].push_back(part);
        }
    std::vector<std::size_t> degree;
    std::vector<LocalIndex> ends;
    for (LocalIndex k = 0; k < std::ssize(pieces_); ++k) {
      pieces_[at(k)].is_needed = !pieces_[at(k)].is_region;
      degree.push_back(tree[at(k)].size());
      if (degree.back() <= 1)
        ends.push_back(k);
    }
    while (!ends.empty()) {
      const LocalIndex k = ends.back();
      ends.pop_back();
      Piece& piece = pieces_[at(k)];
      if (!piece.is_needed || piece.stays)
        continue;
      piece.is_needed = false;
      for (const LocalIndex next : tree[at(k)])
        if (pieces_[at(next)].is_needed && --degree[at(next)] <= 1)
          ends.push_back(next);
    }
    for (LocalIndex k = 0; k < std::ssize(pieces_); ++k)
      if (is_thin_[at(component_[at(k)])])
        pieces_[at(k)].is_needed = !is_part(k) || parts_[at(k)].lids.size() > 1;
  }

  /// Takes away what is not needed, the narrowest first, as long as that joins no two regions that stay.
  void take_away() {
    std::vector<LocalIndex> order;
    for (LocalIndex k = 0; k < std::ssize(pieces_); ++k)
      if (const Piece& piece = pieces_[at(k)]; !piece.is_region && !piece.is_needed)
        order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](LocalIndex a, LocalIndex b) {
      if (is_part(a) != is_part(b))
        return is_part(a);
      return is_part(a) ? parts_[at(a)].width < parts_[at(b)].width : pieces_[at(a)].area < pieces_[at(b)].area;
    });
    std::vector<std::vector<LocalIndex>> triangles(pieces_.size()); // of bodies
    for (LocalIndex t = 0; t < mesh_.triangle_count(); ++t)
      if (const LocalIndex k = piece_of_[at(t)]; !is_part(k) && !pieces_[at(k)].is_region && !pieces_[at(k)].is_needed)
        triangles[at(k)].push_back(t);
    Sets sets(pieces_.size());
    for (bool changed = true; changed;) {
      changed = false;
      for (const LocalIndex k : order)
        if (!pieces_[at(k)].goes && try_to_take(k, is_part(k) ? parts_[at(k)].triangles : triangles[at(k)], sets))
          changed = pieces_[at(k)].goes = true;
    }
  }

  /// Takes the piece away if that joins no two regions that stay. Returns whether it did.
  bool try_to_take(LocalIndex k, std::span<const LocalIndex> triangles, Sets& sets) {
    const Piece& piece = pieces_[at(k)];
    if (!is_part(k) && std::none_of(piece.neighbours.begin(), piece.neighbours.end(),
                                    [&](LocalIndex part) { return pieces_[at(part)].goes; }))
      return false;
    std::vector<LocalIndex> touched;
    bool is_beside = false; // more than in a vertex
    for (const LocalIndex t : triangles)
      for (HalfEdge e = 3 * t; e < 3 * t + 3; ++e) {
        if (const LocalIndex region = region_at_[at(mesh_.origin(e))]; region != Triangulation::none)
          touched.push_back(sets.root(region));
        if (mesh_.twin(e) == Triangulation::none)
          continue;
        const LocalIndex there = piece_of_[at(Triangulation::triangle(mesh_.twin(e)))];
        if (there == k || !(pieces_[at(there)].is_region || pieces_[at(there)].goes))
          continue;
        is_beside = true;
        touched.push_back(sets.root(there));
      }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    const auto staying =
        std::count_if(touched.begin(), touched.end(), [&](LocalIndex root) { return holds_staying_[at(root)] != 0; });
    if (!is_beside || staying > 1)
      return false;
    for (const LocalIndex other : touched)
      sets.unite(k, other);
    holds_staying_[at(sets.root(k))] = staying > 0;
    return true;
  }

  void find_witnesses(Witnesses& witnesses) const {
    witnesses.inside = inside_;
    for (LocalIndex k = 0; k < std::ssize(pieces_); ++k) {
      const Piece& piece = pieces_[at(k)];
      if (is_part(k))
        continue;
      if (!piece.stays)
        continue;
      if (piece.is_region) {
        witnesses.regions.push_back(piece.witness);
      } else {
        witnesses.bodies.push_back(piece.witness);
        witnesses.components.push_back(component_[at(k)]);
      }
    }
  }

  const CurveMap& map_;
  const Triangulation& mesh_;
  const std::vector<char>& labels_;
  std::span<const NarrowPart> parts_;
  const bool inside_;
  std::vector<Piece> pieces_;
  std::vector<LocalIndex> piece_of_;  // by triangle
  std::vector<LocalIndex> region_at_; // by vertex: the region next to it
  std::vector<LocalIndex> component_; // by piece
  std::vector<LocalIndex> largest_;   // by piece that stands for a component: its largest body
  std::vector<char> is_thin_;         // by piece that stands for a component: that stays as it is
  std::vector<char> holds_staying_;   // by set: whether it holds a region that stays
};

} // namespace

Verdict judge_parts(const CurveMap& map, const std::vector<char>& labels, std::span<const NarrowPart> parts,
                    bool keeps_thin) {
  return parts.empty() ? Verdict{} : Judge(map, labels, parts).judge(keeps_thin);
}

bool confirms(const CurveMap& map, const std::vector<char>& labels, const Witnesses& witnesses) {
  const Regions now(map, labels);
  std::map<LocalIndex, LocalIndex> region_of_component;
  for (std::size_t k = 0; k < witnesses.bodies.size(); ++k) {
    const LocalIndex t = witnesses.bodies[k];
    if ((labels[at(t)] != 0) != witnesses.inside ||
        region_of_component.try_emplace(witnesses.components[k], now.of(t)).first->second != now.of(t))
      return false;
  }
  std::vector<LocalIndex> regions;
  for (const LocalIndex t : witnesses.regions) {
    if ((labels[at(t)] != 0) == witnesses.inside)
      return false;
    regions.push_back(now.of(t));
  }
  std::sort(regions.begin(), regions.end());
  return std::adjacent_find(regions.begin(), regions.end()) == regions.end();
}

} // namespace trime::generalise
