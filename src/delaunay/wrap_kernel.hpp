// SPDX-License-Identifier: BSD-3-Clause
// The source of the three builds of wrap.hpp. All is in an anonymous namespace and calls nothing outside, so that no
// code for a newer processor can be linked into the rest of the program.
//
// Seen from a site p, every candidate q (an offset) is inverted: u = q / |q|^2. The disc of p, a, b holds q exactly if
// u(q) lies to the right of the line from u(a) to u(b): the star of p is the convex hull of the inverted candidates
// (Brown 1979), which is wrapped from an extreme point on (Jarvis 1973). One lane is one site; O(candidates x degree).
//
// Why a ring is right. With eps = 2^-24 and U = largest |u|, at most 10^4:
//  * a difference of two sites is known to 1.06 eps of itself, as is its inverse; the operations of the inversion add
//    4.2 eps |u|. Every u is known to 5.4 eps U.
//  * the wrap follows from vertex to vertex by adding edges, 3.1 eps U more for the vertex that it stands on. Edges are
//    known to 16 eps U, cross products of two edges of length at most 2 U to E = 76 eps U^2.
//  * a vertex is followed by the candidate of the smallest angle: each candidate is compared with the best one so far,
//    the first with a direction between those to the origin (the site itself) and to the last vertex, by the sign of a
//    cross product. All these vectors lie in one half plane, since everything lies strictly to the left of the edge
//    before, and signs are right where the product is larger than E. So the best one is right if no product was within
//    E, save that of the vertex with itself. That the origin lies to the left of an edge is tested too.
//  * the first vertex is the extreme one in a direction, by a margin; if the wrap comes back to it, the polygon is the
//    hull: candidates that were vertices before are on the left by convexity. The origin lies inside, so that the ring
//    winds once.
#pragma once

#include "delaunay/wrap.hpp"

namespace trime::delaunay {
namespace {

/// `lanes` sites side by side; `chains` independent searches of the best candidate hide the latency of one.
template <int lanes, int chains>
class Wrap {
  using Floats [[gnu::vector_size(lanes * 4)]] = float;
  using Ints [[gnu::vector_size(lanes * 4)]] = std::int32_t;

public:
  explicit Wrap(WrapGroup& group) : group_(group), n_(group.candidates) {
    for (int k = 0; k < chains; ++k) // rows that no comparison sees
      group.candidate[n_ + k].x = __builtin_nanf("");
    n_ += (chains - n_ % chains) % chains;
    static_assert(chains <= WrapGroup::padding);
  }

  void run() {
    invert();
    Ints undecided = set_bounds(), open = ~undecided, covered = ~Ints{};
    Floats low_x{}, low_y{}, high_x{}, high_y{};
    Ints near{}, degree{};
    const Floats cap = load(group_.cap);
    for (int round = 0; round < WrapGroup::most_degree; ++round) {
      const Step step = advance();
      // Distances of the edge's disc from the site: circumcentre plus and minus radius along the axes, rounded outward.
      const Floats turned = ax_ * step.wy - ay_ * step.wx;
      const Floats half = 0.5f / (turned - error_), slack = edge_error_;
      const Floats length = square_root(step.wx * step.wx + step.wy * step.wy) * 1.000001f + slack;
      const Ints sound = (turned > error_) & (length * half < cap) & (step.best >= 0);
      low_x = open ? lower(low_x, (step.wy - length) * half) : low_x;
      high_x = open ? upper(high_x, (step.wy + length) * half) : high_x;
      low_y = open ? lower(low_y, (-step.wx - length) * half) : low_y;
      high_y = open ? upper(high_y, (length - step.wx) * half) : high_y;
      covered &= sound | ~open;
      near = open ? near - step.near : near;
      degree -= open;
      store(group_.ring[round], step.best);
      undecided |= open & (step.best < 0);
      open &= step.best != start_;
      open &= ~undecided;
      if (!any(open))
        break;
      ax_ = ax_ + step.wx;
      ay_ = ay_ + step.wy;
      last_x_ = step.wx;
      last_y_ = step.wy;
    }
    store(group_.degree, degree & ~(undecided | open));
    store(group_.proven, near == degree);
    finish(covered, low_x, low_y, high_x, high_y);
  }

private:
  struct Step {
    Floats wx, wy; // the edge to the best candidate
    Ints best;     // negative: none
    Ints near;     // minus the number of undecided comparisons
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
  static Floats magnitude(const Floats& v) { return reinterpret_cast<Floats>(reinterpret_cast<Ints>(v) & 0x7fffffff); }
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

  /// Inverts all candidates and finds the extreme one in a direction that no lattice likes; second places show margins.
  void invert() {
    constexpr float large = 1e30f, slope = 0.2915f;
    const Floats site_x = load(group_.site_x), site_y = load(group_.site_y);
    const Floats rest_x = load(group_.site_rest_x), rest_y = load(group_.site_rest_y);
    Floats first = all(-large), second = all(-large), x = all(0.f), y = all(0.f);
    Floats nearest = all(large), next = all(large); // squared distances; the nearest one is the site itself
    Ints start = all(-1), counter{};
    for (int c = 0; c < n_; ++c) {
      const WrapGroup::Candidate& q = group_.candidate[c];
      const Floats dx = (q.x - site_x) + (q.rest_x - rest_x), dy = (q.y - site_y) + (q.rest_y - rest_y);
      const Floats d2 = dx * dx + dy * dy;
      const Floats inverse = 1.f / d2; // the site itself becomes NaN, which no comparison sees
      const Floats ux = dx * inverse, uy = dy * inverse;
      store(group_.u[c], ux);
      store(group_.u[c] + lanes, uy);
      const Floats farther = nearest > d2 ? nearest : d2;
      next = farther < next ? farther : next;
      nearest = d2 < nearest ? d2 : nearest;
      const Floats height = ux + slope * uy;
      const Floats loser = first < height ? first : height;
      second = loser > second ? loser : second;
      const Ints wins = height > first;
      first = wins ? height : first;
      x = wins ? ux : x;
      y = wins ? uy : y;
      start = wins ? counter : start;
      counter = counter + 1;
    }
    ax_ = x;
    ay_ = y;
    last_x_ = all(-slope);
    last_y_ = all(1.f);
    start_ = start;
    first_ = first;
    second_ = second;
    nearest_ = next;
  }

  /// The bounds of the head of this file; returns the lanes that cannot be decided.
  Ints set_bounds() {
    constexpr float epsilon = 0x1p-24f;
    const Floats size = 1.001f / square_root(nearest_);
    edge_error_ = 34 * epsilon * size; // of a component and the length together
    error_ = 76 * epsilon * size * size;
    const Floats margin = 20 * epsilon * size;
    const Ints fine = (first_ - second_ > margin) & (first_ > margin) & (size < 1e4f);
    return ~fine;
  }

  /// The next edge of the hull, from the vertex at (ax_, ay_) on.
  Step advance() const {
    Floats wx[chains], wy[chains];
    Ints best[chains], near[chains];
    for (int k = 0; k < chains; ++k) {
      wx[k] = -ax_ - 0.37f * last_x_; // into the hull, in a direction that no lattice likes
      wy[k] = -ay_ - 0.37f * last_y_;
      best[k] = all(-chains - 1);
      near[k] = Ints{};
    }
    Ints counter{};
    const Floats error = error_, least = -error_, ax = ax_, ay = ay_;
    for (int c = 0; c < n_; c += chains) {
#pragma GCC unroll 8
      for (int k = 0; k < chains; ++k) {
        const Floats vx = load(group_.u[c + k]) - ax, vy = load(group_.u[c + k] + lanes) - ay;
        const Floats turned = wx[k] * vy - wy[k] * vx;
        near[k] += magnitude(turned) <= error;
        const Ints wins = turned < least; // never the vertex itself
        wx[k] = wins ? vx : wx[k];
        wy[k] = wins ? vy : wy[k];
        best[k] = wins ? counter : best[k];
      }
      counter = counter + chains;
    }
    Step step{wx[0], wy[0], best[0], near[0]};
    for (int k = 1; k < chains; ++k) {
      const Floats turned = step.wx * wy[k] - step.wy * wx[k];
      step.near += near[k] + (magnitude(turned) <= error);
      const Ints wins = turned < 0;
      step.wx = wins ? wx[k] : step.wx;
      step.wy = wins ? wy[k] : step.wy;
      step.best = wins ? best[k] + k : step.best;
    }
    return step;
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
  int n_;                  // candidates, padded to a multiple of `chains`
  Floats ax_, ay_;         // the vertex
  Floats last_x_, last_y_; // the edge before
  Floats first_, second_, nearest_, error_, edge_error_;
  Ints start_;
};

} // namespace
} // namespace trime::delaunay
