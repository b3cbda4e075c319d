// SPDX-License-Identifier: BSD-3-Clause
// The source that is compiled three times to give the kernels of cone_kernel.hpp. Everything is in an anonymous
// namespace and calls no function outside, so that no code for a newer processor can be linked into the rest of the
// program. One vector lane holds one box, segment or cone.
#pragma once

#include "cones/cone_kernel.hpp"
#include "core/lanes.hpp"

namespace trime::cones {
namespace {

template <int n>
class Search {
  using V = typename lanes::Types<n>::Doubles;

public:
  static void nearest(const BoxLevels& levels, const SegmentLeaf* leaves, double x, double y, double share,
                      NearestPoint& best) {
    const auto limit = [&](auto number) { return number * 0 + best.squared_distance * share; };
    search(levels, x, y, limit, [&](std::int64_t leaf) { visit(leaves[leaf], leaf, x, y, best); });
  }

  static void lowest(const BoxLevels& levels, const ConeLeaf* leaves, double slope, double x, double y, double share,
                     LowestCone& best) {
    const double inverse_slope = 1 / slope;
    // Returns the squared distance within which a cone of this height is lower than the best cone; negative if there is
    // no such distance.
    const auto limit = [&](auto least) {
      const auto reach = (best.value * share - least) * inverse_slope;
      return reach > 0 ? reach * reach : reach * 0 - 1;
    };
    search(levels, x, y, limit, [&](std::int64_t leaf) { visit(leaves[leaf], leaf, slope, x, y, best); });
  }

private:
  struct Entry {
    std::int64_t node;
    int level;
    double squared_distance, number;
  };

  TRIME_INLINE static V load(const double* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }

  /// Searches depth first, the nearest box first. The limit may become smaller while leaves are visited.
  template <class Limit, class Visit>
  TRIME_INLINE static void search(const BoxLevels& levels, double x, double y, const Limit& limit, const Visit& visit) {
    if (levels.count == 0)
      return;
    Entry stack[box_width * BoxLevels::most];
    int size = 0;
    add_children(levels, {0, levels.count, 0, 0}, x, y, limit, stack, size);
    while (size > 0) {
      const Entry entry = stack[--size];
      if (!(entry.squared_distance < limit(entry.number)))
        continue;
      if (entry.level == 0)
        visit(entry.node);
      else
        add_children(levels, entry, x, y, limit, stack, size);
    }
  }

  template <class Limit>
  TRIME_INLINE static void add_children(const BoxLevels& levels, const Entry& entry, double x, double y,
                                        const Limit& limit, Entry* stack, int& size) {
    const BoxNode& node = levels.nodes[entry.level - 1][entry.node];
    const int bottom = size;
    double distances[box_width];
    unsigned near = 0;
    for (int k = 0; k < box_width; k += n) {
      const V dx = lanes::larger(lanes::larger(load(node.min_x + k) - x, x - load(node.max_x + k)), V{});
      const V dy = lanes::larger(lanes::larger(load(node.min_y + k) - y, y - load(node.max_y + k)), V{});
      const V squared = dx * dx + dy * dy;
      std::memcpy(distances + k, &squared, sizeof squared);
      near |= lanes::bits(squared < limit(load(node.number + k))) << k;
    }
    for (; near != 0; near &= near - 1) {
      const int k = __builtin_ctz(near);
      const Entry child{entry.node * box_width + k, entry.level - 1, distances[k], node.number[k]};
      if (size > bottom && child.squared_distance > stack[size - 1].squared_distance) {
        stack[size] = stack[size - 1]; // the nearest box stays on top of the stack
        stack[size - 1] = child;
      } else {
        stack[size] = child;
      }
      ++size;
    }
  }

  TRIME_INLINE static void visit(const SegmentLeaf& leaf, std::int64_t index, double x, double y, NearestPoint& best) {
    for (int k = 0; k < box_width; k += n) {
      const V a_x = load(leaf.a_x + k), a_y = load(leaf.a_y + k), d_x = load(leaf.d_x + k), d_y = load(leaf.d_y + k);
      const V along = ((x - a_x) * d_x + (y - a_y) * d_y) * load(leaf.inverse_square + k);
      const V positive = lanes::larger(along, V{}), t = positive < 1 ? positive : V{} + 1;
      const V q_x = a_x + t * d_x, q_y = a_y + t * d_y;
      const V squared = (q_x - x) * (q_x - x) + (q_y - y) * (q_y - y);
      for (unsigned near = lanes::bits(squared < best.squared_distance); near != 0; near &= near - 1) {
        const int lane = __builtin_ctz(near);
        if (squared[lane] < best.squared_distance)
          best = {q_x[lane], q_y[lane], squared[lane], index * box_width + k + lane};
      }
    }
  }

  /// Computes square roots only for cones that are lower than the best cone found in earlier leaves.
  TRIME_INLINE static void visit(const ConeLeaf& leaf, std::int64_t index, double slope, double x, double y,
                                 LowestCone& best) {
    const double inverse_slope = 1 / slope, bound = best.value;
    for (int k = 0; k < box_width; k += n) {
      const V dx = x - load(leaf.x + k), dy = y - load(leaf.y + k), squared = dx * dx + dy * dy;
      const V height = load(leaf.height + k), reach = (bound - height) * inverse_slope;
      unsigned low = lanes::bits((reach > 0) & (squared < reach * reach));
      if (low == 0)
        continue;
      const V value = slope * lanes::square_root(squared) + height;
      for (; low != 0; low &= low - 1) {
        const int lane = __builtin_ctz(low);
        if (value[lane] < best.value)
          best = {value[lane], index * box_width + k + lane};
      }
    }
  }
};

} // namespace
namespace {

constexpr double nowhere = 1e300; // marks cones that a chosen cone covers
constexpr double done = 1e301;

template <int n>
class Cones {
  using V = typename lanes::Types<n>::Doubles;
  using M = typename lanes::Types<n>::Mask;
  static constexpr int corners[4] = {0, 2, 6, 8};

public:
  static void evaluate(ConeList& list, double slope, const ConePoints& points) {
    pad(list.x(), list.count, 0);
    pad(list.y(), list.count, 0);
    pad(list.height(), list.count, nowhere);
    for (std::int64_t k = 0; k < list.count; k += n) {
      const V x = load(list.x() + k), y = load(list.y() + k), height = load(list.height() + k);
      for (int p = 0; p < points.count; ++p) {
        const V dx = points.x[p] - x, dy = points.y[p] - y;
        store(list.at(points.number[p]) + k, slope * lanes::square_root(dx * dx + dy * dy) + height);
      }
    }
    for (int p = 0; p < points.count; ++p) {
      pad(list.at(points.number[p]), list.count, nowhere);
      find_lowest(list, points.number[p]);
    }
  }

  static void pass_on(const ConeList& from, int quarter, ConeList& to) {
    const int first = (quarter & 1) + 3 * (quarter >> 1); // number of the first corner of the quarter
    const int points[5] = {first, first + 1, first + 3, first + 4, ConeList::first_quarter + quarter};
    constexpr int new_points[5] = {0, 2, 6, 8, ConeList::center};
    Winner winners[5];
    int winner_count = 0;
    for (int p = 0; p < 5; ++p)
      add_winner(from, points, from.lowest[points[p]], winners, winner_count);
    const double* source[8];
    double* target[8];
    for (int p = 0; p < 5; ++p) {
      source[p] = from.at(points[p]);
      target[p] = to.at(new_points[p]);
    }
    for (int a = 0; a < 3; ++a) {
      source[5 + a] = from.at(ConeList::points + a);
      target[5 + a] = to.at(ConeList::points + a);
    }
    std::int64_t count = 0;
    for (std::int64_t k = 0; k < from.count; k += n) {
      const M covered = hidden_cones(source, from.count, k, winners, winner_count);
      for (unsigned kept = ~lanes::bits(covered) & ((1u << n) - 1); kept != 0; kept &= kept - 1) {
        const std::int64_t cone = k + __builtin_ctz(kept);
        for (int a = 0; a < 8; ++a)
          target[a][count] = source[a][cone];
        ++count;
      }
    }
    to.count = count;
    for (int p = 0; p < 5; ++p) {
      pad(target[p], count, nowhere);
      find_lowest(to, new_points[p]);
    }
  }

  static int choose(const ConeList& list, int most, ConeChoice& choice) {
    if (list.count > ConeChoice::most_listed)
      return 0;
    double slack[ConeChoice::most_listed], open[ConeChoice::most_listed + ConeList::padding];
    for (std::int64_t k = 0; k < list.count; k += n) {
      store(slack + k, slack_of(choice, load(list.x() + k), load(list.y() + k)));
      store(open + k, load(list.at(ConeList::center) + k));
    }
    pad(open, list.count, done);
    int count = 0;
    for (const int corner : corners)
      if (const std::int64_t cone = list.lowest[corner]; !is_among(choice, count, cone))
        take(list, choice, count, cone, slack, open);
    while (count <= most) {
      const std::int64_t next = first_least(open, list.count);
      if (open[next] >= done)
        return count;
      if (count == most)
        break;
      take(list, choice, count, next, slack, open);
    }
    return 0;
  }

private:
  struct Winner {
    std::int64_t cone;
    double height, at[4];
  };

  TRIME_INLINE static V load(const double* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  TRIME_INLINE static void store(double* to, V v) { std::memcpy(to, &v, sizeof v); }
  TRIME_INLINE static M lane_numbers() {
    M m;
    for (int k = 0; k < n; ++k)
      m[k] = k;
    return m;
  }
  TRIME_INLINE static void pad(double* values, std::int64_t count, double with) {
    for (std::int64_t k = count; k % ConeList::padding != 0; ++k)
      values[k] = with;
  }

  TRIME_INLINE static std::int64_t first_least(const double* values, std::int64_t count) {
    V least = load(values);
    for (std::int64_t k = n; k < count; k += n) {
      const V v = load(values + k);
      least = lanes::select(v < least, v, least);
    }
    double low = least[0];
    for (int k = 1; k < n; ++k)
      low = least[k] < low ? least[k] : low;
    for (std::int64_t k = 0; k < count; k += n)
      if (const unsigned same = lanes::bits(load(values + k) <= low); same != 0)
        return k + __builtin_ctz(same);
    return 0;
  }
  TRIME_INLINE static void find_lowest(ConeList& list, int point) {
    list.lowest[point] = 0;
    list.low[point] = nowhere;
    if (list.count == 0)
      return;
    list.lowest[point] = first_least(list.at(point), list.count);
    list.low[point] = list.at(point)[list.lowest[point]];
  }

  TRIME_INLINE static void add_winner(const ConeList& list, const int (&points)[5], std::int64_t cone,
                                      Winner (&winners)[5], int& count) {
    for (int w = 0; w < count; ++w)
      if (winners[w].cone == cone)
        return;
    Winner& winner = winners[count++];
    winner.cone = cone;
    winner.height = list.height()[cone];
    for (int c = 0; c < 4; ++c)
      winner.at[c] = list.at(points[c])[cone];
  }
  /// Returns whether, at all corners, the value of the winner is at most the value of the other cone plus the margin.
  TRIME_INLINE static M is_below(const Winner& winner, const V (&at)[4], V margin) {
    return (winner.at[0] <= at[0] + margin) & (winner.at[1] <= at[1] + margin) & (winner.at[2] <= at[2] + margin) &
           (winner.at[3] <= at[3] + margin);
  }
  /// Returns which of the n cones from number k on are covered by winners, or lie beyond the end of the list.
  TRIME_INLINE static M hidden_cones(const double* const* source, std::int64_t count, std::int64_t k,
                                     const Winner* winners, int winner_count) {
    const V at[4] = {load(source[0] + k), load(source[1] + k), load(source[2] + k), load(source[3] + k)};
    const V height = load(source[7] + k);
    M covered = lane_numbers() + k >= count;
    M spared{}; // two equal cones must not cover each other, so a winner may be covered only by an earlier winner
    for (int w = 0; w < winner_count; ++w) {
      const V higher = winners[w].height - height, margin = lanes::select(higher < V{}, higher, V{});
      spared |= lane_numbers() + k == winners[w].cone;
      covered |= is_below(winners[w], at, margin) & ~spared;
    }
    return covered;
  }

  /// Returns by how much the value of another cone may be higher at the corners, so that its error inside the cell is
  /// at most the slack.
  TRIME_INLINE static V slack_of(const ConeChoice& choice, V x, V y) {
    const V zero{}, dx = larger(zero, larger(choice.min_x - x, x - choice.max_x));
    const V dy = larger(zero, larger(choice.min_y - y, y - choice.max_y)), squared = dx * dx + dy * dy;
    return choice.slack - choice.bend / lanes::square_root(squared + 1e-300); // negative if the cone lies in the cell
  }
  TRIME_INLINE static V larger(V a, V b) { return lanes::select(a < b, b, a); }

  TRIME_INLINE static bool is_among(const ConeChoice& choice, int count, std::int64_t cone) {
    for (int k = 0; k < count; ++k)
      if (choice.chosen[k] == cone)
        return true;
    return false;
  }
  /// Chooses a cone and marks all cones that this cone covers.
  TRIME_INLINE static void take(const ConeList& list, ConeChoice& choice, int& count, std::int64_t cone,
                                const double* slack, double* open) {
    choice.chosen[count++] = cone;
    open[cone] = done;
    const double* const at[4] = {list.at(0), list.at(2), list.at(6), list.at(8)};
    const Winner winner{cone, list.height()[cone], {at[0][cone], at[1][cone], at[2][cone], at[3][cone]}};
    for (std::int64_t k = 0; k < list.count; k += n) {
      const V values[4] = {load(at[0] + k), load(at[1] + k), load(at[2] + k), load(at[3] + k)};
      const V higher = winner.height - load(list.height() + k);
      const V margin = larger(lanes::select(higher < V{}, higher, V{}), load(slack + k));
      const V was = load(open + k);
      store(open + k, lanes::select(is_below(winner, values, margin), V{} + done, was));
    }
  }
};

} // namespace
} // namespace trime::cones
