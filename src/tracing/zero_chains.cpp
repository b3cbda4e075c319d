// SPDX-License-Identifier: BSD-3-Clause
#include "tracing/zero_chains.hpp"
#include "tracing/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace trime::tracing {

namespace {

using geometry::Box;
using geometry::length;
using geometry::Vec2;

// [cells] Fine cells that the zero set may meet, at most: it bounds the memory.
constexpr std::size_t most_near_zero = std::size_t{1} << 25;
constexpr double slope_margin = 1.25; // Slopes of a formula are taken so much larger than they were sampled

constexpr int refinement = 1 << TracingRules::grid_levels;

using Key = std::int64_t;

/// A cell, or the node at its lower left corner, of a grid with some number of cells.
struct Index {
  int i, j;
};

class Marcher {
public:
  Marcher(LevelFunction& function, const Box& box, double resolution) : function_(function), box_(box) {
    const double side = std::fmax(box.width(), box.height()), coarse = 0.5 * resolution * refinement;
    coarse_x_ = count(box.width(), coarse);
    coarse_y_ = count(box.height(), coarse);
    width_ = box.width() / (coarse_x_ * refinement);
    height_ = box.height() / (coarse_y_ * refinement);
    tolerance_ = 0x1p-50 * side;
  }

  ZeroChains march() {
    std::vector<Index> cells = all_cells();
    sample(cells, 0);
    measure_slopes();
    for (int level = 1; level <= TracingRules::grid_levels; ++level) {
      cells = candidates(cells, level - 1);
      check_number(cells, level - 1);
      cells = children(cells);
      sample(cells, level);
    }
    function_.build_wall(steepest_, lowest_, std::fmin(width_, height_));
    add_rim(cells);
    add_missing(cells);
    check_signs();
    return {chains(cells), std::fmax(width_, height_)};
  }

private:
  static int count(double side, double cell) {
    return static_cast<int>(std::clamp(std::ceil(side / cell), double{TracingRules::fewest_coarse_cells},
                                       double{TracingRules::most_coarse_cells}));
  }

  // Nodes are those of the fine grid on every level; the ring around the container has index -1 and n + 1.
  int fine_x() const { return coarse_x_ * refinement; }
  int fine_y() const { return coarse_y_ * refinement; }
  Key key(Index node) const { return Key{node.j + 1} * (fine_x() + 4) + (node.i + 1); }
  Index node_of(Key key) const {
    const Key row = fine_x() + 4;
    return {static_cast<int>(key % row) - 1, static_cast<int>(key / row) - 1};
  }
  Vec2 place(Index node) const {
    return {node.i == fine_x() ? box_.max.x : box_.min.x + node.i * width_,
            node.j == fine_y() ? box_.max.y : box_.min.y + node.j * height_};
  }
  bool beyond(Index node) const { return node.i < 0 || node.j < 0 || node.i > fine_x() || node.j > fine_y(); }

  static std::array<Index, 4> corners(Index cell, int level) {
    const int s = refinement >> level;
    const Index low{cell.i * s, cell.j * s};
    return {{low, {low.i + s, low.j}, {low.i + s, low.j + s}, {low.i, low.j + s}}};
  }

  double value(Index node) const {
    if (beyond(node))
      return std::numeric_limits<double>::max(); // behind the wall
    const auto found = std::lower_bound(keys_.begin(), keys_.end(), key(node));
    return values_[static_cast<std::size_t>(found - keys_.begin())];
  }
  std::array<double, 4> corner_values(Index cell, int level) const {
    std::array<double, 4> result;
    const std::array<Index, 4> nodes = corners(cell, level);
    for (int k = 0; k < 4; ++k)
      result[k] = value(nodes[k]);
    return result;
  }

  std::vector<Index> all_cells() const {
    std::vector<Index> cells;
    for (int j = 0; j < coarse_y_; ++j)
      for (int i = 0; i < coarse_x_; ++i)
        cells.push_back({i, j});
    return cells;
  }

  void sample(const std::vector<Index>& cells, int level);
  void measure_slopes();
  std::vector<Index> candidates(const std::vector<Index>& cells, int level) const;
  void check_number(const std::vector<Index>& cells, int level) const;
  static std::vector<Index> children(const std::vector<Index>& cells);
  void add_rim(std::vector<Index>& cells);
  void add_missing(std::vector<Index>& cells);
  void check_signs() const;

  struct Link {
    Key from, to; // crossed edges
  };
  /// The edge from corner k of a cell to the next one: key of its lower left node, twice, plus 1 if it goes up.
  Key edge(Index cell, int k) const {
    const Index low = k == 1 ? Index{cell.i + 1, cell.j} : k == 2 ? Index{cell.i, cell.j + 1} : cell;
    return 2 * key(low) + k % 2;
  }
  void link(Index cell, std::vector<Link>& links) const;
  std::vector<std::vector<Vec2>> chains(const std::vector<Index>& cells) const;

  LevelFunction& function_;
  const Box box_;
  int coarse_x_, coarse_y_;
  double width_, height_, tolerance_; // of a fine cell
  std::vector<Key> keys_;             // sorted
  std::vector<double> values_;
  std::vector<double> slopes_; // of coarse cells and their neighbours, per length
  double steepest_ = 0, lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
  Vec2 lowest_place_, highest_place_;
};

/// Evaluates the corners of the cells that are not known yet.
void Marcher::sample(const std::vector<Index>& cells, int level) {
  std::vector<Key> wanted;
  for (const Index cell : cells)
    for (const Index node : corners(cell, level))
      if (!beyond(node))
        wanted.push_back(key(node));
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<Key> fresh;
  std::set_difference(wanted.begin(), wanted.end(), keys_.begin(), keys_.end(), std::back_inserter(fresh));
  std::vector<double> found(fresh.size());
  function_.for_all(fresh.size(), 64, [&](std::size_t k) { found[k] = function_(place(node_of(fresh[k]))); });
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    if (found[k] < lowest_) {
      lowest_ = found[k];
      lowest_place_ = place(node_of(fresh[k]));
    }
    if (found[k] > highest_) {
      highest_ = found[k];
      highest_place_ = place(node_of(fresh[k]));
    }
  }
  std::vector<Key> keys(keys_.size() + fresh.size());
  std::vector<double> values(keys.size());
  for (std::size_t k = 0, old = 0, next = 0; k < keys.size(); ++k) {
    const bool take_old = next == fresh.size() || (old < keys_.size() && keys_[old] < fresh[next]);
    keys[k] = take_old ? keys_[old] : fresh[next];
    values[k] = take_old ? values_[old++] : found[next++];
  }
  keys_ = std::move(keys);
  values_ = std::move(values);
}

/// Largest slope along the edges of each coarse cell and its eight neighbours.
void Marcher::measure_slopes() {
  std::vector<double> own;
  const double wide = width_ * refinement, high = height_ * refinement;
  for (const Index cell : all_cells()) {
    const std::array<double, 4> v = corner_values(cell, 0);
    own.push_back(std::fmax(std::fmax(std::fabs(v[1] - v[0]), std::fabs(v[2] - v[3])) / wide,
                            std::fmax(std::fabs(v[3] - v[0]), std::fabs(v[2] - v[1])) / high));
    steepest_ = std::fmax(steepest_, own.back());
  }
  slopes_.assign(own.size(), 0);
  for (const Index cell : all_cells())
    for (int j = std::max(0, cell.j - 1); j <= std::min(coarse_y_ - 1, cell.j + 1); ++j)
      for (int i = std::max(0, cell.i - 1); i <= std::min(coarse_x_ - 1, cell.i + 1); ++i) {
        double& slope = slopes_[static_cast<std::size_t>(cell.j) * coarse_x_ + cell.i];
        slope = std::fmax(slope, own[static_cast<std::size_t>(j) * coarse_x_ + i]);
      }
}

/// Cells that the zero set may meet: no zero is farther from the nearest corner than half a diagonal, nor from any
/// corner than a whole one.
std::vector<Index> Marcher::candidates(const std::vector<Index>& cells, int level) const {
  std::vector<Index> result;
  const double diagonal = length({width_ * (refinement >> level), height_ * (refinement >> level)});
  for (const Index cell : cells) {
    const std::array<double, 4> v = corner_values(cell, level);
    const double slope =
        slope_margin *
        slopes_[static_cast<std::size_t>(cell.j >> level) * coarse_x_ + static_cast<std::size_t>(cell.i >> level)];
    double least = std::fabs(v[0]), most = least;
    bool some_inside = false, some_outside = false;
    for (const double at_corner : v) {
      least = std::fmin(least, std::fabs(at_corner));
      most = std::fmax(most, std::fabs(at_corner));
      (at_corner < 0 ? some_inside : some_outside) = true;
    }
    if ((some_inside && some_outside) || (least <= 0.5 * slope * diagonal && most <= slope * diagonal))
      result.push_back(cell);
  }
  return result;
}

void Marcher::check_number(const std::vector<Index>& cells, int level) const {
  const std::size_t most = most_near_zero >> (2 * (TracingRules::grid_levels - level));
  if (cells.size() <= most)
    return;
  const Vec2 p = place(corners(cells[most], level)[0]);
  throw GeometryError(fmt::format("part '{}': the function oscillates below the resolution of {:.3g} near ({:.9g}, "
                                  "{:.9g}): {} cells of that size may hold zeros, expected at most {}; leave out the "
                                  "details that are smaller, or use a coarser resolution",
                                  function_.name(), 2 * std::fmax(width_, height_), p.x, p.y,
                                  cells.size() << (2 * (TracingRules::grid_levels - level)), most_near_zero));
}

std::vector<Index> Marcher::children(const std::vector<Index>& cells) {
  std::vector<Index> result;
  for (const Index cell : cells)
    for (const Index child : {Index{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      result.push_back({2 * cell.i + child.i, 2 * cell.j + child.j});
  return result;
}

/// The ring of cells around the container.
void Marcher::add_rim(std::vector<Index>& cells) {
  const int nx = fine_x(), ny = fine_y();
  for (int i = -1; i <= nx; ++i)
    for (const int j : {-1, ny})
      cells.push_back({i, j});
  for (int j = 0; j < ny; ++j)
    for (const int i : {-1, nx})
      cells.push_back({i, j});
  sample(cells, TracingRules::grid_levels);
}

/// Follows the curves into cells that were not looked at, until every crossed edge has both its cells. Sorts the cells.
void Marcher::add_missing(std::vector<Index>& cells) {
  const auto by_key = [this](Index a, Index b) { return key(a) < key(b); };
  std::sort(cells.begin(), cells.end(), by_key);
  std::vector<Index> fresh = cells;
  while (!fresh.empty()) {
    std::vector<Index> missing;
    for (const Index cell : fresh) {
      const std::array<double, 4> v = corner_values(cell, TracingRules::grid_levels);
      const std::array<Index, 4> neighbours{
          {{cell.i, cell.j - 1}, {cell.i + 1, cell.j}, {cell.i, cell.j + 1}, {cell.i - 1, cell.j}}};
      for (int k = 0; k < 4; ++k)
        if ((v[k] < 0) != (v[(k + 1) % 4] < 0) &&
            !std::binary_search(cells.begin(), cells.end(), neighbours[k], by_key))
          missing.push_back(neighbours[k]);
    }
    std::sort(missing.begin(), missing.end(), by_key);
    missing.erase(
        std::unique(missing.begin(), missing.end(), [](Index a, Index b) { return a.i == b.i && a.j == b.j; }),
        missing.end());
    sample(missing, TracingRules::grid_levels);
    std::vector<Index> all;
    std::merge(cells.begin(), cells.end(), missing.begin(), missing.end(), std::back_inserter(all), by_key);
    cells = std::move(all);
    fresh = std::move(missing);
  }
}

void Marcher::check_signs() const {
  if (lowest_ >= 0)
    throw GeometryError(fmt::format("part '{}': the function is negative nowhere in the container, so nothing lies "
                                    "inside; its smallest value is {:.6g}, at ({:.9g}, {:.9g}); is the sign reversed, "
                                    "the part narrower than {:.2g}, or outside of the container [{:.9g}, {:.9g}] x "
                                    "[{:.9g}, {:.9g}]?",
                                    function_.name(), lowest_, lowest_place_.x, lowest_place_.y, 2 * width_, box_.min.x,
                                    box_.max.x, box_.min.y, box_.max.y));
  if (highest_ < 0)
    throw GeometryError(fmt::format("part '{}': the function is negative in the whole container, so it has no "
                                    "boundary; its largest value is {:.6g}, at ({:.9g}, {:.9g}); for the whole "
                                    "container use 'domain'",
                                    function_.name(), highest_, highest_place_.x, highest_place_.y));
}

/// Around a cell, the curve enters where the sign goes from inside to outside and leaves where it comes back. Where
/// that happens twice, the middle decides whether the two corners inside are joined.
void Marcher::link(Index cell, std::vector<Link>& links) const {
  const std::array<Index, 4> nodes = corners(cell, TracingRules::grid_levels);
  std::array<bool, 4> in;
  int entries = 0;
  for (int k = 0; k < 4; ++k)
    in[k] = value(nodes[k]) < 0;
  for (int k = 0; k < 4; ++k)
    entries += in[k] && !in[(k + 1) % 4] ? 1 : 0;
  const bool joined = entries == 2 && function_.inside(0.5 * (place(nodes[0]) + place(nodes[2])));
  for (int k = 0; k < 4; ++k) {
    if (!in[k] || in[(k + 1) % 4])
      continue;
    int out = (k + 1) % 4;
    while (in[out] || !in[(out + 1) % 4])
      out = (out + 1) % 4;
    if (entries == 2 && !joined)
      out = (k + 3) % 4;
    links.push_back({edge(cell, k), edge(cell, out)});
  }
}

std::vector<std::vector<Vec2>> Marcher::chains(const std::vector<Index>& cells) const {
  std::vector<std::vector<Link>> parts((cells.size() + 255) / 256);
  function_.for_all(parts.size(), 1, [&](std::size_t part) {
    for (std::size_t k = 256 * part; k < std::min(cells.size(), 256 * (part + 1)); ++k)
      link(cells[k], parts[part]);
  });
  std::vector<Link> links;
  for (const std::vector<Link>& part : parts)
    links.insert(links.end(), part.begin(), part.end());
  const auto by_start = [](const Link& a, const Link& b) { return a.from < b.from; };
  std::sort(links.begin(), links.end(), by_start);

  std::vector<Vec2> vertices(links.size());
  function_.for_all(links.size(), 16, [&](std::size_t k) {
    const Index a = node_of(links[k].from / 2), b = links[k].from % 2 == 0 ? Index{a.i + 1, a.j} : Index{a.i, a.j + 1};
    vertices[k] = function_.crossing(place(a), value(a), place(b), value(b), tolerance_);
  });
  std::vector<std::vector<Vec2>> result;
  std::vector<bool> used(links.size(), false);
  for (std::size_t first = 0; first < links.size(); ++first) {
    if (used[first])
      continue;
    result.emplace_back();
    for (std::size_t k = first; !used[k];) {
      used[k] = true;
      result.back().push_back(vertices[k]);
      const auto next = std::lower_bound(links.begin(), links.end(), Link{links[k].to, 0}, by_start);
      k = static_cast<std::size_t>(next - links.begin());
    }
  }
  return result;
}

} // namespace

double finest_resolution(double side) {
  return 2 * side / (TracingRules::most_coarse_cells * refinement);
}

ZeroChains march(LevelFunction& function, const Box& container, double resolution) {
  return Marcher(function, container, resolution).march();
}

} // namespace trime::tracing
