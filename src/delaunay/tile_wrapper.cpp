// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/tile_wrapper.hpp"

#include "delaunay/circumcenter.hpp"
#include "delaunay/rules.hpp"
#include "delaunay/star_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace trime::delaunay {
namespace {

using geometry::Vec2;

constexpr double many_larger = 0.2;    // Share of stars that needed a longer reach above which that one is tried first
constexpr double few_larger = 1e-4;    // Share of such stars below which a shorter reach is tried first again
constexpr double stars_to_learn = 500; // [stars] Number that is counted before the reach is chosen again
// Cost of a star that is searched alone from scratch; in a relaxed mesh, with its last ring, one costs 1.
constexpr double cost_of_search = 5;
constexpr double cost_of_group = 3;   // Cost of a group, in units of a star alone in a relaxed mesh: so much for any
constexpr double cost_of_lane = 0.77; // And so much more for each lane of the processor
constexpr std::size_t fewest_in_group = 3; // [sites] Smallest number in a group
// [groups] Where ties are everywhere, largest number of groups that are skipped before one is tried again.
constexpr int longest_pause = 64;

/// Distance beyond the box of the sites up to which candidates are searched, in spacings.
constexpr std::array<double, 3> reaches{WrapRules::reach_relaxed, WrapRules::reach_random, WrapRules::reach_longest};
constexpr double rounder = 0x3p32;    // adding and subtracting it leaves multiples of 2^-19
constexpr double largest_half = 15.9; // of the longer side of a group's box: WrapGroup holds coordinates below 16
constexpr double half_window = 1.9;   // times the largest cap, a quarter of a period: the window holds no image twice
constexpr double cap_slack = 0.99;    // caps in float32 stay below those in double precision
// Times a squared circumradius R^2, both with room for rounding: what lies in a disc through the site is no farther
// than 2 R, and |x| + |y| is at most the root of 2 times the length.
constexpr double reach_squared = 4.0001, taxicab_squared = 2.001;
constexpr std::ptrdiff_t few_to_sort = 32; // sites for a simple sort

/// Where a site lies as WrapGroup wants it, and its distances from the centre along the axes.
inline Double2 write_candidate(Vec2 at, Double2 center, Double2 scale, WrapGroup::Candidate& to) {
  using Float2 [[gnu::vector_size(8)]] = float;
  const Double2 value = (load2(&at.x) - center) * scale, coarse = (value + both(rounder)) - both(rounder);
  const Float2 first = __builtin_convertvector(coarse, Float2), rest = __builtin_convertvector(value - coarse, Float2);
  std::memcpy(&to.x, &first, sizeof first);
  std::memcpy(&to.rest_x, &rest, sizeof rest);
  return value > both(0) ? value : -value;
}

} // namespace

void ReachChoice::learn(std::size_t stars, std::size_t larger) {
  stars_ += static_cast<double>(stars);
  larger_ += static_cast<double>(larger);
  if (stars_ < stars_to_learn)
    return;
  if (larger_ > many_larger * stars_ && level_ + 1 < reaches.size())
    ++level_;
  else if (larger_ < few_larger * stars_ && level_ > 0)
    --level_;
  stars_ = larger_ = 0;
}

bool TiePause::skips_group() {
  if (left_ == 0)
    return false;
  --left_;
  return true;
}

void TiePause::learn(std::size_t stars, std::size_t undecided) {
  last_ = 2 * undecided <= stars ? 0 : std::min(longest_pause, 2 * last_ + 1);
  left_ = last_;
}

TileWrapper::TileWrapper(const mesh::BinnedPoints& points, StarTable& stars, const geometry::Lattice& lattice,
                         SimdLevel level)
    : points_(points), positions_(points.positions().data()), stars_(stars), lattice_(lattice),
      kernel_(wrap_kernel(level)), group_(std::make_unique<WrapGroup>()) {
  candidate_.resize(WrapGroup::most_candidates + WrapGroup::padding);
}

std::int64_t TileWrapper::compute(LocalIndex tile, std::span<double> caps) {
  const auto [begin, end] = points_.tile_range(tile);
  const geometry::Box box = points_.grid().tile_box(tile);
  wanted_ = {caps, begin};
  changed_ = 0;
  if (std::count_if(caps.begin(), caps.end(), [](double cap) { return cap > 0; }) <
      static_cast<std::ptrdiff_t>(fewest_in_group))
    return 0;
  spacing_ = std::sqrt(box.width() * box.height() / (end - begin));
  scale_ = std::ldexp(1.0, -std::ilogb(spacing_));
  order_sites(tile);
  wrap_groups(reaches[reach_.level()]);
  if (reach_.level() + 1 < reaches.size()) {
    std::swap(order_, again_);
    wrap_groups(reaches[reach_.level() + 1]);
  }
  return changed_;
}

/// Computes what it can of the sites in order_; those that need a longer reach come into again_.
void TileWrapper::wrap_groups(double reach) {
  again_.clear();
  for (std::size_t k = 0; k < order_.size();) {
    const Group group = next_group(k);
    k = group.end;
    if (!ties_.skips_group() && pays(group) && prepare(group, reach * spacing_)) {
      kernel_.wrap(*group_);
      take(group);
    }
  }
}

/// A group costs about the same for one site as for all lanes. Alone, a star is cheap if its last ring is all but right
/// and nobody else is near its discs: likely where degrees are those of a relaxed mesh.
bool TileWrapper::pays(const Group& group) const {
  double alone = 0;
  for (std::size_t k = group.begin; k < group.end; ++k) {
    const std::size_t degree = stars_.degree(order_[k]);
    alone += degree >= 5 && degree <= 7 ? 1 : cost_of_search;
  }
  return group.end - group.begin >= fewest_in_group && alone > cost_of_group + cost_of_lane * kernel_.lanes;
}

/// Snakes through strips of bins, so that a run of sites fills a compact box.
void TileWrapper::order_sites(LocalIndex tile) {
  const int side = points_.grid().bins_per_side(tile);
  const double bin = std::sqrt(static_cast<double>(wanted_.caps.size())) / side; // in spacings
  const int height = std::clamp(static_cast<int>(std::lround(std::sqrt(kernel_.lanes) / bin)), 1, side);
  order_.clear();
  bool backwards = false;
  for (int row = 0; row < side; row += height, backwards = !backwards)
    for (int k = 0; k < side; ++k)
      append_column(tile, backwards ? side - 1 - k : k, row, std::min(row + height, side), backwards);
}

void TileWrapper::append_column(LocalIndex tile, int column, int first_row, int last_row, bool backwards) {
  const std::size_t begin = order_.size();
  const int side = points_.grid().bins_per_side(tile);
  for (int row = first_row; row < last_row; ++row) {
    const auto [first, last] = points_.bin_range({tile, row * side + column});
    for (LocalIndex i = first; i < last; ++i)
      if (wanted_.cap(i) > 0)
        order_.push_back(i);
  }
  const double sign = backwards ? -1 : 1;
  const auto before = [&](LocalIndex i, LocalIndex j) { return sign * positions_[i].x < sign * positions_[j].x; };
  const auto first = order_.begin() + static_cast<std::ptrdiff_t>(begin);
  if (order_.end() - first > few_to_sort) {
    std::sort(first, order_.end(), before);
    return;
  }
  for (auto next = first; next != order_.end(); ++next) {
    const LocalIndex i = *next;
    auto at = next;
    for (; at != first && before(i, *(at - 1)); --at)
      *at = *(at - 1);
    *at = i;
  }
}

TileWrapper::Group TileWrapper::next_group(std::size_t begin) const {
  const double widest = 2 * std::sqrt(kernel_.lanes) * spacing_;
  const std::size_t limit = std::min(order_.size(), begin + static_cast<std::size_t>(kernel_.lanes));
  Group group{begin, begin, {positions_[order_[begin]], positions_[order_[begin]]}};
  for (; group.end < limit; ++group.end) {
    const Vec2 p = positions_[order_[group.end]];
    const geometry::Box grown{{std::min(group.box.min.x, p.x), std::min(group.box.min.y, p.y)},
                              {std::max(group.box.max.x, p.x), std::max(group.box.max.y, p.y)}};
    if (grown.width() > widest || grown.height() > widest)
      break;
    group.box = grown;
  }
  return group;
}

/// Candidates and sites of a group; false if there are too many candidates, or the box is too large.
bool TileWrapper::prepare(const Group& group, double reach) {
  center_ = lattice_.snap(Vec2{0.5 * (group.box.min.x + group.box.max.x), 0.5 * (group.box.min.y + group.box.max.y)});
  const Vec2 half{0.5 * group.box.width() + reach, 0.5 * group.box.height() + reach};
  const double longer = std::max(half.x, half.y);
  if (longer * scale_ > largest_half || longer > half_window * StarBuilder::largest_cap(points_.grid().periods()))
    return false;
  collect(half);
  if (group_->candidates > WrapGroup::most_candidates)
    return false;
  for (int lane = 0; lane < kernel_.lanes; ++lane) {
    const std::size_t k = std::min(group.begin + static_cast<std::size_t>(lane), group.end - 1);
    const LocalIndex i = order_[k];
    WrapGroup::Candidate site;
    write_candidate(positions_[i], Double2{center_.x, center_.y}, both(scale_), site);
    group_->site_x[lane] = site.x;
    group_->site_y[lane] = site.y;
    group_->site_rest_x[lane] = site.rest_x;
    group_->site_rest_y[lane] = site.rest_y;
    group_->cap[lane] = static_cast<float>(cap_slack * wanted_.cap(i) * scale_);
    stars_.expect_store(i);
  }
  return true;
}

void TileWrapper::collect(Vec2 half) {
  WrapGroup& g = *group_;
  int n = 0;
  missing_.clear();
  const Double2 center{center_.x, center_.y}, scale = both(scale_), limit = Double2{half.x, half.y} * scale;
  points_.for_each_near(
      center_, std::max(half.x, half.y),
      [&](LocalIndex begin, LocalIndex end) {
        if (n + (end - begin) > WrapGroup::most_candidates + WrapGroup::padding)
          n = WrapGroup::most_candidates + 1; // too many
        if (n > WrapGroup::most_candidates)
          return;
        for (LocalIndex j = begin; j < end; ++j) {
          const Mask2 near = write_candidate(positions_[j], center, scale, g.candidate[n]) <= limit;
          candidate_[static_cast<std::size_t>(n)] = j;
          n += static_cast<int>(near[0] & near[1] & 1);
        }
      },
      [&](mesh::BinRef bin) { missing_.push_back(bin); });
  g.candidates = n;
  g.half_x = static_cast<float>(limit[0]);
  g.half_y = static_cast<float>(limit[1]);
}

/// Where a bin lies; bins at the rim of the container hold all that lies beyond.
geometry::Box TileWrapper::box_of(mesh::BinRef bin) const {
  const mesh::TileGrid& grid = points_.grid();
  const mesh::Tile& tile = grid.tile(bin.tile);
  const std::int64_t side = std::int64_t{1} << tile.bin_shift();
  const std::int64_t x = tile.x + (bin.bin & ((1 << tile.bits) - 1)) * side, y = tile.y + (bin.bin >> tile.bits) * side;
  const auto range = [side](const mesh::FixedAxis& axis, std::int64_t first) {
    const double low = axis.coordinate(first), high = axis.coordinate(first + side), slack = 1e-3 * (high - low);
    return std::pair{!axis.is_periodic() && first <= axis.first() ? -INFINITY : low - slack,
                     !axis.is_periodic() && first + side > axis.last() ? INFINITY : high + slack};
  };
  const auto [x0, x1] = range(grid.x_axis(), x);
  const auto [y0, y1] = range(grid.y_axis(), y);
  const Vec2 shift = grid.shift(bin.image);
  return {Vec2{x0, y0} + shift, Vec2{x1, y1} + shift};
}

/// Can a disc of the star meet a bin that is not known? The star is then left to the search that names such bins.
bool TileWrapper::meets_missing_bin(int lane) const {
  const WrapGroup& g = *group_;
  const Vec2 low = center_ + (1 / scale_) * Vec2{g.low_x[lane], g.low_y[lane]};
  const Vec2 high = center_ + (1 / scale_) * Vec2{g.high_x[lane], g.high_y[lane]};
  return std::any_of(missing_.begin(), missing_.end(), [&](const mesh::BinRef& bin) {
    const geometry::Box box = box_of(bin);
    return low.x < box.max.x && high.x > box.min.x && low.y < box.max.y && high.y > box.min.y;
  });
}

/// Stores the stars that were found; those whose discs leave the box come again.
void TileWrapper::take(const Group& group) {
  std::size_t undecided = 0;
  const std::size_t again_before = again_.size();
  for (std::size_t k = group.begin; k < group.end; ++k) {
    const int lane = static_cast<int>(k - group.begin);
    const LocalIndex i = order_[k];
    const int degree = group_->degree[lane];
    if (group_->covered[lane] == 0) {
      again_.push_back(i);
    } else if (degree == 0 || !(group_->proven[lane] != 0 || prove(i, lane, degree))) {
      ++undecided;
    } else if (missing_.empty() || !meets_missing_bin(lane)) {
      store(i, lane, degree);
    }
  }
  const std::size_t n = group.end - group.begin;
  reach_.learn(n, again_.size() - again_before);
  ties_.learn(n, undecided);
}

/// @brief The proof in double precision: no candidate lies in the discs of the ring, save the two of each on its rim.
/// Triangles of the Delaunay triangulation that follow each other until the first comes again are the whole star.
bool TileWrapper::prove(LocalIndex site, int lane, int degree) {
  const Vec2 center = positions_[site];
  const auto neighbour = [&](int k) {
    return positions_[candidate_[static_cast<std::size_t>(group_->ring[k][lane])]] - center;
  };
  std::array<Vertex, WrapGroup::most_degree> vertices;
  double r2 = 0;
  Vec2 a = neighbour(degree - 1);
  for (int k = 0; k < degree; ++k) {
    const Vec2 b = neighbour(k);
    const Vertex v = circumcenter(a.x, a.y, b.x, b.y);
    if (!v.sound)
      return false;
    vertices[static_cast<std::size_t>(k)] = v;
    r2 = std::max(r2, v.r2);
    a = b;
  }
  std::size_t near = 0;
  for (int c = 0; c < group_->candidates; ++c) {
    const Vec2 q = positions_[candidate_[static_cast<std::size_t>(c)]] - center;
    const double q2 = geometry::squared_length(q);
    near_.x[near] = q.x;
    near_.y[near] = q.y;
    near += (q2 > 0) & (q2 <= reach_squared * r2);
  }
  near_.x[near] = near_.y[near] = NAN;
  const double size = 2 * std::sqrt(taxicab_squared * r2); // of |q|_1
  for (int k = 0; k < degree; ++k) {
    const Vertex& v = vertices[static_cast<std::size_t>(k)];
    const Double2 tolerance = both(-(v.error * size + 8 * epsilon * size * size));
    Mask2 inside{0, 0};
    for (std::size_t c = 0; c < near; c += 2) {
      const Double2 x = load2(&near_.x[c]), y = load2(&near_.y[c]);
      inside += both(2) * (both(v.x) * x + both(v.y) * y) - (x * x + y * y) >= tolerance;
    }
    if (inside[0] + inside[1] != -2)
      return false;
  }
  return true;
}

/// The ring starts at the lexicographically smallest neighbour.
void TileWrapper::store(LocalIndex site, int lane, int degree) {
  const auto neighbour = [&](int k) { return candidate_[static_cast<std::size_t>(group_->ring[k][lane])]; };
  int smallest = 0;
  Vec2 best = positions_[neighbour(0)];
  for (int k = 1; k < degree; ++k) {
    const Vec2 p = positions_[neighbour(k)];
    const bool less = p.x < best.x || (p.x == best.x && p.y < best.y);
    smallest = less ? k : smallest;
    best = less ? p : best;
  }
  const auto turned = [&](int k) { return neighbour(smallest + k < degree ? smallest + k : smallest + k - degree); };
  const std::size_t n = static_cast<std::size_t>(degree);
  bool changed = false;
  if (n <= StarTable::slots) {
    changed = stars_.degree(site) != n;
    LocalIndex* slots = stars_.store_short(site, n);
    for (int k = 0; k < degree; ++k) {
      const LocalIndex id = turned(k);
      changed |= slots[k] != id;
      slots[k] = id;
    }
    for (std::size_t k = n; k < StarTable::slots; ++k)
      slots[k] = slots[k - n];
  } else {
    rings_.now.clear();
    for (int k = 0; k < degree; ++k)
      rings_.now.push_back(turned(k));
    const std::span<const LocalIndex> last = stars_.load(site, rings_.before);
    changed = !std::equal(last.begin(), last.end(), rings_.now.begin(), rings_.now.end());
    stars_.store(site, rings_.now);
  }
  changed_ += changed;
  stars_.set_certain(site, true);
  wanted_.cap(site) = 0;
}

} // namespace trime::delaunay
