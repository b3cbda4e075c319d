// SPDX-License-Identifier: BSD-3-Clause
// Evaluates the lower envelope of a few thousand cones K |x - b| + c very often. A quadtree is built whose leaves list
// the cones that can be lowest somewhere in them.
#pragma once

#include "cones/cone_tree.hpp"
#include "cones/size_cells.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime::cones {

/// @brief Gives exactly the same values as the ConeTree. Points outside the quadtree, and small cells where many cones
/// can be lowest, are searched in the ConeTree itself. Immutable; queries are thread-safe.
class ConeCells {
public:
  /// Largest number of cones for which the quadtree is built. The quadtree takes about 1 KiB per cone, and more where
  /// cones lie close together.
  static constexpr std::size_t most_cones = std::size_t{1} << 15;

  /// With this number of cones or fewer, no quadtree is built.
  static constexpr std::size_t few_cones = 8;

  /// Builds the quadtree in about O(n log n) time for n cones, by all threads.
  /// @pre `tree` outlives this object and was made for the same slope
  ConeCells(const ConeTree& tree, double slope);

  /// Returns the smallest of `bound` and the values of all cones at p.
  double value(geometry::Vec2 p, double bound) const {
    const double x = (p.x - grid_.origin.x) * inverse_side_, y = (p.y - grid_.origin.y) * inverse_side_;
    if (!(x >= 0 && y >= 0 && x < columns_ && y < rows_))
      return few_ ? lowest_cone(numbers_.data(), numbers_.size() / ConePair::numbers, p, slope_, bound)
                  : tree_.value(p, bound);
    const auto column = static_cast<std::uint32_t>(x * finest), row = static_cast<std::uint32_t>(y * finest);
    int shift = most_levels;
    CellNode node = roots_[(row >> shift) * static_cast<std::uint32_t>(columns_) + (column >> shift)];
    while (node >= 0) {
      --shift;
      node = quarters_[static_cast<std::size_t>(node)][(column >> shift & 1) + 2 * (row >> shift & 1)];
    }
    const CellLeaf leaf = CellLeaf::of(node);
    return leaf.is_bilinear() ? tree_.value(p, bound)
                              : lowest_cone(&numbers_[leaf.first], leaf.pairs(), p, slope_, bound);
  }
  std::size_t memory_bytes() const {
    return roots_.capacity() * sizeof(CellNode) + quarters_.capacity() * sizeof(Quarters) +
           numbers_.capacity() * sizeof(double);
  }

private:
  static constexpr int most_levels = 8; ///< largest number of levels of the quadtree below a block
  static constexpr double finest = 1 << most_levels;
  using Quarters = std::array<CellNode, 4>;
  /// A block of the quadtree with the cells below it. Indices in a part count from 0.
  struct Part {
    CellNode root;
    std::vector<Quarters> quarters;
    std::vector<double> numbers;
  };
  class Builder;
  void assemble(const std::vector<Part>& parts);

  const ConeTree& tree_;
  double slope_;
  CellGrid grid_{};
  double inverse_side_ = 1; ///< 1 / side of a block
  int columns_ = 0, rows_ = 0;
  bool few_ = false;            ///< true if every query examines all cones
  std::vector<CellNode> roots_; ///< root nodes of the blocks, row by row
  std::vector<Quarters> quarters_;
  std::vector<double> numbers_; ///< the pairs of cones of all leaves
};

} // namespace trime::cones
