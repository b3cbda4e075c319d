// SPDX-License-Identifier: BSD-3-Clause
#include "cones/size_quadtree.hpp"

#include "comm/agree.hpp"
#include "comm/parcel.hpp"

#include <algorithm>
#include <cmath>

namespace trime::cones {

using geometry::Vec2;

namespace {

/// A node of one group of blocks as a node among all.
CellNode moved(CellNode node, std::size_t first_child, std::size_t first_number) {
  if (node >= 0)
    return node + static_cast<CellNode>(first_child);
  CellLeaf leaf = CellLeaf::of(node);
  leaf.first += first_number;
  return leaf.node();
}

std::size_t groups_of(std::size_t blocks, int level) {
  const std::size_t along = std::size_t{1} << -level;
  return (blocks + along - 1) / along;
}

} // namespace

SizeQuadtree::SizeQuadtree(const comm::Communicator& comm, const Source& source)
    : box_(source.box), slope_(source.slope), cap_(source.cap) {
  static_assert(most_levels % 2 == 0,
                "the number of levels must be even, because a look-up goes down two levels at once");
  static_assert(most_cones <= CellLeaf::most_cones && most_cones <= ConeChoice::most);
  grid_ = {box_.min, std::max(box_.width(), box_.height()) / blocks_along};
  inverse_side_ = 1 / grid_.side;
  nx_ = static_cast<std::size_t>(std::clamp(std::ceil(box_.width() * inverse_side_), 1.0, 1.0 * blocks_along));
  ny_ = static_cast<std::size_t>(std::clamp(std::ceil(box_.height() * inverse_side_), 1.0, 1.0 * blocks_along));
  groups_x_ = groups_of(nx_, group_level);
  groups_y_ = groups_of(ny_, group_level);
  const auto ranks = static_cast<std::size_t>(comm.size()), rank = static_cast<std::size_t>(comm.rank());
  std::vector<CellPart> mine;
  comm::run_agreed(comm, [&] {
    const std::size_t count = groups_x_ * groups_y_;
    mine.resize(rank < count ? (count - rank - 1) / ranks + 1 : 0);
    const CellBuilder::Limits limits{tolerance, most_levels, most_cones, highest_corner(source)};
    PerThread<CellBuilder> builders(source, grid_, limits);
    thread_loop(static_cast<std::ptrdiff_t>(mine.size()), 1, [&](std::ptrdiff_t k, int thread) {
      const std::size_t group = rank + static_cast<std::size_t>(k) * ranks;
      mine[k] =
          builders[thread].build(group_place(group), static_cast<std::int64_t>(nx_), static_cast<std::int64_t>(ny_));
    });
  });
  assemble(comm, std::move(mine));
}

CellPlace SizeQuadtree::group_place(std::size_t group) const {
  return {group_level, static_cast<std::int64_t>(group % groups_x_), static_cast<std::int64_t>(group / groups_x_)};
}

/// No corner of a group is higher.
double SizeQuadtree::highest_corner(const Source& source) const {
  const std::size_t along = std::size_t{1} << -group_level;
  double highest = 0;
  for (std::size_t j = 0; j <= groups_y_; ++j)
    for (std::size_t i = 0; i <= groups_x_; ++i) {
      const Vec2 corner = grid_.corner({0, static_cast<std::int64_t>(std::min(along * i, nx_)),
                                        static_cast<std::int64_t>(std::min(along * j, ny_))});
      highest = std::max(highest, source.cones.value(corner, source.cap));
    }
  return highest;
}

/// The arrays are the same on any number of ranks: groups follow one after the other.
void SizeQuadtree::assemble(const comm::Communicator& comm, std::vector<CellPart> mine) {
  const std::vector<CellPart> parts = comm.size() == 1 ? std::move(mine) : gather_parts(comm, std::move(mine));
  std::size_t child_count = 0, number_count = 0;
  for (const CellPart& part : parts) {
    child_count += part.children.size();
    number_count += part.numbers.size();
  }
  if (number_count >= CellLeaf::most_numbers)
    throw InternalError(
        fmt::format("the size field needs {} numbers; {} are possible", number_count, CellLeaf::most_numbers));
  const std::size_t along = std::size_t{1} << -group_level;
  roots_.resize(nx_ * ny_);
  children_.reserve(child_count);
  numbers_.reserve(number_count);
  for (std::size_t group = 0; group < parts.size(); ++group) {
    const CellPart& part = parts[group];
    const std::size_t child = children_.size(), number = numbers_.size();
    const std::size_t i = along * (group % groups_x_), j = along * (group / groups_x_);
    const std::size_t columns = std::min(along, nx_ - i);
    for (std::size_t k = 0; k < part.roots.size(); ++k)
      roots_[(j + k / columns) * nx_ + i + k % columns] = moved(part.roots[k], child, number);
    for (const CellChildren& children : part.children) {
      children_.push_back(children);
      for (CellNode& node : children_.back())
        node = moved(node, child, number);
    }
    numbers_.insert(numbers_.end(), part.numbers.begin(), part.numbers.end());
    least_ = std::min(least_, part.least);
    largest_ = std::max(largest_, part.largest);
  }
}

/// Gathers the parts of all ranks, by group, on every rank. Collective.
std::vector<CellPart> SizeQuadtree::gather_parts(const comm::Communicator& comm, std::vector<CellPart> mine) const {
  comm::Parcel own;
  for (CellPart& part : mine) {
    own.add(part.roots);
    own.add(part.children);
    own.add(part.numbers);
    own.add(std::vector{part.least, part.largest});
    part = {};
  }
  comm::Parcel all(comm.all_gather(own.release()));
  std::vector<CellPart> parts(groups_x_ * groups_y_);
  for (std::size_t rank = 0; rank < static_cast<std::size_t>(comm.size()); ++rank)
    for (std::size_t group = rank; group < parts.size(); group += static_cast<std::size_t>(comm.size())) {
      CellPart& part = parts[group];
      part.roots = all.take<CellNode>();
      part.children = all.take<CellChildren>();
      part.numbers = all.take<double>();
      const std::vector<double> range = all.take<double>();
      part.least = range.at(0);
      part.largest = range.at(1);
    }
  return parts;
}

double SizeQuadtree::value(Vec2 p) const {
  // The order of the arguments of max sends NaN to the first block.
  const Vec2 q{std::min(std::max(box_.min.x, p.x), box_.max.x), std::min(std::max(box_.min.y, p.y), box_.max.y)};
  constexpr double finest = 1 << most_levels; // cells along a block
  const double x = (q.x - box_.min.x) * inverse_side_, y = (q.y - box_.min.y) * inverse_side_;
  const auto column =
      std::min(static_cast<std::uint32_t>(x * finest), (static_cast<std::uint32_t>(nx_) << most_levels) - 1);
  const auto row =
      std::min(static_cast<std::uint32_t>(y * finest), (static_cast<std::uint32_t>(ny_) << most_levels) - 1);
  int shift = most_levels;
  CellNode node = roots_[(row >> shift) * nx_ + (column >> shift)];
  while (node >= 0) {
    shift -= 2;
    node = children_[node][(column >> shift & 3) + 4 * (row >> shift & 3)];
  }
  const CellLeaf leaf = CellLeaf::of(node);
  if (!leaf.is_bilinear())
    return cones_value(leaf, q);
  shift += leaf.levels_up();
  const double along = static_cast<double>(1 << (most_levels - shift)); // cells of this level along a block
  const double* const v = &numbers_[leaf.first];
  const double s = x * along - static_cast<double>(column >> shift), t = y * along - static_cast<double>(row >> shift);
  const double below = v[0] + s * (v[1] - v[0]), above = v[2] + s * (v[3] - v[2]);
  return below + t * (above - below);
}

std::size_t SizeQuadtree::memory_bytes() const {
  return roots_.capacity() * sizeof(CellNode) + children_.capacity() * sizeof(CellChildren) +
         numbers_.capacity() * sizeof(double);
}

} // namespace trime::cones
