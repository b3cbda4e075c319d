// SPDX-License-Identifier: BSD-3-Clause
// The kernels of search_kernel.hpp, which are compiled three times. Everything is in an anonymous namespace and calls
// nothing outside, so that no code for a newer processor can be linked into the rest of the program. One lane is one
// box, segment or cone.
#pragma once

#include "cones/search_kernel.hpp"
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
    // Returns the squared distance within which a cone of this height is lower than the best; negative if it is nowhere
    // lower.
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

  /// Searches depth first, the nearest box first. The limit may fall while leaves are visited.
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
        stack[size] = stack[size - 1]; // the nearest stays on top
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

  /// Computes square roots only for cones that are lower than the best one before this leaf.
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
} // namespace trime::cones
