// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/steep_sizes.hpp"

#include "cones/cone_tree.hpp"
#include "core/angle.hpp"
#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "sizing/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace trime::sizing {
namespace {

using cones::Cone;
using cones::ConeTree;
using geometry::Vec2;
using Rules = SizingRules;

constexpr double huge = std::numeric_limits<double>::infinity();
constexpr double diagonal = 0.70710678118654752;
constexpr std::array<Vec2, 8> directions{{{1, 0},
                                          {diagonal, diagonal},
                                          {0, 1},
                                          {-diagonal, diagonal},
                                          {-1, 0},
                                          {-diagonal, -diagonal},
                                          {0, -1},
                                          {diagonal, -diagonal}}};

// [rad] Largest turn between two points that replace an arc in the test of what lies inside.
constexpr double arc_step = pi / 64;

/// The chords of the boundary, with arcs replaced by polygons.
std::vector<geometry::Segment> chords_of(const geometry::Boundary& boundary, const geometry::Lattice& lattice) {
  std::vector<geometry::Segment> chords;
  for (const geometry::Loop& loop : boundary.loops) {
    std::vector<Vec2> vertices;
    for (const geometry::Piece& piece : loop.pieces) {
      const int parts = piece.circular ? static_cast<int>(std::ceil(std::fabs(piece.sweep) / arc_step)) : 1;
      for (int part = 0; part < parts; ++part)
        vertices.push_back(lattice.snap(piece.point(piece.length() * part / parts)));
    }
    for (std::size_t k = 0; k < vertices.size(); ++k)
      chords.push_back({vertices[k], k + 1 < vertices.size() ? vertices[k + 1] : vertices[0] + loop.winding});
  }
  return chords;
}

} // namespace

/// A sample from which the size grows too fast towards a neighbouring sample.
struct SteepSizes::Seed {
  Vec2 low, high;
  double size;  // at `low`
  double slope; // of the size between both places
};

/// The places that were found so far, and the size that they allow.
class SteepSizes::Front {
public:
  Front(SteepSizes& owner, const ScaledSize& asked, double gradation)
      : owner_(owner), asked_(asked), gradation_(gradation) {}

  /// Follows the front from a seed, unless the places that were found cover it. @pre seeds come with ascending sizes
  void follow(const Seed& seed);
  std::vector<SizeLimit> take() { return std::move(found_); }
  bool is_full() const { return found_.size() >= Rules::most_steep_places; }

private:
  double size(Vec2 p) {
    const double h = asked_.size(owner_.boundary_.periods.wrap(p));
    return is_valid_size(h) && owner_.inside(p) ? h : huge;
  }
  double allowed(Vec2 p, double h) const;
  bool adds(Vec2 p, double h) const {
    return h < allowed(p, h) - Rules::front_gain * gradation_ * Rules::front_step * h;
  }
  void descend(Vec2& p, double& h, double step);
  void approach(Vec2& p, double& h, Vec2 high);
  bool settle(Vec2& p, double& h);
  void add(Vec2 p, double h);
  void flood();
  void renew_tree();

  /// The cell of a place in the grid of a level, whose cells are 2^level wide.
  using Key = std::tuple<int, std::int64_t, std::int64_t>;
  static Key key_of(Vec2 p, int level, int dx = 0, int dy = 0) {
    return {level, static_cast<std::int64_t>(std::floor(std::ldexp(p.x, -level))) + dx,
            static_cast<std::int64_t>(std::floor(std::ldexp(p.y, -level))) + dy};
  }
  static int level_of(double h) { return std::ilogb(h); }

  SteepSizes& owner_;
  const ScaledSize& asked_;
  double gradation_;
  std::vector<SizeLimit> found_;
  std::size_t followed_ = 0;                       // number of places from which the front was followed
  std::map<Key, std::vector<std::size_t>> nearby_; // indices into found_, by the cell at the level of their size
  std::set<Key> visited_;                          // cells in which the front was looked for
  ConeTree tree_;                                  // of the first places
  std::size_t in_tree_ = 0;                        // their number
};

/// The size at p that the places allow: all of the tree, and those nearby.
double SteepSizes::Front::allowed(Vec2 p, double h) const {
  double least = in_tree_ > 0 ? tree_.value(owner_.boundary_.periods.wrap(p)) : huge;
  for (int level = level_of(h) - 1; level <= level_of(h) + 1; ++level)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto cell = nearby_.find(key_of(p, level, dx, dy));
        if (cell == nearby_.end())
          continue;
        for (const std::size_t k : cell->second)
          least = std::fmin(least, found_[k].size + gradation_ * geometry::length(p - found_[k].place));
      }
  return least;
}

/// Moves to smaller sizes, as long as the size falls faster than it may.
void SteepSizes::Front::descend(Vec2& p, double& h, double step) {
  for (int round = 0; round < Rules::descent_rounds && step > Rules::front_precision * h; ++round) {
    Vec2 best = p;
    double least = h - gradation_ * step;
    for (const Vec2 direction : directions)
      if (const Vec2 q = p + step * direction; size(q) < least) {
        best = q;
        least = size(q);
      }
    if (best == p) {
      step *= 0.5;
      continue;
    }
    p = best;
    h = least;
  }
}

/// Moves towards a place where the size is too large, up to where the steep part begins.
void SteepSizes::Front::approach(Vec2& p, double& h, Vec2 high) {
  Vec2 low = p;
  double low_size = h;
  for (int round = 0; round < Rules::descent_rounds && geometry::length(high - low) > Rules::front_precision * h;
       ++round) {
    const Vec2 middle = 0.5 * (low + high);
    const double at_middle = size(middle);
    if (at_middle <= h + gradation_ * geometry::length(middle - p)) {
      low = middle;
      low_size = at_middle;
    } else {
      high = middle;
    }
  }
  p = low;
  h = low_size;
}

/// Moves a place near the front to it. Returns false if no steep part begins there.
bool SteepSizes::Front::settle(Vec2& p, double& h) {
  const double reach = Rules::front_step * h;
  descend(p, h, 0.5 * reach);
  double steepest = h + (1 + Rules::gentle_excess) * gradation_ * reach;
  std::optional<Vec2> high;
  for (const Vec2 direction : directions)
    if (const Vec2 q = p + reach * direction; size(q) < huge && size(q) > steepest) {
      steepest = size(q);
      high = q;
    }
  if (!high)
    return false;
  approach(p, h, *high);
  return true;
}

void SteepSizes::Front::add(Vec2 p, double h) {
  const Vec2 place = owner_.boundary_.periods.wrap(p);
  nearby_[key_of(place, level_of(h))].push_back(found_.size());
  found_.push_back({place, h});
}

void SteepSizes::Front::renew_tree() {
  if (found_.size() == in_tree_)
    return;
  tree_ = ConeTree(limiting_cones(found_, owner_.boundary_.periods), gradation_);
  in_tree_ = found_.size();
}

void SteepSizes::Front::flood() {
  for (; followed_ < found_.size() && !is_full(); ++followed_) {
    if (found_.size() > 2 * in_tree_ + Rules::few_steep_places)
      renew_tree();
    const SizeLimit from = found_[followed_];
    const double reach = Rules::front_step * from.size;
    for (const Vec2 direction : directions) {
      Vec2 p = from.place + reach * direction;
      if (!visited_.insert(key_of(p, level_of(0.5 * reach))).second)
        continue;
      double h = size(p);
      if (h < huge && settle(p, h) && adds(p, h))
        add(p, h);
    }
  }
}

void SteepSizes::Front::follow(const Seed& seed) {
  if (is_full() || seed.size > allowed(seed.low, seed.size) * (1 - Rules::covered_error))
    return;
  Vec2 p = seed.low;
  double h = seed.size;
  if (!owner_.inside(p))
    return;
  descend(p, h, 0.5 * geometry::length(seed.high - seed.low));
  if (p == seed.low)
    approach(p, h, seed.high);
  if (!adds(p, h))
    return;
  add(p, h);
  flood();
  renew_tree();
}

SteepSizes::SteepSizes(const SizeField& relative, const geometry::Boundary& boundary, const geometry::Lattice& lattice,
                       double samples)
    : relative_(relative), boundary_(boundary), lattice_(lattice) {
  geometry::Box box = boundary.bounding_box();
  const geometry::Periods& periods = boundary.periods;
  if (periods.x > 0)
    box = {{periods.min.x, box.min.y}, {periods.min.x + periods.x, box.max.y}};
  if (periods.y > 0)
    box = {{box.min.x, periods.min.y}, {box.max.x, periods.min.y + periods.y}};
  const double side = std::sqrt(box.width() * box.height() / std::fmin(samples, Rules::most_steep_samples));
  const auto cells = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / side)), Rules::least_steep_cells, Rules::most_steep_cells);
  };
  columns_ = cells(box.width());
  rows_ = cells(box.height());
  const Vec2 stride{box.width() / columns_, box.height() / rows_};
  samples_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  thread_loop(rows_, 1, [&](std::ptrdiff_t j, int) {
    for (int i = 0; i < columns_; ++i) {
      const auto k = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
      const auto random = [&](std::uint64_t slot) { return random_unit(0, RandomPurpose::size_sample, k, slot); };
      const Vec2 p{box.min.x + stride.x * (i + random(0)), box.min.y + stride.y * (static_cast<double>(j) + random(1))};
      samples_[k] = {p, relative.size(periods.wrap(p))};
    }
  });
}

/// The lower samples of steep pairs of neighbours, with the steepest partner of each.
std::vector<SteepSizes::Seed> SteepSizes::seeds(const ScaledSize& asked, double gradation) const {
  const auto look_at = [&](int i, int j, std::vector<Seed>& list) {
    const auto at = [&](int column, int row) {
      return samples_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
    };
    const Sample low = at(i, j);
    if (!is_valid_size(low.relative))
      return;
    const double h = asked.scaled(low.relative);
    Seed seed{low.place, {}, h, (1 + Rules::gentle_excess) * gradation};
    bool found = false;
    for (int row = std::max(0, j - 1); row <= std::min(rows_ - 1, j + 1); ++row)
      for (int column = std::max(0, i - 1); column <= std::min(columns_ - 1, i + 1); ++column) {
        const Sample high = at(column, row);
        if (!(high.relative > low.relative) || !is_valid_size(high.relative))
          continue;
        const double slope = (asked.scaled(high.relative) - h) / geometry::length(high.place - low.place);
        if (slope > seed.slope) {
          seed.high = high.place;
          seed.slope = slope;
          found = true;
        }
      }
    if (found)
      list.push_back(seed);
  };
  return gather_in_order<Seed>(rows_, 1, [&](std::ptrdiff_t j, std::vector<Seed>& list) {
    for (int i = 0; i < columns_; ++i)
      look_at(i, static_cast<int>(j), list);
  });
}

bool SteepSizes::inside(Vec2 p) {
  if (boundary_.loops.empty())
    return boundary_.covers_torus;
  if (boundary_.periods.any())
    return true; // of loops that wind around the container, no segment grid knows what lies inside
  if (!segments_)
    segments_.emplace(chords_of(boundary_, lattice_));
  return segments_->inside(lattice_.snap(p));
}

SteepSizes::Limits SteepSizes::limits(const ScaledSize& asked, double gradation) {
  std::vector<Seed> found = seeds(asked, gradation);
  Limits result;
  if (found.empty())
    return result;
  std::erase_if(found, [this](const Seed& seed) { return !inside(seed.low); });
  std::stable_sort(found.begin(), found.end(), [](const Seed& a, const Seed& b) { return a.size < b.size; });
  Front front(*this, asked, gradation);
  for (const Seed& seed : found) {
    if (seed.slope > result.steepest.slope && inside(seed.high))
      result.steepest = {seed.low, seed.slope};
    front.follow(seed);
  }
  result.limits = front.take();
  return result;
}

} // namespace trime::sizing
