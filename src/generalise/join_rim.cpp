// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/join_rim.hpp"

#include "core/angle.hpp"
#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "geometry/cornered_boundary.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

// [h] Distance of places along a curve beside the boundary.
constexpr double step = 0.1;
// [h] An end of a curve on the boundary moves to a vertex of the boundary that is so near to it.
constexpr double vertex_reach = 0.25;
// [h] Two ends on the boundary that are nearer to each other become one. Then both arcs of the curve still meet the
// boundary at more than 20 degrees.
constexpr double one_foot = 1.0;
// [h] A part follows the boundary if its places do not jump farther along the boundary than this and three times the
// way between them: around a corner they do.
constexpr double longest_jump = 1.0;
// [h] Parts beside the boundary become one if the way between them is shorter, and reach to a free end that is nearer.
constexpr double shortest_rest = 1.0;
constexpr int most_rounds = 3; // what is in the way may belong to the boundary after a round
// Places along one curve. A curve that has more stays.
constexpr std::size_t most_places = 10'000'000;

/// A place along an arc.
struct Sample {
  std::size_t piece;
  double along; ///< from the start of the piece
  double way;   ///< from the start of the arc
  Vec2 place;
  double distance;       ///< from the boundary
  double h;              ///< there
  std::size_t rim_piece; ///< the piece of the boundary that is nearest
  bool is_near() const { return distance < GeneraliseRules::rim_distance * h; }
};

/// Samples that lie beside the boundary, one after the other.
struct Run {
  std::size_t first, last;
};

/// A vertex of the boundary, or a place where it gets one.
struct Foot {
  Vec2 place;
  std::size_t rim_piece; ///< on which it lies
};

/// The start of a piece of the boundary.
struct RimPlace {
  std::size_t loop;
  double way; ///< from the start of the loop
};

/// Pieces of an arc that are no obstacle.
struct OwnPieces {
  std::size_t arc, first, last;
};

/// The pieces of the boundary and of all arcs, to find what an edge would meet.
class Lines {
public:
  Lines(const geometry::Boundary& boundary, const std::vector<InnerArc>& arcs) {
    geometry::Boundary all = boundary;
    for (const geometry::Loop& loop : boundary.loops)
      rim_.insert(rim_.end(), loop.pieces.begin(), loop.pieces.end());
    for (std::size_t arc = 0; arc < arcs.size(); ++arc) {
      all.loops.emplace_back().pieces = arcs[arc].pieces;
      for (std::size_t k = 0; k < arcs[arc].pieces.size(); ++k)
        inner_.push_back({arc, k, &arcs[arc].pieces[k]});
    }
    tree_ = geometry::PieceTree(all);
  }

  /// Does a straight piece meet a piece of the boundary, but not `except`, or a piece of an arc that is not `own`?
  bool meets(const Piece& edge, std::size_t except, const OwnPieces& own) const {
    return std::ranges::any_of(tree_.within(0.5 * (edge.start + edge.end), 0.5 * edge.length()), [&](std::size_t k) {
      if (k < rim_.size())
        return k != except && meet(edge, rim_[k]);
      const Inner& other = inner_[k - rim_.size()];
      const bool is_own = other.arc == own.arc && other.number >= own.first && other.number <= own.last;
      return !is_own && meet(edge, *other.piece);
    });
  }
  const std::vector<Piece>& rim() const { return rim_; }

private:
  struct Inner {
    std::size_t arc, number;
    const Piece* piece;
  };
  std::vector<Piece> rim_;
  std::vector<Inner> inner_;
  geometry::PieceTree tree_;
};

/// One round over all arcs.
class RimJoiner {
public:
  RimJoiner(const Partition& given, const ArcRequest& request)
      : given_(given), request_(request), rim_tree_(given.boundary), arcs_(turned_arcs()),
        lines_(given.boundary, arcs_) {
    for (const geometry::Loop& loop : given.boundary.loops) {
      double way = 0;
      for (const Piece& piece : loop.pieces) {
        rim_places_.push_back({loop_lengths_.size(), way});
        way += piece.length();
        ends_at_[{piece.start.x, piece.start.y}] = on_rim;
      }
      loop_lengths_.push_back(way);
    }
    for (const InnerArc& arc : given.curves.arcs)
      if (!arc.closed)
        for (const Vec2 end : {arc.pieces.front().start, arc.pieces.back().end})
          if (int& count = ends_at_[{end.x, end.y}]; count != on_rim)
            ++count;
  }

  /// Returns whether any curve has lost a part.
  bool run() {
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      treat(k);
    return joined_.on_rim > 0;
  }

  Partition result() const {
    Partition made = given_;
    made.curves.arcs = made_;
    made.joined.add(joined_);
    const geometry::Box box = given_.boundary.bounding_box();
    geometry::CorneredBoundary cornered(given_.boundary, rim_tree_,
                                        corner_tolerance * std::fmax(box.width(), box.height()));
    for (const auto& [piece, feet] : feet_)
      for (const Vec2 foot : feet)
        cornered.add_corner(foot);
    made.boundary = cornered.result();
    made.is_relabelled = true;
    return made;
  }

private:
  static constexpr int on_rim = -1;
  // [size of the shape] Rounding to the lattice moves a place away from its piece by less.
  static constexpr double corner_tolerance = 1e-10;

  /// May parts of the arc belong to the boundary?
  bool may_join(const InnerArc& arc) const {
    const int curve = arc.pieces.front().part;
    if (curve < 0 || arc.left != arc.right)
      return false;
    const auto k = static_cast<std::size_t>(curve);
    return k >= given_.curves.kinds.size() || (!given_.curves.kinds[k].split && !given_.curves.kinds[k].weir_height);
  }

  Sample sample(const std::vector<Piece>& pieces, std::size_t piece, double along, double way) const {
    const Vec2 p = pieces[piece].point(along);
    const geometry::PieceTree::Nearest rim = rim_tree_.nearest(p);
    return {piece, along, way, p, rim.distance, sizing::checked_size(request_.size, p), rim.piece};
  }

  std::vector<InnerArc> turned_arcs() const {
    std::vector<InnerArc> arcs = given_.curves.arcs;
    for (InnerArc& arc : arcs) {
      if (!arc.closed || !may_join(arc))
        continue;
      for (std::size_t k = 0; k < arc.pieces.size(); ++k)
        if (!sample(arc.pieces, k, 0, 0).is_near()) {
          std::rotate(arc.pieces.begin(), arc.pieces.begin() + static_cast<std::ptrdiff_t>(k), arc.pieces.end());
          break;
        }
    }
    return arcs;
  }

  /// Places along an arc from its start to its end. No place between them is near to the boundary if both are not,
  /// unless the size grows between them.
  std::vector<Sample> samples(const std::vector<Piece>& pieces) const {
    std::vector<Sample> all;
    std::size_t piece = 0;
    double before = 0, along = 0; // length of the pieces before this one, and the way along it
    while (all.size() < most_places) {
      double length = pieces[piece].length();
      while (along > length && piece + 1 < pieces.size()) {
        along -= length;
        before += length;
        length = pieces[++piece].length();
      }
      along = std::fmin(along, length);
      all.push_back(sample(pieces, piece, along, before + along));
      if (piece + 1 == pieces.size() && along == length)
        return all;
      const Sample& here = all.back();
      along += std::fmax(step * here.h, here.distance - GeneraliseRules::rim_distance * here.h);
    }
    return {};
  }

  /// What an arc keeps, and what its parts beside the boundary become.
  struct Plan {
    std::size_t arc;
    std::vector<Sample> samples;
    std::vector<Run> runs;
    std::vector<std::array<std::optional<Foot>, 2>> feet; ///< of each run, at its beginning and its end
  };

  /// The parts of an arc beside the boundary.
  std::vector<Run> near_runs(const InnerArc& arc, const std::vector<Sample>& all) const {
    std::vector<Run> runs;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!all[k].is_near())
        continue;
      if (runs.empty() || all[k].way - all[runs.back().last].way > shortest_rest * all[k].h)
        runs.push_back({k, k});
      runs.back().last = k;
    }
    const auto is_short_end = [&](Vec2 end, const Sample& near, double way) {
      return ends_at(end) == 1 && !is_kept(end) && way < shortest_rest * near.h;
    };
    if (runs.empty() || arc.closed)
      return runs;
    if (const Sample& near = all[runs.front().first]; is_short_end(all.front().place, near, near.way))
      runs.front().first = 0;
    if (const Sample& near = all[runs.back().last]; is_short_end(all.back().place, near, all.back().way - near.way))
      runs.back().last = all.size() - 1;
    return runs;
  }

  int ends_at(Vec2 p) const {
    const auto found = ends_at_.find({p.x, p.y});
    return found == ends_at_.end() ? 0 : found->second;
  }
  bool is_kept(Vec2 p) const {
    return std::binary_search(request_.kept.begin(), request_.kept.end(), p, geometry::lexicographically_less);
  }

  /// Is the run nearer to the boundary than the triangles can show, and longer than a curve that crosses it?
  bool is_beside(const Plan& plan, const Run& run) const {
    const std::vector<Sample>& all = plan.samples;
    bool is_tight = false, meets_rim = false;
    if (!arcs_[plan.arc].closed)
      for (const auto& [at_end, k] : {std::pair{run.first == 0, run.first}, {run.last + 1 == all.size(), run.last}})
        if (at_end) {
          const int count = ends_at(all[k].place);
          if (count > 1)
            return false; // other curves end here
          meets_rim = meets_rim || count == on_rim;
        }
    for (std::size_t k = run.first; k <= run.last; ++k)
      is_tight = is_tight || all[k].distance < GeneraliseRules::snap_distance * all[k].h;
    const double way = all[run.last].way - all[run.first].way;
    return is_tight &&
           (!meets_rim || way * GeneraliseRules::narrow_share > GeneraliseRules::rim_distance * all[run.first].h);
  }

  /// Does the run go along one loop of the boundary without a place that the user asked for?
  bool follows_rim(const Plan& plan, const Run& run) const {
    const std::vector<Sample>& all = plan.samples;
    for (std::size_t k = run.first; k < run.last; ++k)
      if (rim_way(all[k], all[k + 1]) > longest_jump * all[k].h + 3 * (all[k + 1].way - all[k].way))
        return false;
    const std::vector<Piece>& pieces = arcs_[plan.arc].pieces;
    if ((run.first == 0 && is_kept(pieces.front().start)) || (run.last + 1 == all.size() && is_kept(pieces.back().end)))
      return false;
    for (std::size_t k = all[run.first].piece + 1; k <= all[run.last].piece; ++k)
      if (pieces[k].corner || is_kept(pieces[k].start))
        return false;
    return true;
  }
  /// How far it is along the boundary between the places nearest to two samples; infinity if they lie on two loops.
  double rim_way(const Sample& a, const Sample& b) const {
    const RimPlace &first = rim_places_[a.rim_piece], &second = rim_places_[b.rim_piece];
    if (first.loop != second.loop)
      return INFINITY;
    const double way = std::fabs(first.way + way_along(a) - second.way - way_along(b));
    return std::fmin(way, loop_lengths_[first.loop] - way);
  }
  /// How far along its piece the place of the boundary is that is nearest to the sample.
  double way_along(const Sample& one) const {
    const Piece& piece = lines_.rim()[one.rim_piece];
    const Vec2 there = nearest_on(piece, one.place);
    const auto from = [&](Vec2 end) {
      const Vec2 a = end - piece.center, b = there - piece.center;
      return piece.circular ? piece.radius * std::fabs(angle_of(cross(a, b), dot(a, b))) : length(there - end);
    };
    const bool is_first_half = squared_length(there - piece.start) < squared_length(there - piece.end);
    return is_first_half ? from(piece.start) : piece.length() - from(piece.end);
  }

  static Vec2 nearest_on(const Piece& piece, Vec2 p) {
    if (piece.circular) {
      const Vec2 out = p - piece.center, there = piece.center + (piece.radius / length(out)) * out;
      const bool is_on = piece.distance(there) < 1e-6 * piece.radius;
      return is_on ? there : squared_length(p - piece.start) < squared_length(p - piece.end) ? piece.start : piece.end;
    }
    const Vec2 along = piece.end - piece.start;
    const double share = std::clamp(dot(p - piece.start, along) / squared_length(along), 0.0, 1.0);
    return piece.start + share * along;
  }

  /// Where an arc that leaves the boundary at this sample ends on it.
  Foot foot_of(const Sample& one) const {
    const Piece& piece = lines_.rim()[one.rim_piece];
    const Vec2 there = nearest_on(piece, one.place);
    std::vector<Vec2> known{piece.start, piece.end};
    if (const auto found = feet_.find(one.rim_piece); found != feet_.end())
      known.insert(known.end(), found->second.begin(), found->second.end());
    const Vec2 best = *std::ranges::min_element(known, {}, [&](Vec2 p) { return squared_length(p - there); });
    return {length(best - there) < vertex_reach * one.h ? best : request_.lattice.snap(there), one.rim_piece};
  }

  /// Finds where the arc ends on the boundary before and behind a run. Returns whether the edges there meet nothing.
  bool find_feet(const Plan& plan, const Run& run, std::array<std::optional<Foot>, 2>& feet) const {
    const std::vector<Sample>& all = plan.samples;
    if (run.first > 0)
      feet[0] = foot_of(all[run.first - 1]);
    if (run.last + 1 < all.size())
      feet[1] = foot_of(all[run.last + 1]);
    if (feet[0] && feet[1] && length(feet[1]->place - feet[0]->place) < one_foot * all[run.first].h) {
      const auto nearest =
          std::ranges::min_element(all.begin() + static_cast<std::ptrdiff_t>(run.first),
                                   all.begin() + static_cast<std::ptrdiff_t>(run.last) + 1, {}, &Sample::distance);
      feet[0] = feet[1] = foot_of(*nearest);
    }
    return (!feet[0] || is_free(plan, run, 0, *feet[0])) && (!feet[1] || is_free(plan, run, 1, *feet[1]));
  }

  /// May an edge lead from the sample before or behind a run to the boundary?
  bool is_free(const Plan& plan, const Run& run, int side, const Foot& foot) const {
    const std::vector<Sample>& all = plan.samples;
    const std::vector<Piece>& pieces = arcs_[plan.arc].pieces;
    const OwnPieces own{plan.arc, all[run.first > 0 ? run.first - 1 : 0].piece,
                        all[run.last + 1 < all.size() ? run.last + 1 : run.last].piece};
    const Piece edge = edge_of(plan, all[side == 0 ? run.first - 1 : run.last + 1].place, foot.place);
    const Piece& rim = lines_.rim()[foot.rim_piece];
    const bool is_inside = foot.place != rim.start && foot.place != rim.end; // of the piece, to within rounding
    if (edge.start == edge.end || lines_.meets(edge, is_inside ? foot.rim_piece : lines_.rim().size(), own) ||
        std::ranges::any_of(edges_, [&](const Piece& other) { return meet(edge, other); }))
      return false;
    const auto meets_rest = [&](const Piece& rest) { return rest.start != rest.end && meet(edge, rest); };
    return (run.first == 0 || !meets_rest(edge_of(plan, pieces[own.first].start, all[run.first - 1].place))) &&
           (run.last + 1 == all.size() || !meets_rest(edge_of(plan, all[run.last + 1].place, pieces[own.last].end)));
  }

  /// Puts what is left of an arc, and the arc itself if all of it stays, into the list.
  void treat(std::size_t number) {
    const InnerArc& arc = arcs_[number];
    Plan plan{number, {}, {}, {}};
    if (may_join(arc))
      plan.samples = samples(arc.pieces);
    for (const Run& run : near_runs(arc, plan.samples)) {
      std::array<std::optional<Foot>, 2> feet;
      if (!is_beside(plan, run) || !follows_rim(plan, run) || !find_feet(plan, run, feet))
        continue;
      plan.runs.push_back(run);
      plan.feet.push_back(feet);
      note(plan);
    }
    if (plan.runs.empty())
      made_.push_back(given_.curves.arcs[number]);
    else
      add_rest(plan);
  }

  /// Takes the last run of a plan into account.
  void note(const Plan& plan) {
    const Run& run = plan.runs.back();
    const std::vector<Sample>& all = plan.samples;
    joined_.on_rim += all[run.last].way - all[run.first].way;
    for (std::size_t k = run.first; k <= run.last; ++k)
      if (all[k].distance > joined_.rim_distance) {
        joined_.rim_distance = all[k].distance;
        joined_.rim_place = all[k].place;
      }
    for (const std::size_t side : {0U, 1U})
      if (const std::optional<Foot>& foot = plan.feet.back()[side]) {
        edges_.push_back(edge_of(plan, all[side == 0 ? run.first - 1 : run.last + 1].place, foot->place));
        std::vector<Vec2>& feet = feet_[foot->rim_piece];
        if (std::ranges::find(feet, foot->place) == feet.end())
          feet.push_back(foot->place);
      }
  }

  /// Cuts the runs out of the arc.
  void add_rest(const Plan& plan) {
    const InnerArc& given = arcs_[plan.arc];
    const std::vector<Sample>& all = plan.samples;
    const std::size_t before = made_.size();
    std::size_t from = 0; // the first sample that is left
    std::optional<Foot> foot;
    const auto add = [&](std::size_t last, const std::optional<Foot>& end) {
      InnerArc& arc = made_.emplace_back(given);
      arc.closed = false;
      arc.pieces = part_of(given.pieces, all[from], all[last]);
      if (foot)
        arc.pieces.insert(arc.pieces.begin(), edge_of(plan, foot->place, all[from].place));
      if (end)
        arc.pieces.push_back(edge_of(plan, all[last].place, end->place));
    };
    for (std::size_t k = 0; k < plan.runs.size(); ++k) {
      if (plan.feet[k][0])
        add(plan.runs[k].first - 1, plan.feet[k][0]);
      from = plan.runs[k].last + 1;
      foot = plan.feet[k][1];
    }
    if (from < all.size())
      add(all.size() - 1, std::nullopt);
    if (!given.closed || made_.size() < before + 2)
      return;
    std::vector<Piece>& last = made_.back().pieces; // the ring began between two runs
    last.insert(last.end(), made_[before].pieces.begin(), made_[before].pieces.end());
    made_.erase(made_.begin() + static_cast<std::ptrdiff_t>(before));
  }

  /// A straight piece of an arc; its ends lie on the lattice.
  Piece edge_of(const Plan& plan, Vec2 from, Vec2 to) const {
    Piece edge;
    edge.start = request_.lattice.snap(from);
    edge.end = request_.lattice.snap(to);
    edge.part = arcs_[plan.arc].pieces.front().part;
    edge.region = arcs_[plan.arc].pieces.front().region;
    return edge;
  }

  /// The pieces from one sample to another one.
  std::vector<Piece> part_of(const std::vector<Piece>& pieces, const Sample& from, const Sample& to) const {
    const Vec2 start = request_.lattice.snap(from.place), end = request_.lattice.snap(to.place);
    std::vector<Piece> part;
    for (std::size_t k = from.piece; k <= to.piece && start != end; ++k) {
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

  const Partition& given_;
  const ArcRequest& request_;
  const geometry::PieceTree rim_tree_;
  const std::vector<InnerArc> arcs_; // as given, but each ring begins at a vertex away from the boundary if it has one
  const Lines lines_;
  std::vector<RimPlace> rim_places_; // by piece of the boundary
  std::vector<double> loop_lengths_;
  std::map<std::pair<double, double>, int> ends_at_; // number of open arcs that end at a place, or on_rim
  std::map<std::size_t, std::vector<Vec2>> feet_;    // by piece of the boundary
  std::vector<Piece> edges_;                         // that lead to the boundary
  std::vector<InnerArc> made_;
  JoinedLines joined_;
};

} // namespace

std::optional<Partition> join_rim(const Partition& given, const ArcRequest& request) {
  std::optional<Partition> made;
  for (int round = 0; round < most_rounds; ++round) {
    const Partition& latest = made ? *made : given;
    RimJoiner joiner(latest, request);
    if (!joiner.run())
      break;
    made = joiner.result();
  }
  return made;
}

} // namespace trime::generalise
