// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/loop_metric.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "polygon/polygon.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::boundary {

using geometry::Piece;
using geometry::Vec2;

namespace {

constexpr std::size_t run_length = 64; // pieces that one thread measures in a row

double signed_turn(const Piece& before, const Piece& after) {
  const Vec2 in = before.tangent(before.length()), out = after.tangent(0);
  return angle_of(geometry::cross(in, out), geometry::dot(in, out));
}

[[noreturn]] void fail_for_knots(Vec2 p, double h) {
  throw GeometryError(fmt::format("the element size near {} is {}: the boundary would get more than {} sites; "
                                  "ask for fewer points or a larger edge length",
                                  Place(p, 0), h, BoundaryRules::most_samples / 2));
}

} // namespace

/// Sizes at places along the loop, cheapest in ascending order.
class LoopMetric::Walk {
public:
  Walk(const LoopMetric& metric, std::size_t loop, const BoundarySizes& sizes)
      : metric_(metric), loop_(loop), sizes_(sizes) {}
  SizePair at(LocalIndex piece, double along, double whole) {
    const Vec2 p = metric_.loop_.pieces[static_cast<std::size_t>(piece)].point(along);
    return sizes_.at({loop_, piece, along, whole, metric_.periods_.wrap(p)}, cursor_);
  }
  bool is_uniform() const { return sizes_.is_uniform(); }

private:
  const LoopMetric& metric_;
  std::size_t loop_;
  const BoundarySizes& sizes_;
  SizeSamples::Cursor cursor_;
};

/// Runs of pieces at the same time; each piece is measured from its own start, so that the sums do not depend on the
/// runs.
LoopMetric::LoopMetric(const geometry::Boundary& boundary, std::size_t loop, const BoundarySizes& sizes)
    : loop_(boundary.loops[loop]), periods_(boundary.periods) {
  const std::size_t n = loop_.pieces.size();
  TRIME_ASSERT(n > 0);
  turn_.resize(n);
  std::vector<Run> runs((n - 1) / run_length + 1);
  SizePair at_start;
  thread_loop(std::ssize(runs), 1, [&](std::ptrdiff_t r, int) {
    Run& run = runs[static_cast<std::size_t>(r)];
    const std::size_t first = static_cast<std::size_t>(r) * run_length, last = std::min(n, first + run_length);
    Walk walk(*this, loop, sizes);
    SizePair now = walk.at(static_cast<LocalIndex>(first), 0, loop_.pieces[first].length());
    if (r == 0)
      at_start = now;
    for (std::size_t i = first; i < last; ++i) {
      turn_[i] = signed_turn(loop_.pieces[(i + n - 1) % n], loop_.pieces[i]);
      now = add_piece(static_cast<LocalIndex>(i), now, walk, run.knots);
      run.ends.push_back(run.knots.size());
    }
  });
  join(runs, at_start);
  sort_into_buckets();
}

void LoopMetric::join(const std::vector<Run>& runs, SizePair at_start) {
  std::vector<double> arc_of_piece;
  std::vector<std::size_t> knots_before;
  double t = 0, arc = 0;
  std::size_t count = 1;
  for (const Run& run : runs)
    for (std::size_t k = 0; k < run.ends.size(); ++k) {
      const Knot& end = run.knots[run.ends[k] - 1];
      piece_t_.push_back(t);
      arc_of_piece.push_back(arc);
      knots_before.push_back(count);
      t += end.t;
      arc += end.arc;
      count += run.ends[k] - (k > 0 ? run.ends[k - 1] : 0);
      if (const Vec2 p = loop_.pieces[static_cast<std::size_t>(end.piece)].start; count > BoundaryRules::most_samples)
        fail_for_knots(p, end.sizes.size);
    }
  piece_t_.push_back(t);
  knots_.resize(count);
  knots_.front() = {0, 0, 0, 0, at_start};
  thread_loop(std::ssize(runs), 1, [&](std::ptrdiff_t r, int) {
    const Run& run = runs[static_cast<std::size_t>(r)];
    std::size_t piece = static_cast<std::size_t>(r) * run_length, knot = 0;
    for (std::size_t k = 0; k < run.ends.size(); ++k, ++piece)
      for (Knot* to = &knots_[knots_before[piece]]; knot < run.ends[k]; ++knot, ++to) {
        const Knot& from = run.knots[knot];
        const bool is_end = knot + 1 == run.ends[k]; // where the next piece starts
        *to = {is_end ? piece_t_[piece + 1] : piece_t_[piece] + from.t, arc_of_piece[piece] + from.arc, from.piece,
               from.s, from.sizes};
        if (is_end && piece + 1 < loop_.pieces.size()) {
          to->piece = static_cast<LocalIndex>(piece + 1);
          to->s = 0;
        }
      }
  });
}

/// @brief Steps of half the local size, linear between their ends, Simpson's rule on each; one step does for a uniform
/// size.
/// @param sizes at the start. @return sizes at the end
SizePair LoopMetric::add_piece(LocalIndex i, SizePair sizes, Walk& walk, std::vector<Knot>& knots) const {
  const Piece& piece = loop_.pieces[i];
  const double whole = piece.length();
  if (!(whole > 0))
    throw GeometryError(fmt::format("boundary piece {} at {} has no length: expected pieces of positive length; "
                                    "remove the repeated point",
                                    i, Place(piece.start, 0)));
  double s = 0, t = 0;
  while (s < whole) {
    const double h = sizes.size;
    double step = walk.is_uniform() ? whole : 0.5 * h;
    if (s + 1.25 * step >= whole)
      step = whole - s;
    const double end = step == whole - s ? whole : s + step;
    sizes = walk.at(i, end, whole);
    t += step * (1 / h + 8 / (h + sizes.size) + 1 / sizes.size) / 6;
    knots.push_back({t, end, i, end, sizes});
    if (knots.size() > BoundaryRules::most_samples)
      fail_for_knots(piece.start, h);
    s = end;
  }
  return sizes;
}

/// Equal lengths of t hold about as many knots: a look-up takes few steps, on average.
void LoopMetric::sort_into_buckets() {
  const std::size_t buckets = knots_.size();
  buckets_per_t_ = static_cast<double>(buckets) / knots_.back().t;
  first_in_bucket_.reserve(buckets + 1);
  for (std::size_t k = 0; k < knots_.size(); ++k)
    for (const std::size_t bucket = bucket_of(knots_[k].t); first_in_bucket_.size() <= bucket;)
      first_in_bucket_.push_back(static_cast<LocalIndex>(k));
  first_in_bucket_.resize(buckets + 1, static_cast<LocalIndex>(knots_.size()));
}

/// Never falls as t rises. @pre the loop has knots
std::size_t LoopMetric::bucket_of(double t) const {
  return static_cast<std::size_t>(std::fmin(std::fmax(t * buckets_per_t_, 0), static_cast<double>(knots_.size() - 1)));
}

LocalIndex LoopMetric::knot_before(double t) const {
  const LocalIndex* of_bucket = &first_in_bucket_[bucket_of(t)];
  const auto above = std::upper_bound(knots_.begin() + of_bucket[0], knots_.begin() + of_bucket[1], t,
                                      [](double v, const Knot& k) { return v < k.t; });
  const auto index = std::clamp<std::ptrdiff_t>(above - knots_.begin() - 1, 0, std::ssize(knots_) - 2);
  return static_cast<LocalIndex>(index);
}

LoopPlace LoopMetric::place(double t) const {
  const LocalIndex k = knot_before(t);
  const Knot &low = knots_[k], &high = knots_[k + 1];
  const double share = std::clamp((t - low.t) / (high.t - low.t), 0.0, 1.0);
  return {low.piece, low.s + share * (high.arc - low.arc)};
}

SizePair LoopMetric::sizes(double t) const {
  t -= t >= total() ? total() : t < 0 ? -total() : 0;
  const LocalIndex k = knot_before(t);
  const Knot &low = knots_[k], &high = knots_[k + 1];
  const double share = std::clamp((t - low.t) / (high.t - low.t), 0.0, 1.0);
  return {low.sizes.size + share * (high.sizes.size - low.sizes.size),
          low.sizes.asked + share * (high.sizes.asked - low.sizes.asked)};
}

Vec2 LoopMetric::point(double t) const {
  const double turns = t >= total() ? 1 : t < 0 ? -1 : 0;
  const LoopPlace at = place(t - turns * total());
  return loop_.pieces[at.piece].point(at.along) + turns * loop_.winding;
}

double LoopMetric::arc(double t) const {
  const double turns = t >= total() ? 1 : t < 0 ? -1 : 0;
  t -= turns * total();
  const LocalIndex k = knot_before(t);
  const Knot &low = knots_[k], &high = knots_[k + 1];
  return turns * knots_.back().arc + low.arc + (high.arc - low.arc) * ((t - low.t) / (high.t - low.t));
}

LocalIndex LoopMetric::first_junction_from(double t) const {
  const auto pieces = piece_t_.end() - 1;
  return static_cast<LocalIndex>(std::lower_bound(piece_t_.begin(), pieces, t) - piece_t_.begin());
}

std::optional<double> LoopMetric::first_at_radius(double t0, double t1, Vec2 center, double radius) const {
  const auto reached = [&](double t) { return geometry::squared_length(point(t) - center) >= radius * radius; };
  const bool forward = t1 > t0;
  const double period = t0 >= total() ? total() : t0 < 0 ? -total() : 0;
  const LocalIndex intervals = static_cast<LocalIndex>(knots_.size()) - 1;
  LocalIndex k = knot_before(t0 - period);
  double shift = period, near = t0, far = t0;
  for (LocalIndex visited = 0; visited <= intervals; ++visited) {
    const double end = shift + knots_[forward ? k + 1 : k].t;
    far = forward ? std::fmin(end, t1) : std::fmax(end, t1);
    if (reached(far))
      break;
    if (far == t1)
      return std::nullopt;
    near = far;
    k += forward ? 1 : -1;
    if (k == intervals || k < 0) {
      k = forward ? 0 : intervals - 1;
      shift += forward ? total() : -total();
    }
  }
  if (!reached(far))
    return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    (reached(middle) ? far : near) = middle;
  }
  return far;
}

/// Calls visit(turn) along the way from t0 to t1: junctions strictly between, arcs as four equal turns.
template <class Visit>
void LoopMetric::for_each_turn(double t0, double t1, const Visit& visit) const {
  const LocalIndex n = static_cast<LocalIndex>(loop_.pieces.size());
  double shift = t0 >= total() ? total() : 0;
  Vec2 moved = t0 >= total() ? loop_.winding : Vec2{};
  LocalIndex i = knots_[knot_before(t0 - shift)].piece;
  for (LocalIndex visited = 0; visited <= n && shift + piece_t_[i] < t1; ++visited) {
    const double low = shift + piece_t_[i], high = shift + piece_t_[i + 1];
    const Piece& piece = loop_.pieces[i];
    if (low > t0)
      visit(Turn{low, piece.start + moved, turn_[i], i});
    if (piece.circular) {
      const double from = std::fmax(low, t0), to = std::fmin(high, t1);
      const double amount = 0.25 * piece.sweep * arc_length(from, to) / piece.length();
      for (int quarter = 0; quarter < 4; ++quarter) {
        const double t = from + (to - from) * (0.125 + 0.25 * quarter);
        visit(Turn{t, point(t), amount, -1});
      }
    }
    if (++i == n) {
      i = 0;
      shift += total();
      moved = moved + loop_.winding;
    }
  }
}

LocalIndex LoopMetric::corners_between(double t0, double t1, double turn) const {
  LocalIndex corners = 0;
  for_each_turn(t0, t1, [&](const Turn& one) {
    corners += one.junction >= 0 && (std::fabs(one.amount) > turn || polygon::changes_part(loop_, at(one.junction)));
  });
  return corners;
}

/// -1 if it takes more than one.
LocalIndex LoopMetric::piece_of_way(double t0, double t1) const {
  const double shift = t0 >= total() ? total() : 0;
  const LocalIndex i = knots_[knot_before(t0 - shift)].piece;
  return t0 < shift + piece_t_[i] || t1 > shift + piece_t_[i + 1] ? -1 : i;
}

std::optional<LoopMetric::OnePiece> LoopMetric::on_one_piece(double t0, double t1) const {
  const LocalIndex i = piece_of_way(t0, t1);
  if (i < 0)
    return std::nullopt;
  const Piece& piece = loop_.pieces[i];
  const double length = arc_length(t0, t1);
  return OnePiece{length, piece.circular ? length / piece.radius : 0};
}

PartSummary LoopMetric::summarize(double t0, double t1, Vec2 a, Vec2 b) const {
  PartSummary part;
  const double tolerance = 1e-9 * geometry::squared_length(b - a);
  double unsigned_turn = 0;
  for_each_turn(t0, t1, [&](const Turn& turn) {
    part.leaves_disc |= geometry::dot(a - turn.position, b - turn.position) > tolerance;
    part.turn += turn.amount;
    part.deviation = std::fmax(part.deviation, std::fabs(geometry::cross(b - a, turn.position - a)));
    unsigned_turn += std::fabs(turn.amount);
    if (turn.junction >= 0 && std::fabs(turn.amount) > part.sharpest_turn) {
      part.sharpest_turn = std::fabs(turn.amount);
      part.sharpest = turn.junction;
    }
  });
  if (const double length = geometry::length(b - a); length > 0)
    part.deviation /= length;
  part.half_turn_t = 0.5 * (t0 + t1);
  double before = 0;
  for_each_turn(t0, t1, [&](const Turn& turn) {
    const double after = before + std::fabs(turn.amount);
    if (before < 0.5 * unsigned_turn && after >= 0.5 * unsigned_turn)
      part.half_turn_t = turn.t;
    before = after;
  });
  return part;
}

} // namespace trime::boundary
