// SPDX-License-Identifier: BSD-3-Clause
// Implements the kernel of wrap.hpp, and is compiled three times. Everything is in an anonymous namespace and calls no
// function outside, so that no code for a newer processor can be linked into the rest of the program.
//
// Seen from a site p, every candidate q (relative to p) is inverted: u = q / |q|^2. The circumcircle of p, a, b
// contains q exactly if u(q) lies to the right of the line from u(a) to u(b). So the star of p is the convex hull of
// the inverted candidates (Brown 1979). The hull is wrapped from an extreme point on (Jarvis 1973). One vector lane
// processes one site. Cost: O(candidates x degree).
//
// Why a proven ring is right. Let eps = 2^-24, and let U, at most 10^4, be the largest |u|.
// * The difference of two sites has a relative error of 1.06 eps, and so has its inverse; the operations of the
//   inversion add 4.2 eps |u|. So the error of every u is at most 5.4 eps U.
// * The wrapping goes from vertex to vertex by adding edges, which adds 3.1 eps U to the error of the current vertex.
//   So the error of edges is at most 16 eps U. Consider the cross product of an edge with the vector from its first
//   vertex to a candidate: as evaluated here, its error is at most E = 80 eps U^2.
// * How the next vertex is searched does not matter, because afterwards each edge is tested against all candidates. If
//   all other candidates, and the origin (the site itself), are to the left of an edge by more than E, the edge belongs
//   to the hull around the origin. Consecutive edges of the hull that return to the first vertex are the whole hull.
#pragma once

#include "delaunay/wrap.hpp"

namespace trime::delaunay {
namespace {

/// Wraps the stars of `lanes` sites at once. `chains` independent searches for the best candidate hide the latency of
/// each other.
template <int lanes, int chains>
class Wrap {
  using Floats [[gnu::vector_size(lanes * 4)]] = float;
  using Ints [[gnu::vector_size(lanes * 4)]] = std::int32_t;

public:
  explicit Wrap(WrapGroup& group) : group_(group), n_(group.candidates) {
    for (int k = 0; k < chains; ++k) // rows with NaN, which no comparison selects
      group.candidate[n_ + k].x = __builtin_nanf("");
    n_ += (chains - n_ % chains) % chains;
    static_assert(chains <= WrapGroup::padding);
  }

  void run() {
    invert();
    Ints open = set_bounds(), covered = ~Ints{}, proven = ~Ints{}, degree{};
    Floats low_x{}, low_y{}, high_x{}, high_y{};
    const Floats cap = load(group_.cap);
    for (int round = 0; round < WrapGroup::most_degree; ++round) {
      const Step step = advance();
      proven &= (step.right == -2) | ~tested_;
      tested_ = open;
      // Bounding box of the edge's circumcircle, relative to the site: circumcentre plus and minus radius along the
      // axes, rounded outward.
      const Floats turned = ax_ * step.wy - ay_ * step.wx;
      const Floats half = 0.5f / (turned - error_), slack = edge_error_;
      const Floats length = square_root(step.wx * step.wx + step.wy * step.wy) * 1.000001f + slack;
      const Ints sound = (turned > error_) & (length * half < cap) & (step.best >= 0);
      low_x = open ? lower(low_x, (step.wy - length) * half) : low_x;
      high_x = open ? upper(high_x, (step.wy + length) * half) : high_x;
      low_y = open ? lower(low_y, (-step.wx - length) * half) : low_y;
      high_y = open ? upper(high_y, (length - step.wx) * half) : high_y;
      covered &= sound | ~open;
      degree -= open;
      store(group_.ring[round], step.best);
      edge_x_ = step.wx;
      edge_y_ = step.wy;
      limit_ = error_ - turned;
      ax_ = ax_ + step.wx;
      ay_ = ay_ + step.wy;
      open &= (step.best != start_) & (step.best >= 0);
      if (!any(open))
        break;
    }
    proven &= (count_right() == -2) | ~tested_;
    store(group_.degree, degree & ~open);
    store(group_.proven, proven);
    finish(covered, low_x, low_y, high_x, high_y);
  }

private:
  struct Step {
    Floats wx, wy; // the edge to the best candidate
    Ints best;     // number of the best candidate; negative if no candidate is left
    Ints right;    // minus the number of candidates that are not to the left of the last edge
  };

  template <class V>
  static V load_as(const void* from) {
    V v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }
  static Floats load(const float* from) { return load_as<Floats>(from); }
  template <class V>
  static void store(void* to, const V& v) {
    __builtin_memcpy(to, &v, sizeof v);
  }
  static Floats all(float v) { return v - Floats{}; }
  static Ints all(std::int32_t v) { return v - Ints{}; }
  static Floats lower(const Floats& a, const Floats& b) { return a < b ? a : b; }
  static Floats upper(const Floats& a, const Floats& b) { return a > b ? a : b; }
  static Floats square_root(const Floats& v) {
    alignas(64) float lane[lanes];
    store(lane, v);
    for (int k = 0; k < lanes; ++k)
      lane[k] = __builtin_sqrtf(lane[k]);
    return load(lane);
  }
  static bool any(const Ints& v) {
    alignas(64) std::int64_t wide[lanes / 2];
    store(wide, v);
    std::int64_t found = 0;
    for (int k = 0; k < lanes / 2; ++k)
      found |= wide[k];
    return found != 0;
  }

  /// Inverts all candidates, and finds the extreme one in a direction that is not parallel to lines of a lattice.
  void invert() {
    constexpr float large = 1e30f, slope = 0.2915f;
    const Floats site_x = load(group_.site_x), site_y = load(group_.site_y);
    const Floats rest_x = load(group_.site_rest_x), rest_y = load(group_.site_rest_y);
    Floats first = all(-large), x = all(0.f), y = all(0.f);
    Floats nearest = all(large),
           next = all(large); // squared distances of the two nearest candidates; the nearest one is the site itself
    Ints start = all(-1), counter{};
    for (int c = 0; c < n_; ++c) {
      const WrapGroup::Candidate& q = group_.candidate[c];
      const Floats dx = (q.x - site_x) + (q.rest_x - rest_x), dy = (q.y - site_y) + (q.rest_y - rest_y);
      const Floats d2 = dx * dx + dy * dy;
      const Floats inverse = 1.f / d2; // NaN for the site itself, which no comparison selects
      const Floats ux = dx * inverse, uy = dy * inverse;
      store(group_.u[c], ux);
      store(group_.u[c] + lanes, uy);
      const Floats farther = nearest > d2 ? nearest : d2;
      next = farther < next ? farther : next;
      nearest = d2 < nearest ? d2 : nearest;
      const Floats height = ux + slope * uy;
      const Ints wins = height > first;
      first = wins ? height : first;
      x = wins ? ux : x;
      y = wins ? uy : y;
      start = wins ? counter : start;
      counter = counter + 1;
    }
    ax_ = x;
    ay_ = y;
    edge_x_ = all(-slope);
    edge_y_ = all(1.f);
    limit_ = all(0.f);
    start_ = start;
    nearest_ = next;
  }

  /// Sets the error bounds that the top of this file derives. Returns the lanes that can be decided.
  Ints set_bounds() {
    constexpr float epsilon = 0x1p-24f;
    const Floats size = 1.001f / square_root(nearest_);
    edge_error_ = 34 * epsilon * size; // error of a component and of the length together
    error_ = 80 * epsilon * size * size;
    return size < 1e4f;
  }

  /// Returns the next edge of the hull from the vertex at (ax_, ay_), and the result of testing the last edge.
  Step advance() const {
    Floats wx[chains], wy[chains];
    Ints best[chains], right[chains];
    for (int k = 0; k < chains; ++k) {
      wx[k] = -ax_ - 0.37f * edge_x_; // a vector into the hull, to the left of all candidates that may follow
      wy[k] = -ay_ - 0.37f * edge_y_;
      best[k] = all(-chains - 1);
      right[k] = Ints{};
    }
    Ints counter{};
    const Floats least = -error_, ax = ax_, ay = ay_, edge_x = edge_x_, edge_y = edge_y_, limit = limit_;
    for (int c = 0; c < n_; c += chains) {
#pragma GCC unroll 8
      for (int k = 0; k < chains; ++k) {
        const Floats ux = load(group_.u[c + k]), uy = load(group_.u[c + k] + lanes);
        right[k] += edge_x * uy - edge_y * ux <= limit;
        const Floats vx = ux - ax, vy = uy - ay;
        const Ints wins = wx[k] * vy - wy[k] * vx < least; // never true for the vertex itself
        wx[k] = wins ? vx : wx[k];
        wy[k] = wins ? vy : wy[k];
        best[k] = wins ? counter : best[k];
      }
      counter = counter + chains;
    }
    Step step{wx[0], wy[0], best[0], right[0]};
    for (int k = 1; k < chains; ++k) {
      step.right += right[k];
      const Ints wins = step.wx * wy[k] - step.wy * wx[k] < 0;
      step.wx = wins ? wx[k] : step.wx;
      step.wy = wins ? wy[k] : step.wy;
      step.best = wins ? best[k] + k : step.best;
    }
    return step;
  }

  /// Returns the result of testing the last edge.
  Ints count_right() const {
    Ints right[2]{};
    for (int c = 0; c < n_; ++c)
      right[c & 1] += edge_x_ * load(group_.u[c] + lanes) - edge_y_ * load(group_.u[c]) <= limit_;
    return right[0] + right[1];
  }

  void finish(const Ints& covered, const Floats& low_x, const Floats& low_y, const Floats& high_x,
              const Floats& high_y) {
    const Floats x = load(group_.site_x), y = load(group_.site_y);
    const float limit_x = group_.half_x * 0.99999f, limit_y = group_.half_y * 0.99999f, grown = 1.00001f;
    const Floats x0 = x + low_x * grown, x1 = x + high_x * grown, y0 = y + low_y * grown, y1 = y + high_y * grown;
    store(group_.covered, covered & (x0 > -limit_x) & (x1 < limit_x) & (y0 > -limit_y) & (y1 < limit_y));
    store(group_.low_x, x0);
    store(group_.low_y, y0);
    store(group_.high_x, x1);
    store(group_.high_y, y1);
  }

  WrapGroup& group_;
  int n_;                          // number of candidates, rounded up to a multiple of `chains`
  Floats ax_, ay_;                 // the current vertex
  Floats edge_x_, edge_y_, limit_; // the last edge, and the bound on cross products for candidates to its left
  Floats nearest_, error_, edge_error_;
  Ints start_, tested_{}; // lanes that have a last edge
};

} // namespace
} // namespace trime::delaunay
