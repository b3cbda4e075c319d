// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/steep_sizes.hpp"

#include "comm/agree.hpp"
#include "cones/cone_tree.hpp"
#include "core/angle.hpp"
#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "sizing/rules.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

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

constexpr std::ptrdiff_t places_in_a_row = 8; // by one thread; a front often grows by fewer in a round

constexpr std::ptrdiff_t pieces_in_a_row = 64; // by one thread, along which places have about equal distances

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

/// Walks along consecutive pieces of the boundary in steps of front_step sizes.
class BoundaryWalk {
public:
  /// The references must outlive the object. @param most_steps number of steps after which the walk ends
  BoundaryWalk(const ScaledSize& asked, const geometry::Periods& periods, double gradation, double most_steps,
               std::vector<SizeLimit>& places)
      : asked_(asked), periods_(periods), gradation_(gradation), steps_left_(most_steps), places_(places) {}

  /// Lists the places of the piece from which the size grows too fast to the left, which is the inside.
  void pass(const geometry::Piece& piece) {
    const double length = piece.length();
    for (; ahead_ < length && steps_left_ > 0; --steps_left_) {
      const Vec2 p = piece.point(ahead_), along = piece.tangent(ahead_);
      const double h = size(p);
      if (!is_valid_size(h)) // the layout of the boundary reports it
        return;
      const double step = Rules::front_step * h, inwards = size(p + step * Vec2{-along.y, along.x});
      if (is_valid_size(inwards) && inwards > h + (1 + Rules::gentle_excess) * gradation_ * step)
        places_.push_back({periods_.wrap(p), h});
      ahead_ += step;
    }
    ahead_ = std::fmax(0, ahead_ - length);
  }

private:
  double size(Vec2 p) const { return asked_.size(periods_.wrap(p)); }

  const ScaledSize& asked_;
  const geometry::Periods& periods_;
  double gradation_, steps_left_;
  std::vector<SizeLimit>& places_;
  double ahead_ = 0; // way from the start of the piece to the next place
};

} // namespace

/// The places that were found so far, and the size that they allow.
class SteepSizes::Front {
public:
  Front(SteepSizes& owner, const ScaledSize& asked, double gradation, double most_places)
      : owner_(owner), asked_(asked), gradation_(gradation), most_places_(most_places),
        most_searched_(
            static_cast<std::size_t>(std::clamp(most_places, Rules::most_steep_places, Rules::most_places_searched))) {}

  /// Adds places that are known to lie on the front, unless others cover them. @pre they come with ascending sizes
  void add_known(const std::vector<SizeLimit>& places);

  /// Estimates from some seeds how many places the front has, except those that are known. Local.
  double expected_places(const std::vector<Seed>& seeds, double cell) const;
  /// Follows the front from a seed, unless the places that were found cover it. @pre seeds come with ascending sizes
  void follow(const Seed& seed);
  std::vector<SizeLimit> take() { return std::move(found_); }
  /// Are there more places than the mesh may have?
  bool is_overfull() const { return static_cast<double>(found_.size()) >= most_places_; }
  /// Has the search ended?
  bool is_full() const { return is_overfull() || found_.size() - known_ >= most_searched_; }

private:
  double size(Vec2 p) const {
    const double h = asked_.size(owner_.boundary_.periods.wrap(p));
    return is_valid_size(h) && owner_.inside(p) ? h : huge;
  }
  double allowed(SizeLimit at) const;
  /// Does a size lower what the places allow by more than a little?
  bool adds(SizeLimit at) const {
    return at.size < allowed(at) - Rules::front_gain * gradation_ * Rules::front_step * at.size;
  }
  void descend(SizeLimit& at, double step, double last_step) const;
  void approach(SizeLimit& at, Vec2 high) const;
  bool settle(SizeLimit& at) const;
  std::optional<SizeLimit> place_of(const Seed& seed) const;
  void look_around(const SizeLimit& from, std::vector<SizeLimit>& candidates) const;
  void add(SizeLimit at);
  void flood();
  void renew_tree();

  /// The cell of a place in the grid of a level, whose cells are 2^level wide.
  struct Key {
    int level;
    std::int64_t i, j;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return mix_bits(mix_bits(static_cast<std::uint64_t>(key.i)) ^ static_cast<std::uint64_t>(key.j)) ^
             static_cast<std::uint64_t>(key.level);
    }
  };
  static Key key_of(Vec2 p, int level) {
    return {level, static_cast<std::int64_t>(std::floor(std::ldexp(p.x, -level))),
            static_cast<std::int64_t>(std::floor(std::ldexp(p.y, -level)))};
  }
  static int level_of(double h) { return std::ilogb(h); }

  SteepSizes& owner_;
  const ScaledSize& asked_;
  double gradation_, most_places_;
  std::vector<SizeLimit> found_;
  std::size_t most_searched_; // largest number of places that are found by following the front
  std::size_t known_ = 0;     // number of places that add_known() has added
  std::size_t followed_ = 0;  // number of places from which the front was followed
  std::unordered_map<Key, std::vector<std::size_t>, Hash>
      nearby_;              // indices into found_, by the cell at the level of their size
  ConeTree tree_;           // of the first places
  std::size_t in_tree_ = 0; // their number
};

/// The size at a place that the places found so far allow: all of the tree, and those nearby.
double SteepSizes::Front::allowed(SizeLimit at) const {
  double least = in_tree_ > 0 ? tree_.value(owner_.boundary_.periods.wrap(at.place), 2 * at.size) : huge;
  if (least < at.size)
    return least;
  for (int level = level_of(at.size) - 1; level <= level_of(at.size) + 1; ++level) {
    const Key center = key_of(at.place, level);
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di) {
        const auto cell = nearby_.find({level, center.i + di, center.j + dj});
        if (cell == nearby_.end())
          continue;
        for (const std::size_t k : cell->second)
          least = std::fmin(least, found_[k].size + gradation_ * geometry::length(at.place - found_[k].place));
      }
  }
  return least;
}

/// Moves to smaller sizes, as long as the size falls faster than it may. On the ground of a valley, where the size
/// grows in nearly all directions, the steps become small enough to find the lowest size.
void SteepSizes::Front::descend(SizeLimit& at, double step, double last_step) const {
  for (int round = 0; round < Rules::descent_rounds; ++round) {
    SizeLimit best{at.place, at.size - gradation_ * step};
    double highest = 0;
    int upwards = 0;
    for (const Vec2 direction : directions) {
      const Vec2 q = at.place + step * direction;
      const double h = size(q);
      if (h < best.size)
        best = {q, h};
      upwards += h > at.size + gradation_ * step;
      highest = std::fmax(highest, h);
    }
    if (best.place != at.place) {
      at = best;
      continue;
    }
    const bool is_valley = upwards >= Rules::valley_directions && highest > (1 + Rules::valley_error) * at.size;
    if (step < (is_valley ? Rules::last_valley_step : last_step) * at.size)
      return;
    step *= 0.5;
  }
}

/// Moves towards a place where the size is too large, up to where the steep part begins.
void SteepSizes::Front::approach(SizeLimit& at, Vec2 high) const {
  SizeLimit low = at;
  for (int round = 0;
       round < Rules::descent_rounds && geometry::length(high - low.place) > Rules::front_precision * at.size;
       ++round) {
    const Vec2 middle = 0.5 * (low.place + high);
    const double h = size(middle);
    if (h <= at.size + gradation_ * geometry::length(middle - at.place))
      low = {middle, h};
    else
      high = middle;
  }
  at = low;
}

/// Moves a place near the front to it. Returns false if no steep part begins there.
bool SteepSizes::Front::settle(SizeLimit& at) const {
  descend(at, 0.5 * Rules::front_step * at.size, Rules::last_descent);
  const double reach = Rules::front_step * at.size;
  double steepest = at.size + (1 + Rules::gentle_excess) * gradation_ * reach;
  std::optional<Vec2> high;
  for (const Vec2 direction : directions) {
    const Vec2 q = at.place + reach * direction;
    if (const double h = size(q); h < huge && h > steepest) {
      steepest = h;
      high = q;
    }
  }
  if (!high)
    return false;
  approach(at, *high);
  return true;
}

/// Appends the places around one that may continue the front.
void SteepSizes::Front::look_around(const SizeLimit& from, std::vector<SizeLimit>& candidates) const {
  for (const Vec2 direction : directions) {
    SizeLimit at{from.place + Rules::front_step * from.size * direction, 0};
    at.size = size(at.place);
    const bool is_close = at.size < from.size + Rules::close_to_front * from.size; // else the front lies elsewhere
    if (is_close && (adds(at) || at.size > from.size) && settle(at) && adds(at))
      candidates.push_back(at);
  }
}

void SteepSizes::Front::add(SizeLimit at) {
  at.place = owner_.boundary_.periods.wrap(at.place);
  nearby_[key_of(at.place, level_of(at.size))].push_back(found_.size());
  found_.push_back(at);
}

void SteepSizes::Front::renew_tree() {
  if (found_.size() == in_tree_)
    return;
  tree_ = ConeTree(limiting_cones(found_, owner_.boundary_.periods), gradation_);
  in_tree_ = found_.size();
}

/// Threads look around all places of a round; candidates are judged again one by one, because those of a round may lie
/// close together.
void SteepSizes::Front::flood() {
  while (followed_ < found_.size() && !is_full()) {
    if (found_.size() > 2 * in_tree_ + Rules::few_steep_places)
      renew_tree();
    const std::size_t first = std::exchange(followed_, found_.size());
    const std::vector<SizeLimit> candidates =
        gather_in_order<SizeLimit>(std::ssize(found_) - static_cast<std::ptrdiff_t>(first), places_in_a_row,
                                   [&](std::ptrdiff_t k, std::vector<SizeLimit>& list) {
                                     look_around(found_[first + static_cast<std::size_t>(k)], list);
                                   });
    for (const SizeLimit& at : candidates)
      if (adds(at))
        add(at);
  }
}

void SteepSizes::Front::add_known(const std::vector<SizeLimit>& places) {
  for (const SizeLimit& at : places) {
    if (is_overfull())
      break;
    if (found_.size() > 2 * in_tree_ + Rules::few_steep_places)
      renew_tree();
    if (adds(at))
      add(at);
  }
  known_ = followed_ = found_.size();
  renew_tree();
}

/// The place on the front that belongs to a seed; nothing if the places that were found cover it.
std::optional<SizeLimit> SteepSizes::Front::place_of(const Seed& seed) const {
  SizeLimit at{seed.low, seed.size};
  if (seed.size > allowed(at) * (1 - Rules::covered_error))
    return std::nullopt;
  descend(at, 0.5 * geometry::length(seed.high - seed.low), Rules::front_precision);
  if (at.place == seed.low)
    approach(at, seed.high);
  return adds(at) ? std::optional(at) : std::nullopt;
}

double SteepSizes::Front::expected_places(const std::vector<Seed>& seeds, double cell) const {
  const std::size_t stride = seeds.size() / Rules::estimated_seeds + 1;
  std::vector<double> places((seeds.size() + stride - 1) / stride);
  thread_loop(std::ssize(places), 1, [&](std::ptrdiff_t k, int) {
    if (const auto at = place_of(seeds[static_cast<std::size_t>(k) * stride]))
      places[static_cast<std::size_t>(k)] = cell / (Rules::front_step * at->size);
  });
  return static_cast<double>(stride) * std::accumulate(places.begin(), places.end(), 0.0);
}

void SteepSizes::Front::follow(const Seed& seed) {
  const std::optional<SizeLimit> at = is_full() ? std::nullopt : place_of(seed);
  if (!at)
    return;
  add(*at);
  flood();
  renew_tree();
}

SteepSizes::SteepSizes(const comm::Communicator& comm, const SizeField& relative, const geometry::Boundary& boundary,
                       const geometry::Lattice& lattice, double samples)
    : comm_(comm), relative_(relative), boundary_(boundary), lattice_(lattice), box_(boundary.bounding_box()) {
  const geometry::Periods& periods = boundary.periods;
  if (periods.x > 0) {
    box_.min.x = periods.min.x;
    box_.max.x = periods.min.x + periods.x;
  }
  if (periods.y > 0) {
    box_.min.y = periods.min.y;
    box_.max.y = periods.min.y + periods.y;
  }
  const double side = std::sqrt(box_.width() * box_.height() / std::fmin(samples, Rules::most_steep_samples));
  const auto cells = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(length / side), Rules::least_steep_cells, Rules::most_steep_cells));
  };
  columns_ = cells(box_.width());
  rows_ = cells(box_.height());
  first_row_ = std::max(0, static_cast<int>(std::int64_t{rows_} * comm.rank() / comm.size()) - 1);
  last_row_ = std::min(rows_, static_cast<int>(std::int64_t{rows_} * (comm.rank() + 1) / comm.size()) + 1);
  samples_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(last_row_ - first_row_));
  comm::run_agreed(comm, [this] {
    loop_over_blocks(relative_, std::ssize(samples_), [this](std::ptrdiff_t begin, std::ptrdiff_t end) {
      const auto first = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end - begin);
      std::vector<Vec2> places(count);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t row = (first + k) / static_cast<std::size_t>(columns_),
                          column = (first + k) % static_cast<std::size_t>(columns_);
        samples_[first + k].place = place_in(static_cast<int>(column), first_row_ + static_cast<int>(row));
        places[k] = boundary_.periods.wrap(samples_[first + k].place);
      }
      const std::vector<double> sizes = sizes_at(relative_, places);
      for (std::size_t k = 0; k < count; ++k)
        samples_[first + k].relative = sizes[k];
    });
  });
}

/// Returns a random place in a cell.
Vec2 SteepSizes::place_in(int i, int j) const {
  const std::uint64_t cell =
      static_cast<std::uint64_t>(j) * static_cast<std::uint64_t>(columns_) + static_cast<std::uint64_t>(i);
  const auto random = [&](std::uint64_t slot) { return random_unit(0, RandomPurpose::size_sample, cell, slot); };
  return {box_.min.x + box_.width() / columns_ * (i + random(0)), box_.min.y + box_.height() / rows_ * (j + random(1))};
}

/// The lower sample of a steep pair of neighbours with its steepest partner. Nothing if another neighbour lowers the
/// size of this sample: then the edge of the steep part lies there.
std::optional<SteepSizes::Seed> SteepSizes::seed_at(int i, int j, const ScaledSize& asked, double gradation) const {
  const auto at = [&](int column, int row) -> const Sample& {
    return samples_[static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
  };
  const Sample& low = at(i, j);
  if (!is_valid_size(low.relative))
    return std::nullopt;
  const double h = asked.scaled(low.relative);
  Seed seed{low.place, {}, h, (1 + Rules::gentle_excess) * gradation};
  bool found = false;
  for (int row = std::max(0, j - 1); row <= std::min(rows_ - 1, j + 1); ++row)
    for (int column = std::max(0, i - 1); column <= std::min(columns_ - 1, i + 1); ++column) {
      const Sample& other = at(column, row);
      if (!is_valid_size(other.relative) || other.relative == low.relative)
        continue;
      const double slope = (asked.scaled(other.relative) - h) / geometry::length(other.place - low.place);
      if (slope < -(1 + Rules::gentle_excess) * gradation && inside(other.place))
        return std::nullopt;
      if (slope > seed.slope) {
        seed.high = other.place;
        seed.slope = slope;
        found = true;
      }
    }
  return found && inside(low.place) ? std::optional(seed) : std::nullopt;
}

/// All seeds of all ranks.
std::vector<SteepSizes::Seed> SteepSizes::seeds(const ScaledSize& asked, double gradation) const {
  return comm::gather_shared<Seed>(comm_, rows_, 1, [&](std::ptrdiff_t j, std::vector<Seed>& list) {
    for (int i = 0; i < columns_; ++i)
      if (const std::optional<Seed> seed = seed_at(i, static_cast<int>(j), asked, gradation))
        list.push_back(*seed);
  });
}

/// Local. Without a segment grid everything counts as inside.
bool SteepSizes::inside(Vec2 p) const {
  return !segments_ || segments_->inside(lattice_.snap(p));
}

/// Places on the boundary from which the size grows too fast towards the inside, with ascending sizes. All ranks return
/// the same places. Collective.
std::vector<SizeLimit> SteepSizes::along_boundary(const ScaledSize& asked, double gradation, double most_places) const {
  std::vector<SizeLimit> places;
  for (const geometry::Loop& loop : boundary_.loops) {
    const std::ptrdiff_t pieces = std::ssize(loop.pieces), runs = (pieces + pieces_in_a_row - 1) / pieces_in_a_row;
    const std::vector<SizeLimit> of_loop =
        comm::gather_shared<SizeLimit>(comm_, runs, 1, [&](std::ptrdiff_t run, std::vector<SizeLimit>& list) {
          BoundaryWalk walk(asked, boundary_.periods, gradation, most_places, list);
          for (std::ptrdiff_t k = run * pieces_in_a_row; k < std::min(pieces, (run + 1) * pieces_in_a_row); ++k)
            walk.pass(loop.pieces[static_cast<std::size_t>(k)]);
        });
    places.insert(places.end(), of_loop.begin(), of_loop.end());
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const SizeLimit& a, const SizeLimit& b) { return a.size < b.size; });
  return places;
}

SteepSizes::Limits SteepSizes::limits(const ScaledSize& asked, double gradation, double most_places) {
  std::vector<Seed> found = seeds(asked, gradation);
  Limits result;
  if (!found.empty() && !segments_ && !boundary_.periods.any()) { // of loops that wind around, no grid knows the inside
    segments_.emplace(chords_of(boundary_, lattice_));
    found = seeds(asked, gradation);
  }
  if (found.empty())
    return result;
  result.gradation = Rules::limited_slope * gradation;
  const std::vector<SizeLimit> known = along_boundary(asked, result.gradation, most_places);
  comm::run_agreed(comm_, [&] { // the same on all ranks; a size of the user may throw on one of them
    std::stable_sort(found.begin(), found.end(), [](const Seed& a, const Seed& b) { return a.size < b.size; });
    Front front(*this, asked, result.gradation, most_places);
    front.add_known(known);
    const double cell = std::sqrt(box_.width() * box_.height() / (static_cast<double>(columns_) * rows_));
    result.is_full = front.is_overfull() || front.expected_places(found, cell) > Rules::surely_full * most_places;
    for (const Seed& seed : found) {
      if (seed.slope > result.steepest.slope && inside(seed.high))
        result.steepest = {seed.low, seed.slope};
      if (!result.is_full)
        front.follow(seed);
    }
    result.is_full |= front.is_overfull();
    result.is_capped = front.is_full();
    result.limits = front.take();
  });
  return result;
}

} // namespace trime::sizing
