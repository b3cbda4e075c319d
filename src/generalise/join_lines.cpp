// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/join_lines.hpp"

#include "generalise/arc_cuts.hpp"
#include "generalise/curve_places.hpp"
#include "generalise/divided_lines.hpp"
#include "generalise/line_pieces.hpp"
#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "geometry/cornered_boundary.hpp"
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
// [h] Parts next to other lines become one if the way between them is shorter, and reach to a free end that is nearer.
constexpr double shortest_rest = 1.0;
// [h] An end that is so near to another line lies on it.
constexpr double touch = 1e-9;
constexpr int most_rounds = 20; // an arc can follow another one as soon as that one has its last form

/// One round over all arcs.
class LineJoiner {
public:
  LineJoiner(const Partition& given, const ArcRequest& request)
      : given_(given), request_(request), arcs_(given.curves.arcs), lines_(given.boundary, arcs_),
        divided_(lines_, arcs_), is_changed_(arcs_.size(), 0) {
    for (const InnerArc& arc : arcs_)
      if (!arc.closed)
        for (const Vec2 end : {arc.pieces.front().start, arc.pieces.back().end})
          ++ends_at_[{end.x, end.y}];
  }

  /// Returns whether any arc has lost a part, or a ring begins elsewhere, so that the next round can cut it.
  bool run() {
    std::vector<std::vector<InnerArc>> rest(arcs_.size());
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      rest[k] = treat(k);
    for (std::size_t k = 0; k < arcs_.size(); ++k)
      for (InnerArc& arc : is_changed_[k] != 0 ? rest[k] : divided_.parts_of(k))
        made_.push_back(std::move(arc));
    return joined_.length() > 0 || divided_.has_turned_rings();
  }

  Partition result() const {
    Partition made = given_;
    made.curves.arcs = made_;
    made.joined.add(joined_);
    const geometry::Box box = given_.boundary.bounding_box();
    const geometry::PieceTree tree(given_.boundary);
    geometry::CorneredBoundary cornered(given_.boundary, tree, corner_tolerance * std::fmax(box.width(), box.height()));
    for (const auto& [at, feet] : divided_.feet())
      for (const Vec2 foot : feet)
        if (lines_[at].arc == LinePieces::rim) {
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

  static bool is_interface(const InnerArc& arc) { return arc.left != arc.right; }
  static bool is_plain(const InnerArc& arc) { return arc.pieces.front().part >= 0 && !is_interface(arc); }
  geometry::CurveKind kind_of(const InnerArc& arc) const {
    const auto k = static_cast<std::size_t>(arc.pieces.front().part);
    return k < given_.curves.kinds.size() ? given_.curves.kinds[k] : geometry::CurveKind{};
  }
  /// May parts of the arc belong to other lines?
  bool may_join(std::size_t arc) const {
    return is_plain(arcs_[arc]) && !kind_of(arcs_[arc]).split && !kind_of(arcs_[arc]).weir_height;
  }
  /// May the arc follow this piece? The boundary, interfaces, and those of curves before it that keep their form in
  /// this round.
  bool may_follow(std::size_t arc, std::size_t at) const {
    const int other = lines_[at].arc;
    if (other == LinePieces::rim)
      return true;
    const auto k = static_cast<std::size_t>(other);
    const InnerArc& line = arcs_[k];
    if (line.pieces.front().part >= 0 && kind_of(line).split)
      return false;
    const int region = arcs_[arc].left; // on both sides
    return is_interface(line) ? line.left == region || line.right == region
                              : k < arc && is_changed_[k] == 0 && is_plain(line) && line.left == region;
  }

  Sample sample(std::size_t arc, std::size_t piece, double along, double before) const {
    const Vec2 p = arcs_[arc].pieces[piece].point(along);
    Sample made{piece, before + along, p, sizing::checked_size(request_.size, p)};
    for (const std::size_t at : lines_.within(p, GeneraliseRules::rim_distance * made.h))
      if (may_follow(arc, at))
        if (const double distance = lines_[at].piece->distance(p); distance < made.distance) {
          made.distance = distance;
          made.at = at;
        }
    return made;
  }

  /// Places along an arc from its start to its end. Between two places that are not near none is near. An arc that has
  /// too many of them follows nothing.
  std::vector<Sample> samples(std::size_t arc) const {
    std::vector<Sample> all;
    const std::vector<Piece>& pieces = arcs_[arc].pieces;
    const auto before = [&](std::size_t k) { return lines_[lines_.first_of(arc) + k].way; };
    const auto is_near = [&](Vec2 p, double reach, double h) {
      const double farthest = GeneraliseRules::grown_distance * GeneraliseRules::rim_distance * h;
      return std::ranges::any_of(lines_.within(p, reach + farthest),
                                 [&](std::size_t at) { return may_follow(arc, at); });
    };
    const auto visit = [&](std::size_t k, double along) {
      all.push_back(sample(arc, k, along, before(k)));
      return all.back().h;
    };
    if (!visit_places(pieces, is_near, visit))
      return {};
    all.push_back(sample(arc, pieces.size() - 1, pieces.back().length(), before(pieces.size() - 1)));
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
  std::vector<SampleRun> near_runs(std::size_t arc, const std::vector<Sample>& all) const {
    std::vector<SampleRun> runs;
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
    std::erase_if(runs, [](const SampleRun& run) { return run.first > run.last; });
    if (runs.empty())
      return runs;
    if (const Sample& near = all[runs.front().first]; is_free_end(all.front()) && near.way < shortest_rest * near.h)
      runs.front().first = 0;
    if (const Sample& near = all[runs.back().last];
        is_free_end(all.back()) && all.back().way - near.way < shortest_rest * near.h)
      runs.back().last = all.size() - 1;
    return runs;
  }

  /// Is this a straight piece of an arc inside? snap() moves it to an end just before it.
  bool is_straight_inner_piece(std::size_t at) const {
    return lines_[at].arc != LinePieces::rim && !lines_[at].piece->circular;
  }

  /// Is the run all of an arc, with both ends on an arc of a circle? Straight lines that are so near become one later.
  bool is_lens(const ArcCuts& cuts, const SampleRun& run) const {
    return !cuts.given->closed && cuts.is_end(run, 0) && cuts.is_end(run, 1) &&
           std::ranges::all_of(cuts.samples,
                               [&](const Sample& one) {
                                 return one.distance < GeneraliseRules::snap_distance * one.h &&
                                        lines_[one.at].piece->circular && lines_[one.at].arc != LinePieces::rim;
                               }) &&
           !is_free_end(cuts.samples.front()) && !is_free_end(cuts.samples.back());
  }

  /// Is the run nearer to another line than the triangles can show, and longer than an arc that crosses it? An end just
  /// before another straight arc stays, and so do two straight lines that meet at a small angle.
  bool is_beside(const ArcCuts& cuts, const SampleRun& run) const {
    const std::vector<Sample>& all = cuts.samples;
    bool is_tight = false, meets = false, is_end = false;
    for (const auto& [side, k] : {std::pair{0U, run.first}, {1U, run.last}}) {
      if (!cuts.is_end(run, side) || cuts.given->closed)
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
      is_end = is_end && (!all[k].is_near() || is_straight_inner_piece(all[k].at));
    }
    const double way = all[run.last].way - all[run.first].way;
    const bool is_long = way * GeneraliseRules::narrow_share > GeneraliseRules::rim_distance * all[run.first].h;
    return is_tight && (is_long || (!meets && !is_end) || is_lens(cuts, run)) && !(meets && is_straight(cuts, run));
  }

  /// Do the arc and its line not turn along the run?
  bool is_straight(const ArcCuts& cuts, const SampleRun& run) const {
    const auto is_parallel = [](const Piece& a, const Piece& b) {
      return !a.circular && !b.circular &&
             std::fabs(cross(a.end - a.start, b.end - b.start)) < 1e-6 * a.length() * b.length();
    };
    const std::vector<Piece>& pieces = cuts.given->pieces;
    const Sample& first = cuts.samples[run.first];
    for (std::size_t k = run.first; k <= run.last; ++k) {
      const Sample& one = cuts.samples[k];
      if (!is_parallel(pieces[first.piece], pieces[one.piece]) ||
          (first.is_near() && one.is_near() && !is_parallel(*lines_[first.at].piece, *lines_[one.at].piece)))
        return false;
    }
    return true;
  }

  /// Do two pieces belong to lines that hang together there: to one loop, to one arc, or to two arcs with a common end?
  bool hang_together(std::size_t a, std::size_t b) const {
    const LinePieces::Line &one = lines_[a], &other = lines_[b];
    if (one.arc == LinePieces::rim || other.arc == LinePieces::rim)
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
  bool follows_line(const ArcCuts& cuts, const SampleRun& run) const {
    const std::vector<Sample>& all = cuts.samples;
    const Sample* last = nullptr; // that is near
    for (std::size_t k = run.first; k <= run.last; ++k) {
      if (!all[k].is_near())
        continue;
      if (last != nullptr &&
          (!hang_together(last->at, all[k].at) ||
           length(nearest_on(*lines_[last->at].piece, last->place) -
                  nearest_on(*lines_[all[k].at].piece, all[k].place)) > longest_way_beside(*last, all[k])))
        return false;
      last = &all[k];
    }
    const std::vector<Piece>& pieces = cuts.given->pieces;
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
    if (const std::vector<Vec2>* feet = divided_.feet_on(near.at))
      known.insert(known.end(), feet->begin(), feet->end());
    const Vec2 best = *std::ranges::min_element(known, {}, [&](Vec2 p) { return squared_length(p - there); });
    return {length(best - there) < vertex_reach * one.h ? best : request_.lattice.snap(there), near.at};
  }

  /// Does the run end inside an interface, which gets the name of the curve up to there?
  bool ends_at_interface(const ArcCuts& cuts, const Sample& end) const {
    return !cuts.given->closed && end.is_near() && !(end.distance < touch * end.h) &&
           lines_[end.at].arc != LinePieces::rim && is_interface(arcs_[static_cast<std::size_t>(lines_[end.at].arc)]);
  }

  /// Finds where the arc ends on other lines before and behind a run. Returns whether the edges there meet nothing.
  bool find_feet(const ArcCuts& cuts, const SampleRun& run, Feet& feet) const {
    const std::vector<Sample>& all = cuts.samples;
    for (const auto& [side, k] : {std::pair{0U, run.first}, {1U, run.last}})
      if (!cuts.is_end(run, side))
        feet[side] = foot_of(cuts.beyond(run, side), all[k]);
      else if (ends_at_interface(cuts, all[k]))
        feet[side] = lines_[all[k].at].piece->circular ? foot_of(all[k], all[k]) : Foot{all[k].place, all[k].at};
    const bool is_inside = !cuts.is_end(run, 0) && !cuts.is_end(run, 1); // of the arc: otherwise it names a part
    if (is_inside && length(feet[1]->place - feet[0]->place) < one_foot * all[run.first].h) {
      const auto nearest =
          std::ranges::min_element(all.begin() + static_cast<std::ptrdiff_t>(run.first),
                                   all.begin() + static_cast<std::ptrdiff_t>(run.last) + 1, {}, &Sample::distance);
      feet[0] = feet[1] = foot_of(*nearest, *nearest);
    }
    const auto is_possible = [&](std::size_t side) {
      if (!cuts.is_end(run, side))
        return is_free(cuts, run, side, *feet[side]);
      return !feet[side] || lines_[feet[side]->at].piece->circular || may_bend(cuts, run, *feet[side]);
    };
    return is_possible(0) && is_possible(1) && may_lie_between(cuts, run, feet);
  }

  /// If one piece leads through both ends of a run: may it lead from one to the other?
  bool may_lie_between(const ArcCuts& cuts, const SampleRun& run, const Feet& feet) const {
    return !cuts.is_end(run, 0) || !cuts.is_end(run, 1) || !feet[0] || !feet[1] || feet[0]->at != feet[1]->at ||
           lines_[feet[0]->at].piece->circular || !is_blocked(cuts, run, feet[0]->at, {feet[0]->place, feet[1]->place});
  }

  static OwnPieces pieces_along(const ArcCuts& cuts, const SampleRun& run) {
    return {cuts.arc, cuts.samples[run.first].piece, cuts.samples[run.last].piece};
  }

  /// Does a straight edge meet anything but a piece and the run itself?
  bool is_blocked(const ArcCuts& cuts, const SampleRun& run, std::size_t except, const geometry::Segment& way) const {
    const Piece edge = cuts.edge(way.a, way.b, request_.lattice);
    return lines_.meets(edge, except, pieces_along(cuts, run)) ||
           std::ranges::any_of(edges_, [&](const Piece& other) { return meet(edge, other); });
  }

  /// May a straight piece of an interface lead through the free end of a run? The triangle over which it moves must not
  /// touch any other line.
  bool may_bend(const ArcCuts& cuts, const SampleRun& run, const Foot& foot) const {
    const Piece& line = *lines_[foot.at].piece;
    if (foot.place == line.start || foot.place == line.end)
      return true;
    if (divided_.is_bent(foot.at) || is_blocked(cuts, run, foot.at, {line.start, foot.place}) ||
        is_blocked(cuts, run, foot.at, {foot.place, line.end}))
      return false;
    const double side = cross(line.end - line.start, foot.place - line.start) < 0 ? -1 : 1;
    const auto is_in_triangle = [&](Vec2 p) {
      const auto is_left = [&](Vec2 a, Vec2 b) { return side * cross(b - a, p - a) > 0; };
      return is_left(line.start, line.end) && is_left(line.end, foot.place) && is_left(foot.place, line.start);
    };
    const OwnPieces own = pieces_along(cuts, run);
    return std::ranges::none_of(lines_.within(0.5 * (line.start + line.end), 0.5 * line.length()), [&](std::size_t k) {
      return k != foot.at && !lines_.is_own(k, own) && is_in_triangle(lines_[k].piece->start);
    });
  }

  /// May an edge lead from the sample before or behind a run to another line?
  bool is_free(const ArcCuts& cuts, const SampleRun& run, std::size_t side, const Foot& foot) const {
    const std::vector<Piece>& pieces = cuts.given->pieces;
    const bool is_first = cuts.is_end(run, 0), is_last = cuts.is_end(run, 1);
    const OwnPieces own{cuts.arc, is_first ? 0 : cuts.beyond(run, 0).piece,
                        is_last ? cuts.samples.back().piece : cuts.beyond(run, 1).piece};
    const auto edge_of = [&](Vec2 from, Vec2 to) { return cuts.edge(from, to, request_.lattice); };
    const Piece edge = edge_of(cuts.beyond(run, side).place, foot.place);
    const Piece& line = *lines_[foot.at].piece;
    const bool is_inside = foot.place != line.start && foot.place != line.end; // of the piece, to within rounding
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    if (edge.start == edge.end || lines_.meets(edge, is_inside ? foot.at : none, own) ||
        std::ranges::any_of(edges_, [&](const Piece& other) { return meet(edge, other); }))
      return false;
    const auto meets_rest = [&](const Piece& rest) { return rest.start != rest.end && meet(edge, rest); };
    return (is_first || !meets_rest(edge_of(pieces[own.first].start, cuts.beyond(run, 0).place))) &&
           (is_last || !meets_rest(edge_of(cuts.beyond(run, 1).place, pieces[own.last].end)));
  }

  /// Lets a ring begin at a vertex away from other lines, if it has one: the next round looks at it again.
  void turn(std::size_t number) {
    const std::vector<Piece>& pieces = arcs_[number].pieces;
    for (std::size_t k = 1; k < pieces.size(); ++k)
      if (!sample(number, k, 0, 0).is_near()) {
        divided_.begin_at(number, k);
        return;
      }
  }

  /// Returns what is left of an arc if it has lost parts.
  std::vector<InnerArc> treat(std::size_t number) {
    if (!may_join(number))
      return {};
    ArcCuts cuts{number, &arcs_[number], samples(number)};
    for (const SampleRun& run : near_runs(number, cuts.samples)) {
      Feet feet;
      if (arcs_[number].closed && cuts.is_end(run, 0) != cuts.is_end(run, 1)) {
        turn(number);
        continue;
      }
      if (!is_beside(cuts, run) || !follows_line(cuts, run) || !find_feet(cuts, run, feet))
        continue;
      cuts.runs.push_back(run);
      cuts.feet.push_back(feet);
      note(cuts);
    }
    return cuts.runs.empty() ? std::vector<InnerArc>{} : cuts.rest(request_.lattice);
  }

  /// Takes the last run into account.
  void note(const ArcCuts& cuts) {
    const SampleRun& run = cuts.runs.back();
    const std::vector<Sample>& all = cuts.samples;
    is_changed_[cuts.arc] = 1;
    const double length = all[run.last].way - all[run.first].way;
    double farthest = 0;
    const Sample* at = nullptr;
    for (std::size_t k = run.first; k <= run.last; ++k)
      if (all[k].is_near() && (at == nullptr || all[k].distance > farthest)) {
        farthest = all[k].distance;
        at = &all[k];
      }
    parts_of_kind(lines_[at->at].arc).add({length, farthest, at->place});
    for (const std::size_t side : {0U, 1U})
      if (const std::optional<Foot>& foot = cuts.feet.back()[side]) {
        if (cuts.is_end(run, side) && !lines_[foot->at].piece->circular)
          divided_.bend(*foot);
        else
          divided_.add(*foot);
        if (!cuts.is_end(run, side))
          edges_.push_back(cuts.edge(cuts.beyond(run, side).place, foot->place, request_.lattice));
      }
    divided_.follow(cuts, run, cuts.given->pieces.front().part);
  }

  JoinedParts& parts_of_kind(int line) {
    if (line == LinePieces::rim)
      return joined_.rim;
    return is_interface(arcs_[static_cast<std::size_t>(line)]) ? joined_.interfaces : joined_.lines;
  }

  const Partition& given_;
  const ArcRequest& request_;
  const std::vector<InnerArc>& arcs_;
  const LinePieces lines_;
  DividedLines divided_;
  std::vector<char> is_changed_;                     // by arc
  std::map<std::pair<double, double>, int> ends_at_; // number of open arcs that end at a place
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
  if (made && !(made->joined.length() > given.joined.length()))
    return std::nullopt; // rings begin elsewhere, and that is all
  return made;
}

} // namespace trime::generalise
