// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_cells.hpp"

#include "cones/rules.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace trime::cones {

using geometry::Box;
using geometry::Vec2;

namespace {

// [cones] Number of cones in a block of cells, about. Cells are split from blocks.
constexpr double cones_per_block = 4;
constexpr double most_blocks_along = 128; // [blocks] Largest number along a side: it bounds the memory
// [cones] A cell with so few is not split. Cells and this together: a look-up took 60 ns instead of 330.
constexpr std::size_t enough = 12;
// [size] A cell is not split if its side is less than this number times the envelope: there are few look-ups in one
// cell.
constexpr double smallest_cell = 2;
// Cells reach so far around the apexes, as a share of the longer side of their box: beyond, the tree is asked.
constexpr double margin = 0.1;

constexpr double rounding = 1e-12; // of the extent and of values

/// The last one stands twice if their number is odd.
void append_pairs(std::span<const Cone> cones, std::vector<double>& numbers) {
  for (std::size_t k = 0; k < cones.size(); k += 2) {
    const Cone &a = cones[k], &b = cones[std::min(k + 1, cones.size() - 1)];
    numbers.insert(numbers.end(), {a.apex.x, b.apex.x, a.apex.y, b.apex.y, a.height, b.height});
  }
}

} // namespace

/// Builds blocks: every cell passes on to its quarters only those cones that can be the lowest somewhere in it.
class ConeCells::Builder {
public:
  Builder(const ConeTree& tree, double slope, const CellGrid& grid) : tree_(tree), slope_(slope), grid_(grid) {}

  Part build(std::int64_t column, std::int64_t row) {
    part_ = {};
    const CellPlace block{0, column, row};
    const Vec2 middle = middle_of(block);
    List& list = lists_[0];
    list.lowest = tree_.value(middle);
    found_.clear();
    tree_.collect(middle, limit(list.lowest, block), found_);
    list.reserve(found_.size());
    for (const LocalIndex k : found_) {
      const Cone& cone = tree_.cones()[static_cast<std::size_t>(k)];
      list.add(cone.apex.x, cone.apex.y, cone.height);
    }
    list.finish();
    part_.root = build(block);
    return std::move(part_);
  }

private:
  /// Pairs of cones, the last one with a cone that is never the lowest if their number is odd.
  struct List {
    std::vector<double> numbers, values;
    std::size_t count = 0;
    double lowest = 0; ///< of the values in the middle of the cell

    std::size_t pairs() const { return (count + 1) / 2; }
    void reserve(std::size_t cones) { // one more is written than is kept
      count = 0;
      if (values.size() < cones + 2) {
        numbers.resize(ConePair::numbers * (cones + 2));
        values.resize(2 * (cones + 2));
      }
    }
    double* at(std::size_t k) { return &numbers[ConePair::numbers * (k / 2) + k % 2]; }
    void add(double x, double y, double height, bool keep = true) {
      double* const cone = at(count);
      cone[0] = x;
      cone[2] = y;
      cone[4] = height;
      count += keep ? 1 : 0;
    }
    void finish() {
      if (count % 2 != 0) {
        const double* const last = at(count - 1);
        double* const none = at(count);
        none[0] = last[0];
        none[2] = last[2];
        none[4] = std::numeric_limits<double>::infinity();
      }
    }
  };

  Vec2 middle_of(const CellPlace& place) const {
    return grid_.corner(place) + 0.5 * grid_.side_at(place.level) * Vec2{1, 1};
  }
  /// A cone that is higher than this in the middle of a cell is never the lowest in it, if that is `lowest` there.
  double limit(double lowest, const CellPlace& place) const {
    const double reach = half_sqrt_2 * grid_.side_at(place.level) + rounding * grid_.side * most_blocks_along;
    return (lowest + 2 * slope_ * reach) * (1 + rounding);
  }

  CellNode build(const CellPlace& place) {
    const List& list = lists_[static_cast<std::size_t>(place.level)];
    if (list.count <= enough || place.level == most_levels ||
        grid_.side_at(place.level) <= smallest_cell * list.lowest || is_hopeless(place.level))
      return leaf(list);
    const std::size_t node = part_.quarters.size();
    part_.quarters.emplace_back();
    for (int k = 0; k < 4; ++k) {
      pass_on(place.quarter(k));
      part_.quarters[node][static_cast<std::size_t>(k)] = build(place.quarter(k));
    }
    return static_cast<CellNode>(node);
  }

  /// If cones lie together, or no cone is lower than another, no cell separates them, since two levels did not.
  bool is_hopeless(int level) const {
    const auto of = static_cast<std::size_t>(level);
    return level >= 2 && lists_[of].count == lists_[of - 2].count;
  }

  /// Makes the list of a cell from that of the larger one around it.
  void pass_on(const CellPlace& place) {
    List &from = lists_[static_cast<std::size_t>(place.level) - 1], &to = lists_[static_cast<std::size_t>(place.level)];
    to.reserve(from.count);
    const Vec2 middle = middle_of(place);
    const ConePair::Lanes x{middle.x, middle.x}, y{middle.y, middle.y};
    ConePair::Lanes low = ConePair::Lanes{} + std::numeric_limits<double>::infinity();
    for (std::size_t pair = 0; pair < from.pairs(); ++pair) {
      const ConePair::Lanes values = ConePair::values(&from.numbers[ConePair::numbers * pair], x, y, slope_);
      std::memcpy(&from.values[2 * pair], &values, sizeof values);
      low = lanes::smaller(values, low);
    }
    to.lowest = std::min(low[0], low[1]);
    const double highest = limit(to.lowest, place);
    for (std::size_t k = 0; k < from.count; ++k) {
      const double* const cone = from.at(k);
      to.add(cone[0], cone[2], cone[4], from.values[k] <= highest);
    }
    to.finish();
  }

  CellNode leaf(const List& list) {
    if (list.count == 0 || list.count > ConeRules::most_in_leaf)
      return CellLeaf::bilinear(0).node(); // stands for the tree
    const std::size_t first = part_.numbers.size();
    part_.numbers.insert(part_.numbers.end(), list.numbers.begin(),
                         list.numbers.begin() + static_cast<std::ptrdiff_t>(ConePair::numbers * list.pairs()));
    return CellLeaf::with_pairs(first, list.pairs()).node();
  }

  const ConeTree& tree_;
  double slope_;
  const CellGrid& grid_;
  std::array<List, most_levels + 1> lists_; // of the cells that are being built
  std::vector<LocalIndex> found_;
  Part part_;
};

ConeCells::ConeCells(const ConeTree& tree, double slope) : tree_(tree), slope_(slope) {
  static_assert(ConeRules::most_in_leaf <= CellLeaf::most_cones);
  const std::size_t count = tree.cones().size();
  if (count == 0 || count > most_cones)
    return;
  if (count <= few_cones) {
    few_ = true;
    append_pairs(tree.cones(), numbers_);
    return;
  }
  Box box;
  for (const Cone& cone : tree.cones())
    box.include(cone.apex);
  const double longer = std::max(box.width(), box.height());
  if (!(longer > 1e-300))
    return; // the tree is as fast
  const Vec2 around{margin * longer, margin * longer};
  box = {box.min - around, box.max + around};
  const double blocks =
      std::clamp(static_cast<double>(count) / cones_per_block, 1.0, most_blocks_along * most_blocks_along);
  grid_.origin = box.min;
  grid_.side =
      std::max(std::sqrt(box.width() * box.height() / blocks), std::max(box.width(), box.height()) / most_blocks_along);
  inverse_side_ = 1 / grid_.side;
  columns_ = static_cast<int>(std::ceil(box.width() * inverse_side_));
  rows_ = static_cast<int>(std::ceil(box.height() * inverse_side_));
  std::vector<Part> parts(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  PerThread<Builder> builders(tree_, slope_, grid_);
  thread_loop(std::ssize(parts), 8, [&](std::ptrdiff_t k, int thread) {
    parts[static_cast<std::size_t>(k)] = builders[thread].build(k % columns_, k / columns_);
  });
  assemble(parts);
}

void ConeCells::assemble(const std::vector<Part>& parts) {
  std::size_t quarters = 0, numbers = 0;
  for (const Part& part : parts) {
    quarters += part.quarters.size();
    numbers += part.numbers.size();
  }
  if (numbers > CellLeaf::most_numbers || quarters > CellLeaf::most_numbers) {
    columns_ = rows_ = 0; // the tree is asked
    return;
  }
  roots_.reserve(parts.size());
  quarters_.reserve(quarters);
  numbers_.reserve(numbers);
  for (const Part& part : parts) {
    const std::size_t first_quarters = quarters_.size(), first_number = numbers_.size();
    const auto moved = [&](CellNode node) {
      if (node >= 0)
        return node + static_cast<CellNode>(first_quarters);
      CellLeaf leaf = CellLeaf::of(node);
      leaf.first += leaf.is_bilinear() ? 0 : first_number;
      return leaf.node();
    };
    roots_.push_back(moved(part.root));
    for (const Quarters& of_part : part.quarters)
      quarters_.push_back({moved(of_part[0]), moved(of_part[1]), moved(of_part[2]), moved(of_part[3])});
    numbers_.insert(numbers_.end(), part.numbers.begin(), part.numbers.end());
  }
}

} // namespace trime::cones
