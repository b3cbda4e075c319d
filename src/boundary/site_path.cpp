// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/site_path.hpp"

#include "boundary/rules.hpp"
#include "core/angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trime::boundary {

using geometry::Vec2;

namespace {

// [h] A path takes no shorter chord, unless its ends are neighbours. The same as place_spacing.
constexpr double shortest_chord = 0.25;

// [places] Number of places after its start where the end of a chord is searched, which bounds the time.
constexpr std::size_t farthest_place = 64;

// [h] One chord stands for no longer way along the curve.
constexpr double farthest_way = 6;

// [h] Behind a place that is farther from the start of a chord no end of it is looked for.
constexpr double farthest_reach = 2.5;

// [1] Cost of a site in the disc of a neighbouring chord, which would be halved for it.
constexpr double encroachment = 1;

// [1] Cost of a closed path that goes along one chord and back: more than all other costs.
constexpr double back_and_forth = 1e3;

/// About the square of the logarithm.
double mismatch(double ratio) {
  const double d = ratio - 1 / ratio;
  return 0.25 * d * d;
}

/// The cost of an angle of the boundary: alpha - 1, summed over the isosceles triangles of the fan that fills it best.
/// A table over the diamond angle, which takes one division: 0..4 around a square instead of a circle.
class FanCosts {
public:
  FanCosts() {
    for (int k = 0; k <= 4 * per_side; ++k) {
      const double along = static_cast<double>(k % per_side) / per_side, x = 1 - along, y = along;
      const double in_quadrant = angle_of(y, x);
      costs_[k] = exact(0.5 * pi * (k / per_side) + in_quadrant);
    }
  }
  /// Returns the cost of the angle from the x axis to (x, y), 0..2 pi.
  double operator()(double x, double y) const {
    const double sum = std::fabs(x) + std::fabs(y);
    const double diamond = y >= 0 ? (x >= 0 ? y / sum : 1 - x / sum) : (x < 0 ? 2 - y / sum : 3 + x / sum);
    const double at = diamond * per_side;
    const int k = std::clamp(static_cast<int>(at), 0, 4 * per_side - 1);
    return costs_[k] + (at - k) * (costs_[k + 1] - costs_[k]);
  }

private:
  static constexpr int per_side = 256;
  static double exact(double angle) {
    double least = 8;
    for (int parts = 1; parts <= 7; ++parts) {
      const double s = sin_cos(0.5 * angle / parts).sin; // of half the apex angle: r/R = 2 s (1 - s)
      if (s > 0 && s < 1)
        least = std::fmin(least, parts * (1 / (4 * s * (1 - s)) - 1));
    }
    return least;
  }
  std::array<double, 4 * per_side + 1> costs_;
};

struct Chord {
  LocalIndex from, to;
  Vec2 along;
  double length, cost;                                    // of the chord alone
  double least = std::numeric_limits<double>::infinity(); // of all paths that end with it
  LocalIndex before = -1;
};

class PathFinder {
public:
  PathFinder(std::span<const SitePlace> places, bool closed) : places_(places), closed_(closed) {
    const std::size_t n = places.size();
    first_.resize(n + 1, 0);
    for (std::size_t from = 0; from + 1 < n; ++from) {
      first_[from] = static_cast<LocalIndex>(chords_.size());
      for (std::size_t to = from + 1; to < std::min(n, from + farthest_place); ++to) {
        const Vec2 along = places[to].position - places[from].position;
        const double length = geometry::length(along);
        if (!in_reach(from, to, length))
          break;
        add_chord(from, to, along, length);
      }
    }
    first_[n - 1] = first_[n] = static_cast<LocalIndex>(chords_.size());
    into_first_.assign(n + 1, 0);
    for (const Chord& chord : chords_)
      ++into_first_[static_cast<std::size_t>(chord.to) + 1];
    for (std::size_t place = 0; place < n; ++place)
      into_first_[place + 1] += into_first_[place];
    into_.resize(chords_.size());
    std::vector<LocalIndex> next(into_first_.begin(), into_first_.end() - 1);
    for (std::size_t c = 0; c < chords_.size(); ++c)
      into_[static_cast<std::size_t>(next[static_cast<std::size_t>(chords_[c].to)]++)] = static_cast<LocalIndex>(c);
  }

  std::vector<LocalIndex> run() {
    for (Chord& chord : chords_)
      if (chord.from == 0)
        chord.least = chord.cost;
    for (std::size_t place = 1; place + 1 < places_.size(); ++place) {
      const std::span<LocalIndex> before = into(place);
      std::sort(before.begin(), before.end(), [this](LocalIndex a, LocalIndex b) { // cheapest first
        const double u = chords_[static_cast<std::size_t>(a)].least, v = chords_[static_cast<std::size_t>(b)].least;
        return u < v || (u == v && a < b);
      });
      for (LocalIndex c = first_[place]; c < first_[place + 1]; ++c)
        for (const LocalIndex p : before)
          if (!extend(p, c))
            break;
    }
    return path_to(best_end());
  }

private:
  /// Behind a place far out, or far along a winding curve, no chord ends.
  bool in_reach(std::size_t from, std::size_t to, double length) const {
    const SitePlace &a = places_[from], &b = places_[to];
    return to == from + 1 || (b.t - a.t < farthest_way && length < farthest_reach * a.size);
  }

  void add_chord(std::size_t from, std::size_t to, Vec2 along, double length) {
    const SitePlace &a = places_[from], &b = places_[to];
    const double h = 0.5 * (a.size + b.size);
    const bool neighbours = to == from + 1;
    if (!(length > 0) || (!neighbours && (length > BoundaryRules::longest_chord * h || length < shortest_chord * h)))
      return;
    const double tolerance = std::min(a.tolerance, b.tolerance);
    const double far = tolerance * length * (1 + 1e-9); // beyond it there is no need to divide
    double most = 0;
    for (std::size_t k = from + 1; k < to; ++k) {
      const Vec2 p = places_[k].position;
      const double off = std::fabs(geometry::cross(along, p - a.position));
      if (geometry::dot(a.position - p, b.position - p) > 0 || off > far)
        return;
      most = std::max(most, off);
    }
    const double deviation = most / length;
    if (deviation > tolerance)
      return;
    const double relative = deviation / h;
    chords_.push_back(
        {static_cast<LocalIndex>(from), static_cast<LocalIndex>(to), along, length,
         BoundaryRules::length_weight * mismatch(length / h) + BoundaryRules::deviation_weight * relative * relative});
  }

  /// The cost of the lengths of two neighbours, a part of the cost of their joint.
  static double ratio_cost(const Chord& in, const Chord& out) {
    return BoundaryRules::ratio_weight * mismatch(in.length / out.length);
  }

  double joint_cost(const Chord& in, const Chord& out, double of_lengths) const {
    // From the way out to the way back, on the left.
    const double dot = -geometry::dot(out.along, in.along), cross = -geometry::cross(out.along, in.along);
    const double shorter = std::min(in.length, out.length);
    const bool encroaches = dot > shorter * shorter;
    return fan_costs_(dot, cross) + of_lengths + (encroaches ? encroachment : 0);
  }

  std::span<LocalIndex> into(std::size_t place) {
    return std::span(into_).subspan(static_cast<std::size_t>(into_first_[place]),
                                    static_cast<std::size_t>(into_first_[place + 1] - into_first_[place]));
  }

  /// False if neither this way nor a more expensive one can be better than the best that is known.
  bool extend(LocalIndex p, LocalIndex c) {
    const Chord& in = chords_[static_cast<std::size_t>(p)];
    Chord& out = chords_[static_cast<std::size_t>(c)];
    if (!(in.least + out.cost < out.least))
      return false;
    const double of_lengths = ratio_cost(in, out);
    if (!(in.least + out.cost + of_lengths < out.least))
      return true; // what else a joint costs is never negative
    const double cost = in.least + out.cost + joint_cost(in, out, of_lengths);
    if (cost < out.least) {
      out.least = cost;
      out.before = p;
    }
    return true;
  }

  LocalIndex best_end() {
    LocalIndex best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const LocalIndex c : into(places_.size() - 1)) {
      const Chord& chord = chords_[static_cast<std::size_t>(c)];
      double cost = chord.least;
      if (closed_) {
        LocalIndex start = c;
        while (chords_[static_cast<std::size_t>(start)].before >= 0)
          start = chords_[static_cast<std::size_t>(start)].before;
        const Chord& first = chords_[static_cast<std::size_t>(start)];
        if (start == c)
          cost += back_and_forth;
        else
          cost += joint_cost(chord, first, ratio_cost(chord, first));
      }
      if (best < 0 || cost < least) {
        least = cost;
        best = c;
      }
    }
    return best;
  }

  std::vector<LocalIndex> path_to(LocalIndex end) const {
    std::vector<LocalIndex> path{static_cast<LocalIndex>(places_.size()) - 1};
    for (LocalIndex c = end; c >= 0; c = chords_[static_cast<std::size_t>(c)].before)
      path.push_back(chords_[static_cast<std::size_t>(c)].from);
    std::reverse(path.begin(), path.end());
    return path;
  }

  static const FanCosts& fan_costs() {
    static const FanCosts costs;
    return costs;
  }

  const FanCosts& fan_costs_ = fan_costs();
  std::span<const SitePlace> places_;
  bool closed_;
  std::vector<Chord> chords_;
  std::vector<LocalIndex> first_;             // chord of each place
  std::vector<LocalIndex> into_first_, into_; // chords that end in each place
};

} // namespace

std::vector<LocalIndex> shortest_site_path(std::span<const SitePlace> places, bool closed) {
  return PathFinder(places, closed).run();
}

} // namespace trime::boundary
