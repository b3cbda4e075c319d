// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/join_lines.hpp"

#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "geometry/cornered_boundary.hpp"
#include "geometry/piece_parts.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

// [h] An end of an arc on another line moves to a vertex of that line that is so near to it.
constexpr double vertex_reach = 0.25;
// [h] Two ends on another line that are nearer to each other become one. Then both arcs still meet that line at more
// than 20 degrees.
constexpr double one_foot = 1.0;
// [h] A part follows a line if its places do not jump farther along it than this and three times the way between them:
// around a corner they do.
constexpr double longest_jump = 1.0;
// [h] Parts next to other lines become one if the way between them is shorter, and reach to a free end that is nearer.
constexpr double shortest_rest = 1.0;
// [h] An end that is so near to another line lies on it.
constexpr double touch = 1e-9;
constexpr int most_rounds = 20; // an arc can follow another one as soon as that one has its last form
// Places along one arc. An arc that has more stays.
constexpr std::size_t most_places = 10'000'000;

Vec2 nearest_on(const Piece& piece, Vec2 p) {
  if (piece.circular) {
    const Vec2 out = p - piece.center, there = piece.center + (piece.radius / length(out)) * out;
    const bool is_on = piece.distance(there) < 1e-6 * piece.radius;
    return is_on ? there : squared_length(p - piece.start) < squared_length(p - piece.end) ? piece.start : piece.end;
  }
  const Vec2 along = piece.end - piece.start;
  const double share = std::clamp(dot(p - piece.start, along) / squared_length(along), 0.0, 1.0);
  return piece.start + share * along;
}

/// A place along an arc.
struct Sample {
  std::size_t piece; ///< of the arc
  double way;        ///< from the start of the arc
  Vec2 place;
  double h;        ///< there
  double distance; ///< from the nearest line that the arc may follow; infinity if that is far away
  std::size_t at;  ///< the nearest piece of that line, as a number of Lines
  bool is_near() const { return distance < GeneraliseRules::rim_distance * h; }
};

/// Samples next to other lines, one after the other.
struct Run {
  std::size_t first, last;
};

/// A vertex of a line, or a place where it gets one.
struct Foot {
  Vec2 place;
  std::size_t at; ///< the piece on which it lies, as a number of Lines
};

/// Pieces of an arc that an edge may meet.
struct OwnPieces {
  std::size_t arc, first, last;
};

/// The pieces of the boundary, then those of the arcs.
class Lines {
public:
  static constexpr int rim = -1;
  struct Line {
    int arc;            ///< its number, or rim
    std::size_t loop;   ///< of the boundary
    std::size_t number; ///< of the piece in its arc or loop
    const Piece* piece;
  };

  Lines(const geometry::Boundary& boundary, const std::vector<InnerArc>& arcs) {
    geometry::Boundary all = boundary;
    for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop)
      add(rim, loop, boundary.loops[loop].pieces);
    for (std::size_t arc = 0; arc < arcs.size(); ++arc) {
      all.loops.emplace_back().pieces = arcs[arc].pieces;
      add(static_cast<int>(arc), 0, arcs[arc].pieces);
    }
    tree_ = geometry::PieceTree(all);
  }

  const Line& operator[](std::size_t k) const { return lines_[k]; }
  std::vector<std::size_t> within(Vec2 p, double distance) const { return tree_.within(p, distance); }

  /// Does a straight piece meet another piece? @param except a piece that does not count @param own further ones
  bool meets(const Piece& edge, std::size_t except, const OwnPieces& own) const {
    return std::ranges::any_of(within(0.5 * (edge.start + edge.end), 0.5 * edge.length()), [&](std::size_t k) {
      const Line& other = lines_[k];
      const bool is_own = other.arc != rim && static_cast<std::size_t>(other.arc) == own.arc &&
                          other.number >= own.first && other.number <= own.last;
      return k != except && !is_own && meet(edge, *other.piece);
    });
  }

private:
  void add(int arc, std::size_t loop, const std::vector<Piece>& pieces) {
    for (std::size_t k = 0; k < pieces.size(); ++k)
      lines_.push_back({arc, loop, k, &pieces[k]});
  }
  std::vector<Line> lines_;
  geometry::PieceTree tree_;
};

/// One round over all arcs.
class LineJoiner {
public:
  LineJoiner(const Partition& given, const ArcRequest& request)
      : given_(given), request_(request), arcs_(given.curves.arcs), lines_(given.boundary, arcs_),
        is_changed_(arcs_.size(), 0) {
    std::size_t pieces = 0;
    for (const geometry::Loop& loop : given.boundary.loops)
      pieces += loop.pieces.size();
    for (const InnerArc& arc : arcs_) {
      first_of_.push_back(pieces);
      pieces += arc.pieces.size();
      if (!arc.closed)
        for (const Vec2 end : {arc.pieces.front().start, arc.pieces.back().end})
          ++ends_at_[{end.x, end.y}];
    }
  }

  /// Returns whether any arc has lost a part, or a ring begins elsewhere, so that the next round can cut it.
  bool run() {
    std::vector<std::vector<InnerArc>> rest(arcs_.size());
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      rest[k] = treat(k);
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      for (InnerArc& arc : is_changed_[k] != 0 ? rest[k] : divided(k))
        made_.push_back(std::move(arc));
    return joined_.rim.length + joined_.lines.length > 0 || !begins_at_.empty();
  }

  Partition result() const {
    Partition made = given_;
    made.curves.arcs = made_;
    made.joined.add(joined_);
    const geometry::Box box = given_.boundary.bounding_box();
    const geometry::PieceTree tree(given_.boundary);
    geometry::CorneredBoundary cornered(given_.boundary, tree, corner_tolerance * std::fmax(box.width(), box.height()));
    for (const auto& [at, feet] : feet_)
      for (const Vec2 foot : feet)
        if (lines_[at].arc == Lines::rim) {
          cornered.add_corner(foot);
          made.is_relabelled = true;
        }
    if (made.is_relabelled)
      made.boundary = cornered.result();
    return made;
  }

private:
  // [size of the shape] Rounding to the lattice moves a place away from its piece by less.
  static constexpr double corner_tolerance = 1e-10;

  /// Says which parts of an arc belong to other lines, and where the rest of it ends.
  struct Plan {
    std::size_t arc;
    std::vector<Sample> samples;
    std::vector<Run> runs;
    std::vector<std::array<std::optional<Foot>, 2>> feet; ///< of each run, at its beginning and its end
  };

  static bool is_plain(const InnerArc& arc) { return arc.pieces.front().part >= 0 && arc.left == arc.right; }
  geometry::CurveKind kind_of(const InnerArc& arc) const {
    const auto k = static_cast<std::size_t>(arc.pieces.front().part);
    return k < given_.curves.kinds.size() ? given_.curves.kinds[k] : geometry::CurveKind{};
  }
  /// May parts of the arc belong to other lines?
  bool may_join(std::size_t arc) const {
    return is_plain(arcs_[arc]) && !kind_of(arcs_[arc]).split && !kind_of(arcs_[arc]).weir_height;
  }
  /// May the arc follow this piece? The boundary, and those of curves before it that keep their form in this round.
  bool may_follow(std::size_t arc, std::size_t at) const {
    const int other = lines_[at].arc;
    if (other == Lines::rim)
      return true;
    const auto k = static_cast<std::size_t>(other);
    return k < arc && is_changed_[k] == 0 && is_plain(arcs_[k]) && arcs_[k].left == arcs_[arc].left &&
           !kind_of(arcs_[k]).split;
  }

  Sample sample(std::size_t arc, std::size_t piece, double along, double before) const {
    const Vec2 p = arcs_[arc].pieces[piece].point(along);
    Sample made{piece, before + along, p, sizing::checked_size(request_.size, p), INFINITY, 0};
    for (const std::size_t at : lines_.within(p, GeneraliseRules::rim_distance * made.h))
      if (may_follow(arc, at))
        if (const double distance = lines_[at].piece->distance(p); distance < made.distance) {
          made.distance = distance;
          made.at = at;
        }
    return made;
  }

  /// Places along an arc from its start to its end. Between two places that are not near none is near.
  std::vector<Sample> samples(std::size_t arc) const {
    std::vector<Sample> all;
    double before = 0;
    const std::vector<Piece>& pieces = arcs_[arc].pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const double whole = pieces[k].length();
      for (double along = 0; along < whole;) {
        if (all.size() >= most_places)
          return {};
        all.push_back(sample(arc, k, along, before));
        const double h = all.back().h, next = std::fmin(whole, along + GeneraliseRules::whole_part * h);
        const std::vector<std::size_t> near =
            lines_.within(pieces[k].point(0.5 * (along + next)),
                          0.5 * (next - along) + GeneraliseRules::grown_distance * GeneraliseRules::rim_distance * h);
        if (std::ranges::none_of(near, [&](std::size_t at) { return may_follow(arc, at); })) {
          along = next;
          continue;
        }
        for (along += GeneraliseRules::place_step * h; along < next && all.size() < most_places;
             along += GeneraliseRules::place_step * all.back().h)
          all.push_back(sample(arc, k, along, before));
        along = next;
      }
      before += whole;
    }
    all.push_back(sample(arc, pieces.size() - 1, pieces.back().length(), before - pieces.back().length()));
    return all;
  }

  int ends_at(Vec2 p) const {
    const auto found = ends_at_.find({p.x, p.y});
    return found == ends_at_.end() ? 0 : found->second;
  }
  bool is_kept(Vec2 p) const {
    return std::binary_search(request_.kept.begin(), request_.kept.end(), p, geometry::lexicographically_less);
  }
  bool is_free_end(const Sample& end) const {
    return ends_at(end.place) == 1 && !is_kept(end.place) && !(end.distance < touch * end.h);
  }

  /// The parts of an arc next to other lines.
  std::vector<Run> near_runs(std::size_t arc, const std::vector<Sample>& all) const {
    std::vector<Run> runs;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!all[k].is_near())
        continue;
      if (runs.empty() || all[k].way - all[runs.back().last].way > shortest_rest * all[k].h)
        runs.push_back({k, k});
      runs.back().last = k;
    }
    if (arcs_[arc].closed)
      return runs;
    const auto is_junction = [&](const Sample& end) { // from which an edge that is not too short leads to the line
      return end.is_near() && !is_free_end(end) && !is_kept(end.place) &&
             end.distance > GeneraliseRules::snap_distance * end.h;
    };
    if (!runs.empty() && runs.front().first == 0 && is_junction(all.front()))
      ++runs.front().first;
    if (!runs.empty() && runs.back().last + 1 == all.size() && is_junction(all.back()))
      --runs.back().last;
    std::erase_if(runs, [](const Run& run) { return run.first > run.last; });
    if (runs.empty())
      return runs;
    if (const Sample& near = all[runs.front().first]; is_free_end(all.front()) && near.way < shortest_rest * near.h)
      runs.front().first = 0;
    if (const Sample& near = all[runs.back().last];
        is_free_end(all.back()) && all.back().way - near.way < shortest_rest * near.h)
      runs.back().last = all.size() - 1;
    return runs;
  }

  /// Is the run nearer to another line than the triangles can show, and longer than an arc that crosses it? An end just
  /// before another curve stays, and so do two straight lines that meet at a small angle.
  bool is_beside(const Plan& plan, const Run& run) const {
    const std::vector<Sample>& all = plan.samples;
    bool is_tight = false, meets = false, is_end = false;
    for (const auto& [at_end, k] : {std::pair{run.first == 0, run.first}, {run.last + 1 == all.size(), run.last}}) {
      if (!at_end || arcs_[plan.arc].closed)
        continue;
      if (is_free_end(all[k]))
        is_end = true;
      else if (all[k].distance < touch * all[k].h)
        meets = true;
      else
        return false; // other arcs end here, or the user asked for the place
    }
    for (std::size_t k = run.first; k <= run.last; ++k) {
      is_tight = is_tight || all[k].distance < GeneraliseRules::snap_distance * all[k].h;
      is_end = is_end && (!all[k].is_near() || lines_[all[k].at].arc != Lines::rim);
    }
    const double way = all[run.last].way - all[run.first].way;
    const bool is_long = way * GeneraliseRules::narrow_share > GeneraliseRules::rim_distance * all[run.first].h;
    return is_tight && (is_long || (!meets && !is_end)) && !(meets && is_straight(plan, run));
  }

  /// Do the arc and its line not turn along the run?
  bool is_straight(const Plan& plan, const Run& run) const {
    const auto is_parallel = [](const Piece& a, const Piece& b) {
      return !a.circular && !b.circular &&
             std::fabs(cross(a.end - a.start, b.end - b.start)) < 1e-6 * a.length() * b.length();
    };
    const std::vector<Piece>& pieces = arcs_[plan.arc].pieces;
    const Sample& first = plan.samples[run.first];
    for (std::size_t k = run.first; k <= run.last; ++k) {
      const Sample& one = plan.samples[k];
      if (!is_parallel(pieces[first.piece], pieces[one.piece]) ||
          (first.is_near() && one.is_near() && !is_parallel(*lines_[first.at].piece, *lines_[one.at].piece)))
        return false;
    }
    return true;
  }

  /// Do two pieces belong to lines that hang together there: to one loop, to one arc, or to two arcs with a common end?
  bool hang_together(std::size_t a, std::size_t b) const {
    const Lines::Line &one = lines_[a], &other = lines_[b];
    if (one.arc == Lines::rim || other.arc == Lines::rim)
      return one.arc == other.arc && one.loop == other.loop;
    if (one.arc == other.arc)
      return true;
    const InnerArc &first = arcs_[static_cast<std::size_t>(one.arc)],
                   &second = arcs_[static_cast<std::size_t>(other.arc)];
    const Vec2 start = first.pieces.front().start, end = first.pieces.back().end;
    return !first.closed && !second.closed &&
           (start == second.pieces.front().start || start == second.pieces.back().end ||
            end == second.pieces.front().start || end == second.pieces.back().end);
  }

  /// Does the run go along one line without a place that the user asked for?
  bool follows_line(const Plan& plan, const Run& run) const {
    const std::vector<Sample>& all = plan.samples;
    const Sample* last = nullptr; // that is near
    for (std::size_t k = run.first; k <= run.last; ++k) {
      if (!all[k].is_near())
        continue;
      if (last != nullptr &&
          (!hang_together(last->at, all[k].at) || length(nearest_on(*lines_[last->at].piece, last->place) -
                                                         nearest_on(*lines_[all[k].at].piece, all[k].place)) >
                                                      longest_jump * all[k].h + 3 * (all[k].way - last->way)))
        return false;
      last = &all[k];
    }
    const std::vector<Piece>& pieces = arcs_[plan.arc].pieces;
    for (std::size_t k = all[run.first].piece + 1; k <= all[run.last].piece; ++k)
      if (pieces[k].corner || is_kept(pieces[k].start))
        return false;
    return true;
  }

  /// Where an arc that leaves its line at this sample ends on it. @param near the next sample of the run
  Foot foot_of(const Sample& one, const Sample& near) const {
    const Piece& piece = *lines_[near.at].piece;
    const Vec2 there = nearest_on(piece, one.place);
    std::vector<Vec2> known{piece.start, piece.end};
    if (const auto found = feet_.find(near.at); found != feet_.end())
      known.insert(known.end(), found->second.begin(), found->second.end());
    const Vec2 best = *std::ranges::min_element(known, {}, [&](Vec2 p) { return squared_length(p - there); });
    return {length(best - there) < vertex_reach * one.h ? best : request_.lattice.snap(there), near.at};
  }

  /// Finds where the arc ends on other lines before and behind a run. Returns whether the edges there meet nothing.
  bool find_feet(const Plan& plan, const Run& run, std::array<std::optional<Foot>, 2>& feet) const {
    const std::vector<Sample>& all = plan.samples;
    if (run.first > 0)
      feet[0] = foot_of(all[run.first - 1], all[run.first]);
    if (run.last + 1 < all.size())
      feet[1] = foot_of(all[run.last + 1], all[run.last]);
    if (feet[0] && feet[1] && length(feet[1]->place - feet[0]->place) < one_foot * all[run.first].h) {
      const auto nearest =
          std::ranges::min_element(all.begin() + static_cast<std::ptrdiff_t>(run.first),
                                   all.begin() + static_cast<std::ptrdiff_t>(run.last) + 1, {}, &Sample::distance);
      feet[0] = feet[1] = foot_of(*nearest, *nearest);
    }
    return (!feet[0] || is_free(plan, run, 0, *feet[0])) && (!feet[1] || is_free(plan, run, 1, *feet[1]));
  }

  /// May an edge lead from the sample before or behind a run to another line?
  bool is_free(const Plan& plan, const Run& run, int side, const Foot& foot) const {
    const std::vector<Sample>& all = plan.samples;
    const std::vector<Piece>& pieces = arcs_[plan.arc].pieces;
    const OwnPieces own{plan.arc, all[run.first > 0 ? run.first - 1 : 0].piece,
                        all[run.last + 1 < all.size() ? run.last + 1 : run.last].piece};
    const Piece edge = edge_of(plan, all[side == 0 ? run.first - 1 : run.last + 1].place, foot.place);
    const Piece& line = *lines_[foot.at].piece;
    const bool is_inside = foot.place != line.start && foot.place != line.end; // of the piece, to within rounding
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    if (edge.start == edge.end || lines_.meets(edge, is_inside ? foot.at : none, own) ||
        std::ranges::any_of(edges_, [&](const Piece& other) { return meet(edge, other); }))
      return false;
    const auto meets_rest = [&](const Piece& rest) { return rest.start != rest.end && meet(edge, rest); };
    return (run.first == 0 || !meets_rest(edge_of(plan, pieces[own.first].start, all[run.first - 1].place))) &&
           (run.last + 1 == all.size() || !meets_rest(edge_of(plan, all[run.last + 1].place, pieces[own.last].end)));
  }

  /// Lets a ring begin at a vertex away from other lines, if it has one: the next round looks at it again.
  void turn(std::size_t number) {
    const std::vector<Piece>& pieces = arcs_[number].pieces;
    for (std::size_t k = 1; k < pieces.size(); ++k)
      if (!sample(number, k, 0, 0).is_near()) {
        begins_at_[number] = static_cast<std::ptrdiff_t>(k);
        return;
      }
  }

  /// Returns what is left of an arc if it has lost parts.
  std::vector<InnerArc> treat(std::size_t number) {
    if (!may_join(number))
      return {};
    Plan plan{number, samples(number), {}, {}};
    for (const Run& run : near_runs(number, plan.samples)) {
      std::array<std::optional<Foot>, 2> feet;
      if (arcs_[number].closed && (run.first == 0) != (run.last + 1 == plan.samples.size())) {
        turn(number);
        continue;
      }
      if (!is_beside(plan, run) || !follows_line(plan, run) || !find_feet(plan, run, feet))
        continue;
      plan.runs.push_back(run);
      plan.feet.push_back(feet);
      note(plan);
    }
    return plan.runs.empty() ? std::vector<InnerArc>{} : rest_of(plan);
  }

  /// Takes the last run of a plan into account.
  void note(const Plan& plan) {
    const Run& run = plan.runs.back();
    const std::vector<Sample>& all = plan.samples;
    is_changed_[plan.arc] = 1;
    const double length = all[run.last].way - all[run.first].way;
    double farthest = 0;
    const Sample* at = nullptr;
    for (std::size_t k = run.first; k <= run.last; ++k)
      if (all[k].is_near() && (at == nullptr || all[k].distance > farthest)) {
        farthest = all[k].distance;
        at = &all[k];
      }
    joined_.add(lines_[at->at].arc == Lines::rim ? JoinedLines{.rim = {length, farthest, at->place}}
                                                 : JoinedLines{.lines = {length, farthest, at->place}});
    for (const std::size_t side : {0U, 1U})
      if (const std::optional<Foot>& foot = plan.feet.back()[side]) {
        edges_.push_back(edge_of(plan, all[side == 0 ? run.first - 1 : run.last + 1].place, foot->place));
        std::vector<Vec2>& feet = feet_[foot->at];
        if (std::ranges::find(feet, foot->place) == feet.end())
          feet.push_back(foot->place);
      }
  }

  /// Cuts the runs out of the arc.
  std::vector<InnerArc> rest_of(const Plan& plan) const {
    const InnerArc& given = arcs_[plan.arc];
    const std::vector<Sample>& all = plan.samples;
    std::vector<InnerArc> made;
    std::size_t from = 0; // the first sample that is left
    std::optional<Foot> foot;
    const auto add = [&](std::size_t last, const std::optional<Foot>& end) {
      InnerArc& arc = made.emplace_back(given);
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
    if (given.closed && made.size() > 1) { // the ring began between two runs
      std::vector<Piece>& last = made.back().pieces;
      last.insert(last.end(), made.front().pieces.begin(), made.front().pieces.end());
      made.erase(made.begin());
    }
    return made;
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

  /// Divides an arc where others end on it, and lets a ring begin where the next round needs it.
  std::vector<InnerArc> divided(std::size_t number) const {
    const InnerArc& given = arcs_[number];
    std::vector<InnerArc> made(1, given);
    made[0].pieces.clear();
    bool is_divided = false;
    for (std::size_t k = 0; k < given.pieces.size(); ++k)
      is_divided = add_divided(given.pieces[k], first_of_[number] + k, made) || is_divided;
    if (made.back().pieces.empty())
      made.pop_back();
    if (given.closed && is_divided)
      close(made);
    else if (const auto found = begins_at_.find(number); found != begins_at_.end())
      std::rotate(made[0].pieces.begin(), made[0].pieces.begin() + found->second, made[0].pieces.end());
    return made;
  }

  /// Adds a piece to the last arc; a new arc begins at each foot on it. Returns whether there is one.
  bool add_divided(const Piece& given, std::size_t at, std::vector<InnerArc>& made) const {
    const auto found = feet_.find(at);
    if (found == feet_.end()) {
      made.back().pieces.push_back(given);
      return false;
    }
    const auto end_here = [&] {
      if (made.back().pieces.empty())
        return;
      made.push_back(made.back());
      made.back().pieces.clear();
    };
    std::vector<Vec2> feet = found->second;
    std::ranges::sort(feet, {}, [&](Vec2 p) { return way_on(given, p); });
    Piece rest = given;
    for (const Vec2 foot : feet) {
      if (foot != given.start && foot != given.end) {
        made.back().pieces.push_back(geometry::divided(rest, foot)[0]);
        rest = geometry::divided(rest, foot)[1];
        rest.corner = false;
      }
      if (foot != given.end)
        end_here();
    }
    made.back().pieces.push_back(rest);
    if (std::ranges::find(feet, given.end) != feet.end())
      end_here();
    return true;
  }
  static double way_on(const Piece& piece, Vec2 p) {
    const double from_start = squared_length(p - piece.start);
    return piece.circular && std::fabs(piece.sweep) > 3 ? geometry::divided(piece, p)[0].length() : from_start;
  }
  /// Makes open arcs of the parts of a ring. If no arc ends where the ring begins, the last part goes on with the
  /// first.
  void close(std::vector<InnerArc>& parts) const {
    for (InnerArc& part : parts)
      part.closed = false;
    const Vec2 begin = parts.front().pieces.front().start;
    const bool ends_here = std::ranges::any_of(
        feet_, [&](const auto& one) { return std::ranges::find(one.second, begin) != one.second.end(); });
    if (ends_here || parts.size() == 1)
      return;
    std::vector<Piece>& last = parts.back().pieces;
    last.insert(last.end(), parts.front().pieces.begin(), parts.front().pieces.end());
    parts.erase(parts.begin());
  }

  const Partition& given_;
  const ArcRequest& request_;
  const std::vector<InnerArc>& arcs_;
  const Lines lines_;
  std::vector<std::size_t> first_of_;                // by arc: the number of its first piece in lines_
  std::vector<char> is_changed_;                     // by arc
  std::map<std::pair<double, double>, int> ends_at_; // number of open arcs that end at a place
  std::map<std::size_t, std::vector<Vec2>> feet_;    // by piece
  std::map<std::size_t, std::ptrdiff_t> begins_at_;  // by ring: its first piece in the next round
  std::vector<Piece> edges_;                         // that lead to other lines
  std::vector<InnerArc> made_;
  JoinedLines joined_;
};

} // namespace

std::optional<Partition> join_lines(const Partition& given, const ArcRequest& request) {
  std::optional<Partition> made;
  for (int round = 0; round < most_rounds; ++round) {
    const Partition& latest = made ? *made : given;
    LineJoiner joiner(latest, request);
    if (!joiner.run())
      break;
    made = joiner.result();
  }
  const double before = given.joined.rim.length + given.joined.lines.length;
  if (made && !(made->joined.rim.length + made->joined.lines.length > before))
    return std::nullopt; // rings begin elsewhere, and that is all
  return made;
}

} // namespace trime::generalise
