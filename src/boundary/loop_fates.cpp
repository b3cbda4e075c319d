// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/loop_fates.hpp"

#include "boundary/feature_rule.hpp"
#include "boundary/rules.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;
using State = LoopFate::State;

bool same_curve(const Piece& a, const Piece& b) {
  return a.start == b.start && a.end == b.end && a.circular == b.circular &&
         (!a.circular || (a.center == b.center && a.radius == b.radius && a.sweep == b.sweep));
}

/// The given boundary: whose is a place?
class GivenLoops {
public:
  struct Owner {
    std::size_t loop, piece; // piece of that loop, which starts there if it is a vertex
    double distance;
  };
  explicit GivenLoops(const Boundary& boundary) : boundary_(boundary) {
    for (std::size_t k = 0; k < boundary.loops.size(); ++k) {
      first_piece_.push_back(vertices_.size());
      for (std::size_t i = 0; i < boundary.loops[k].pieces.size(); ++i)
        vertices_.push_back({boundary.loops[k].pieces[i].start, k, i});
    }
    std::sort(vertices_.begin(), vertices_.end(),
              [](const Vertex& a, const Vertex& b) { return geometry::lexicographically_less(a.place, b.place); });
  }

  std::optional<Owner> vertex(Vec2 p) const {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), p, [](const Vertex& vertex, Vec2 q) {
      return geometry::lexicographically_less(vertex.place, q);
    });
    if (found == vertices_.end() || found->place != p)
      return std::nullopt;
    return Owner{found->loop, found->piece, 0};
  }
  Owner nearest(Vec2 p) {
    if (!tree_)
      tree_.emplace(boundary_);
    const geometry::PieceTree::Nearest near = tree_->nearest(p);
    const auto after = std::upper_bound(first_piece_.begin(), first_piece_.end(), near.piece);
    return {static_cast<std::size_t>(after - first_piece_.begin()) - 1, near.piece - *(after - 1), near.distance};
  }
  /// The loop that has the same pieces as this one, from any of them on.
  std::optional<std::size_t> same_loop(const Loop& loop) const {
    const std::optional<Owner> start = vertex(loop.pieces.front().start);
    if (!start)
      return std::nullopt;
    const std::vector<Piece>& pieces = boundary_.loops[start->loop].pieces;
    if (pieces.size() != loop.pieces.size())
      return std::nullopt;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (!same_curve(loop.pieces[i], pieces[(start->piece + i) % pieces.size()]))
        return std::nullopt;
    return start->loop;
  }
  bool has_piece(const Piece& piece) const {
    const std::optional<Owner> start = vertex(piece.start);
    return start && same_curve(piece, boundary_.loops[start->loop].pieces[start->piece]);
  }

private:
  struct Vertex {
    Vec2 place;
    std::size_t loop, piece;
  };
  const Boundary& boundary_;
  std::vector<Vertex> vertices_;         // in lexicographic order
  std::vector<std::size_t> first_piece_; // of each loop
  std::optional<geometry::PieceTree> tree_;
};

class FateFinder {
public:
  FateFinder(const Boundary& given, const Boundary& meshed, const sizing::SizeField& size)
      : given_(given), meshed_(meshed), size_(size), loops_(given), fates_(given.loops.size()),
        followers_(given.loops.size()) {
    const geometry::Box box = given.bounding_box();
    on_curve_ = BoundaryRules::on_curve * std::fmax(box.width(), box.height());
  }

  std::vector<LoopFate> find(const geometry::Lattice& lattice) {
    for (std::size_t k = 0; k < fates_.size(); ++k) {
      const Loop& loop = given_.loops[k];
      fates_[k].place = loop.pieces.front().start;
      fates_[k].part = loop.pieces.front().part;
      fates_[k].area = loop.winds() ? 0 : std::fabs(enclosed_area(loop));
      fates_[k].length = loop.length();
    }
    for (std::size_t m = 0; m < meshed_.loops.size(); ++m)
      if (const std::optional<std::size_t> source = loops_.same_loop(meshed_.loops[m])) {
        fates_[*source].remaining_length = fates_[*source].length;
        followers_[*source] = {{m, fates_[*source].length, true, true}};
      } else {
        follow(m);
      }
    for (std::size_t k = 0; k < fates_.size(); ++k)
      judge(k);
    judge_lost_loops(lattice);
    return std::move(fates_);
  }

private:
  /// A meshed loop that follows a given one.
  struct Follower {
    std::size_t loop;
    double length; // of it that does
    bool alone;    // it follows no other
    bool same;     // bit for bit
  };
  /// Lengths of a meshed loop by the given loop that they follow.
  using Sources = std::map<std::size_t, double>;

  void follow(std::size_t m) {
    const std::vector<Piece>& pieces = meshed_.loops[m].pieces;
    std::vector<std::size_t> owners(pieces.size());
    Sources on_curves, near;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Vec2 p = pieces[i].start;
      const std::optional<GivenLoops::Owner> vertex = loops_.vertex(p);
      const GivenLoops::Owner owner = vertex ? *vertex : loops_.nearest(p);
      owners[i] = owner.loop;
      const double length = pieces[i].length();
      near[owner.loop] += length;
      if (owner.distance <= on_curve_)
        on_curves[owner.loop] += length;
    }
    Sources& sources = on_curves.empty() ? near : on_curves;
    const std::size_t main = std::max_element(sources.begin(), sources.end(), [](const auto& a, const auto& b) {
                               return a.second < b.second;
                             })->first;
    for (auto& [source, length] : sources)
      length = 0;
    for (std::size_t& owner : owners)
      owner = sources.contains(owner) ? owner : main;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double half = 0.5 * pieces[i].length();
      sources[owners[i]] += half;
      sources[owners[(i + 1) % pieces.size()]] += half;
      double& largest = fates_[owners[i]].largest_deviation;
      if (!loops_.has_piece(pieces[i])) {
        const Distance far = deviation(pieces[i]);
        largest = std::fmax(largest, far.in_sizes);
        fates_[owners[i]].deviation = std::fmax(fates_[owners[i]].deviation, far.length);
      }
    }
    for (const auto& [source, length] : sources)
      followers_[source].push_back({m, length, sources.size() == 1, false});
  }

  struct Distance {
    double length = 0, in_sizes = 0;
  };
  Distance deviation(const Piece& piece) {
    const double length = piece.length();
    const double h = sizing::checked_size(size_, given_.periods.wrap(piece.point(0.5 * length)));
    const int parts = static_cast<int>(std::clamp(std::ceil(length / (BoundaryRules::deviation_step * h)), 2.0,
                                                  static_cast<double>(BoundaryRules::deviation_places)));
    Distance largest;
    for (int k = 0; k < parts; ++k) {
      const Vec2 p = k == 0 ? piece.start : piece.point(length * k / parts);
      const double distance = loops_.nearest(p).distance;
      largest.length = std::fmax(largest.length, distance);
      largest.in_sizes = std::fmax(largest.in_sizes, distance / sizing::checked_size(size_, given_.periods.wrap(p)));
    }
    return largest;
  }

  void judge(std::size_t k) {
    LoopFate& fate = fates_[k];
    std::vector<Follower>& followers = followers_[k];
    std::stable_sort(followers.begin(), followers.end(),
                     [](const Follower& a, const Follower& b) { return a.length > b.length; });
    double length = 0;
    bool alone = true;
    for (const Follower& follower : followers) {
      fate.tags.push_back(meshed_.loops[follower.loop].tag);
      length += follower.length;
      alone = alone && follower.alone;
    }
    fate.remaining_length = std::fmin(fate.length, length);
    fate.state = followers.size() > 1 ? State::split : State::simplified;
    if (!alone)
      fate.state = State::merged;
    else if (followers.size() == 1 && followers.front().same)
      fate.state = State::kept;
  }

  /// Loops that none follows: is the shape where they were?
  void judge_lost_loops(const geometry::Lattice& lattice) {
    if (std::none_of(followers_.begin(), followers_.end(), [](const auto& one) { return one.empty(); }))
      return;
    const bool by_sides = !given_.periods.any(); // periodic boundaries only lose whole loops
    const geometry::SegmentGrid grid = by_sides ? chords(lattice) : geometry::SegmentGrid();
    for (std::size_t k = 0; k < fates_.size(); ++k) {
      if (!followers_[k].empty())
        continue;
      const bool outer = given_.loops[k].outer, inside = by_sides ? grid.inside(fates_[k].place) : !outer;
      fates_[k].state = !inside ? State::dropped : outer ? State::merged : State::filled;
    }
  }

  /// The meshed curves, arcs by several chords.
  geometry::SegmentGrid chords(const geometry::Lattice& lattice) const {
    std::vector<geometry::Segment> segments;
    for (const Loop& loop : meshed_.loops)
      for (const Piece& piece : loop.pieces) {
        const int parts = piece.circular ? BoundaryRules::deviation_places : 1;
        Vec2 from = piece.start;
        for (int k = 1; k <= parts; ++k) {
          const Vec2 to = k == parts ? piece.end : lattice.snap(piece.point(piece.length() * k / parts));
          if (from != to)
            segments.push_back({from, to});
          from = to;
        }
      }
    return geometry::SegmentGrid(std::move(segments));
  }

  const Boundary &given_, &meshed_;
  const sizing::SizeField& size_;
  GivenLoops loops_;
  double on_curve_;
  std::vector<LoopFate> fates_;
  std::vector<std::vector<Follower>> followers_;
};

} // namespace

const char* to_string(LoopFate::State state) {
  constexpr const char* names[] = {"kept", "simplified", "split", "merged", "dropped", "filled", "left_out"};
  return names[static_cast<std::size_t>(state)];
}

std::vector<LoopFate> find_loop_fates(const Boundary& given, const Boundary& meshed, const sizing::SizeField& size,
                                      const geometry::Lattice& lattice) {
  return given.loops.empty() ? std::vector<LoopFate>{} : FateFinder(given, meshed, size).find(lattice);
}

} // namespace trime::boundary
