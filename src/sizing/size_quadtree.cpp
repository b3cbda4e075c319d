// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/size_quadtree.hpp"

#include "sizing/shared_work.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

using geometry::Vec2;

namespace {

constexpr double half_diagonal = 0.70710678118654757; // of a unit square
constexpr double rounding = 1 + 1e-12;

bool within(double exact, double interpolated) {
  return std::fabs(exact - interpolated) <= SizeQuadtree::tolerance * exact;
}

} // namespace

/// The quadtree of one block, with indices of its own.
struct SizeQuadtree::Block {
  Node root = 0;
  std::vector<Children> children;
  std::vector<CornerValues> leaves;
};

/// Builds one block, top down. Every cell passes on only those cones that can be the lowest somewhere in it.
class SizeQuadtree::Builder {
public:
  explicit Builder(const Source& source) : source_(source), inverse_slope_(1 / source.slope) {}

  Block build(Vec2 corner, double side) {
    const Vec2 center = corner + Vec2{0.5 * side, 0.5 * side};
    const double low = source_.cones.value(center, source_.cap);
    std::vector<LocalIndex> near;
    source_.cones.collect(center, (low + 2 * half_diagonal * side * source_.slope) * rounding, near);
    for (const LocalIndex k : near)
      cones_.push_back(source_.cones.cones()[k]);
    const double right = corner.x + side, top = corner.y + side;
    const CornerValues values{lowest(0, corner), lowest(0, {right, corner.y}), lowest(0, {corner.x, top}),
                              lowest(0, {right, top})};
    block_.root = build_cell({corner, side, values, 0, 0});
    return std::move(block_);
  }

private:
  struct Cell {
    Vec2 corner;
    double side;
    CornerValues values;
    std::size_t first; ///< its cones are the last on the stack, from here
    int level;
  };

  /// Is the cone at p at most so high? Takes no root.
  bool is_below(const Cone& cone, Vec2 p, double height) const {
    const double reach = (height - cone.height) * inverse_slope_;
    return reach >= 0 && squared_length(p - cone.apex) <= reach * reach;
  }

  double lowest(std::size_t first, Vec2 p) const { return lowest(first, p, source_.cap); }
  double lowest(std::size_t first, Vec2 p, double low) const {
    for (std::size_t k = first; k < cones_.size(); ++k)
      if (is_below(cones_[k], p, low))
        low = std::min(low, cones_[k].value(p, source_.slope));
    return low;
  }

  Node leaf(const Cell& cell) {
    block_.leaves.push_back(cell.values);
    return ~static_cast<Node>(block_.leaves.size() - 1);
  }

  /// Pushes those cones of the cell that may be the lowest in it; returns the value at its centre.
  double push_cones(const Cell& cell, Vec2 center) {
    const double low = lowest(cell.first, center);
    const double bound = (low + 2 * half_diagonal * cell.side * source_.slope) * rounding;
    const std::size_t last = cones_.size();
    for (std::size_t k = cell.first; k < last; ++k)
      if (is_below(cones_[k], center, bound))
        cones_.push_back(Cone(cones_[k]));
    return low;
  }

  Node build_cell(const Cell& cell) {
    const auto& [v0, v1, v2, v3] = cell.values;
    const double least = std::min(std::min(v0, v1), std::min(v2, v3));
    // No point of the cell is farther from its nearest corner than half the diagonal.
    if (source_.slope * half_diagonal * cell.side <= tolerance * least || cell.side <= source_.least_side ||
        cell.level >= most_levels)
      return leaf(cell);
    const double half = 0.5 * cell.side;
    const double left = cell.corner.x, below = cell.corner.y, right = left + cell.side, above = below + cell.side;
    const Vec2 center{left + half, below + half};
    const std::size_t first = cones_.size();
    const double middle = push_cones(cell, center);
    const double south = lowest(first, {center.x, below}), north = lowest(first, {center.x, above});
    const double west = lowest(first, {left, center.y}), east = lowest(first, {right, center.y});
    Node node;
    const bool smooth = within(middle, 0.25 * (v0 + v1 + v2 + v3)) && within(south, 0.5 * (v0 + v1)) &&
                        within(north, 0.5 * (v2 + v3)) && within(west, 0.5 * (v0 + v2)) &&
                        within(east, 0.5 * (v1 + v3)) && (cones_.size() - first < 2 || within_quarters(cell, first));
    if (smooth) {
      node = leaf(cell);
    } else {
      node = static_cast<Node>(block_.children.size());
      block_.children.emplace_back();
      const int level = cell.level + 1;
      const Children children{build_cell({cell.corner, half, {v0, south, west, middle}, first, level}),
                              build_cell({{center.x, below}, half, {south, v1, middle, east}, first, level}),
                              build_cell({{left, center.y}, half, {west, middle, v2, north}, first, level}),
                              build_cell({center, half, {middle, east, north, v3}, first, level})};
      block_.children[node] = children;
    }
    cones_.resize(first);
    return node;
  }

  /// A ridge between cones may pass by the middles of edges and cell.
  bool within_quarters(const Cell& cell, std::size_t first) const {
    const auto& [v0, v1, v2, v3] = cell.values;
    for (const double y : {0.25, 0.75})
      for (const double x : {0.25, 0.75}) {
        const double below = v0 + x * (v1 - v0), above = v2 + x * (v3 - v2);
        const double exact = lowest(first, cell.corner + cell.side * Vec2{x, y});
        if (!within(exact, below + y * (above - below)))
          return false;
      }
    return true;
  }

  const Source& source_;
  const double inverse_slope_;
  Block block_;
  std::vector<Cone> cones_; // a stack: the cones of a cell lie on those of its parents
};

SizeQuadtree::SizeQuadtree(const comm::Communicator& comm, const Source& source) : box_(source.box) {
  side_ = std::max(box_.width(), box_.height()) / blocks_along;
  inverse_side_ = 1 / side_;
  nx_ = static_cast<std::size_t>(std::clamp(std::ceil(box_.width() * inverse_side_), 1.0, 1.0 * blocks_along));
  ny_ = static_cast<std::size_t>(std::clamp(std::ceil(box_.height() * inverse_side_), 1.0, 1.0 * blocks_along));
  const auto ranks = static_cast<std::size_t>(comm.size()), rank = static_cast<std::size_t>(comm.rank());
  std::vector<Block> mine;
  comm::run_agreed(comm, [&] {
    const std::size_t count = nx_ * ny_;
    mine.resize(rank < count ? (count - rank - 1) / ranks + 1 : 0);
    thread_loop(static_cast<std::ptrdiff_t>(mine.size()), 4, [&](std::ptrdiff_t k, int) {
      const std::size_t block = rank + static_cast<std::size_t>(k) * ranks;
      const Vec2 place{static_cast<double>(block % nx_), static_cast<double>(block / nx_)};
      mine[k] = Builder(source).build(box_.min + side_ * place, side_);
    });
  });
  assemble(comm, std::move(mine));
}

void SizeQuadtree::assemble(const comm::Communicator& comm, std::vector<Block> mine) {
  struct Size {
    std::int64_t children, leaves;
    Node root;
  };
  std::vector<Size> sizes;
  std::vector<Children> children;
  std::vector<CornerValues> leaves;
  for (Block& block : mine) {
    sizes.push_back({std::ssize(block.children), std::ssize(block.leaves), block.root});
    children.insert(children.end(), block.children.begin(), block.children.end());
    leaves.insert(leaves.end(), block.leaves.begin(), block.leaves.end());
    block = {};
  }
  sizes = gather_everywhere(comm, std::move(sizes));
  children = gather_everywhere(comm, std::move(children));
  leaves = gather_everywhere(comm, std::move(leaves));
  // Rank by rank as gathered; to be put in the order of the blocks, so that the arrays do not depend on the ranks.
  const auto ranks = static_cast<std::size_t>(comm.size());
  std::vector<std::size_t> position(nx_ * ny_), first_child(nx_ * ny_), first_leaf(nx_ * ny_);
  std::size_t next = 0, next_child = 0, next_leaf = 0;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    for (std::size_t block = rank; block < nx_ * ny_; block += ranks) {
      position[block] = next;
      first_child[block] = next_child;
      first_leaf[block] = next_leaf;
      next_child += static_cast<std::size_t>(sizes[next].children);
      next_leaf += static_cast<std::size_t>(sizes[next].leaves);
      ++next;
    }
  children_.reserve(children.size());
  leaves_.reserve(leaves.size());
  for (std::size_t block = 0; block < nx_ * ny_; ++block) {
    const Size& size = sizes[position[block]];
    const auto child_offset = static_cast<Node>(children_.size()), leaf_offset = static_cast<Node>(leaves_.size());
    const auto moved = [&](Node node) { return node >= 0 ? node + child_offset : node - leaf_offset; };
    roots_.push_back(moved(size.root));
    for (std::size_t k = 0; k < static_cast<std::size_t>(size.children); ++k) {
      const Children& old = children[first_child[block] + k];
      children_.push_back({moved(old[0]), moved(old[1]), moved(old[2]), moved(old[3])});
    }
    const auto from = leaves.begin() + static_cast<std::ptrdiff_t>(first_leaf[block]);
    leaves_.insert(leaves_.end(), from, from + size.leaves);
  }
  least_ = leaves_.front()[0];
  largest_ = least_;
  for (const CornerValues& values : leaves_)
    for (const double value : values) {
      least_ = std::min(least_, value);
      largest_ = std::max(largest_, value);
    }
}

double SizeQuadtree::value(Vec2 p) const {
  // Block, and place in it, 0..1; the order of the arguments of max sends NaN to the first block.
  double x = std::min(std::max(0.0, (p.x - box_.min.x) * inverse_side_), box_.width() * inverse_side_);
  double y = std::min(std::max(0.0, (p.y - box_.min.y) * inverse_side_), box_.height() * inverse_side_);
  const std::size_t i = std::min(static_cast<std::size_t>(x), nx_ - 1);
  const std::size_t j = std::min(static_cast<std::size_t>(y), ny_ - 1);
  x -= static_cast<double>(i);
  y -= static_cast<double>(j);
  Node node = roots_[j * nx_ + i];
  while (node >= 0) {
    const bool right = x >= 0.5, above = y >= 0.5;
    x = 2 * x - (right ? 1 : 0);
    y = 2 * y - (above ? 1 : 0);
    node = children_[node][(right ? 1 : 0) + (above ? 2 : 0)];
  }
  const CornerValues& v = leaves_[~node];
  const double below = v[0] + x * (v[1] - v[0]), above = v[2] + x * (v[3] - v[2]);
  return below + y * (above - below);
}

std::size_t SizeQuadtree::memory_bytes() const {
  return roots_.capacity() * sizeof(Node) + children_.capacity() * sizeof(Children) +
         leaves_.capacity() * sizeof(CornerValues);
}

} // namespace trime::sizing
