// SPDX-License-Identifier: BSD-3-Clause
// Stars found many at a time: the same on every SIMD level as one by one, and never claimed where float32 cannot tell.
#include "delaunay/wrap.hpp"

#include "core/angle.hpp"
#include "delaunay/star_builder.hpp"
#include "support/star_checks.hpp"
#include "unit/delaunay/wrap_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>

namespace trime::delaunay {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using testing::unit_lattice;

constexpr SimdLevel levels[] = {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512};

/// Lowers the SIMD level while it lives.
class AtLevel {
public:
  explicit AtLevel(SimdLevel level) { limit_simd_level(level); }
  ~AtLevel() { limit_simd_level(SimdLevel::avx512); }
  AtLevel(const AtLevel&) = delete;
};

SiteList jittered(SiteList sites, double step) {
  for (std::size_t k = 0; k < sites.size(); ++k)
    sites[k].position = unit_lattice().snap(sites[k].position + step * (testing::random_vec2(31, k) - Vec2{0.5, 0.5}));
  return sites;
}

/// A spiral: the density varies by orders of magnitude inside the tiles.
SiteList spiral(int n) {
  SiteList sites;
  for (int k = 0; k < n; ++k) {
    const double r = 0.45 * std::exp(-8.0 * k / n), turn = 2.399963 * k;
    sites.push_back({unit_lattice().snap(Vec2{0.5 + r * std::cos(turn), 0.5 + r * std::sin(turn)})});
  }
  return sites;
}

struct Case {
  std::string name;
  SiteList sites;
  double cap, spacing;
};

std::vector<Case> cases() {
  const SiteList hexagonal = testing::hexagonal_lattice(50, 0.018), square = testing::square_lattice(45, 0.02);
  return {{"random", testing::random_sites(3000, 1), 0.06, 0.02},
          {"random, cap near the radii", testing::random_sites(3000, 2), 0.012, 0.02},
          {"random in few large bins", testing::random_sites(2000, 3), 0.1, 0.1},
          {"random in many small bins", testing::random_sites(2000, 3), 0.1, 0.005},
          {"relaxed", jittered(hexagonal, 0.005), 0.045, 0.018},
          {"hexagonal lattice", hexagonal, 0.045, 0.018},
          {"nearly hexagonal lattice", jittered(hexagonal, 1e-12), 0.045, 0.018},
          {"square lattice", square, 0.05, 0.02},
          {"square lattice, moved by what float32 does not see", jittered(square, 1e-9), 0.05, 0.02},
          {"square lattice, moved by a few lattice steps", jittered(square, 3e-13), 0.05, 0.02},
          {"spiral", spiral(2000), 0.1, 0.02},
          {"clusters", testing::clusters(600, 4), 0.9, 0.02},
          {"near duplicates", testing::near_duplicates(300, 5), 0.3, 0.05},
          {"cocircular rings", testing::cocircular_rings(), 0.2, 0.05}};
}

/// All stars at once, and then a few at a time, so that each is searched alone.
TEST(Wrap, StarsAreTheSameOnEveryLevelAndOneByOne) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const mesh::TileGrid grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, c.spacing});
    mesh::BinnedPoints points(grid);
    points.assign_owned(c.sites, 0, grid.tile_count());
    const StarBuilder builder(unit_lattice(), c.cap);
    std::vector<mesh::BinRef> missing;
    StarTable alone;
    alone.reset(points.owned());
    std::vector<StarWish> wanted(static_cast<std::size_t>(points.owned()), StarWish::leave);
    std::vector<std::vector<LocalIndex>> rounds(1);
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) // no more than two sites of a tile in a round
      for (LocalIndex i = points.tile_range(tile).begin; i < points.tile_range(tile).end; ++i) {
        const std::size_t round = static_cast<std::size_t>(i - points.tile_range(tile).begin) / 2;
        rounds.resize(std::max(rounds.size(), round + 1));
        rounds[round].push_back(i);
      }
    for (const std::vector<LocalIndex>& round : rounds) {
      for (const LocalIndex i : round)
        wanted[static_cast<std::size_t>(i)] = StarWish::compute;
      builder.update(points, alone, {}, wanted, missing);
      for (const LocalIndex i : round)
        wanted[static_cast<std::size_t>(i)] = StarWish::leave;
    }
    for (const SimdLevel level : levels) {
      const AtLevel at(level);
      StarTable stars;
      stars.reset(points.owned());
      for (int update = 0; update < 2; ++update) { // from scratch and from the last rings
        const StarPass pass = builder.update(points, stars, {}, {}, missing);
        EXPECT_EQ(pass.uncertain, 0);
        EXPECT_TRUE(update == 0 || pass.rebuilt == 0);
        testing::expect_same_rings(stars, alone);
        for (LocalIndex i = 0; i < points.owned(); ++i)
          stars.set_certain(i, false);
      }
    }
    EXPECT_TRUE(missing.empty());
  }
}

/// A star whose discs meet a bin that is not known is not certain, even if all its neighbours are known.
TEST(Wrap, OnlyStarsWithoutUnknownBinsInTheirDiscsAreCertain) {
  const SiteList sites = testing::random_sites(6000, 14);
  const mesh::TileGrid grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, 0.0138});
  mesh::BinnedPoints whole(grid), part(grid);
  whole.assign_owned(sites, 0, grid.tile_count());
  const LocalIndex half = grid.tile_count() / 2;
  SiteList mine;
  for (LocalIndex i = 0; i < whole.tile_range(half - 1).end; ++i)
    mine.push_back(whole.site(i));
  part.assign_owned(mine, 0, half); // same order as in the whole: indices are equal
  const StarBuilder builder(unit_lattice(), 0.1);
  for (const SimdLevel level : levels) {
    const AtLevel at(level);
    StarTable right, found;
    std::vector<mesh::BinRef> missing;
    right.reset(whole.owned());
    builder.update(whole, right, {}, {}, missing);
    EXPECT_TRUE(missing.empty());
    found.reset(part.owned());
    const StarPass pass = builder.update(part, found, {}, {}, missing);
    EXPECT_GT(pass.uncertain, 50);
    EXPECT_GT(part.owned() - pass.uncertain, 1500);
    for (LocalIndex i = 0; i < part.owned(); ++i) {
      if (!found.certain(i))
        continue;
      const std::span<const LocalIndex> ring = found.ring(i), expected = right.ring(i);
      EXPECT_TRUE(std::equal(ring.begin(), ring.end(), expected.begin(), expected.end())) << "site " << i;
    }
  }
}

WrapGroup::Candidate candidate(Vec2 p) {
  const double x = std::round(p.x * 0x1p19) * 0x1p-19, y = std::round(p.y * 0x1p19) * 0x1p-19;
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(p.x - x), static_cast<float>(p.y - y)};
}

/// A group around the origin, seen by the first site in all lanes.
std::unique_ptr<WrapGroup> group_of(const std::vector<Vec2>& places, float cap) {
  auto group = std::make_unique<WrapGroup>();
  group->half_x = group->half_y = 4;
  group->candidates = static_cast<int>(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    group->candidate[k] = candidate(places[k]);
  for (int lane = 0; lane < WrapGroup::most_lanes; ++lane) {
    const WrapGroup::Candidate& c = group->candidate[0];
    group->site_x[lane] = c.x;
    group->site_y[lane] = c.y;
    group->site_rest_x[lane] = c.rest_x;
    group->site_rest_y[lane] = c.rest_y;
    group->cap[lane] = cap;
  }
  return group;
}

/// Runs `check` after wrapping with the kernel of each level that this machine has, and with each number of lanes.
template <class Check>
void with_each_kernel(const std::vector<Vec2>& places, float cap, const Check& check) {
  std::vector<WrapFunction> kernels{wrap_8_lanes, wrap_16_lanes};
  for (const SimdLevel level : levels)
    if (level <= simd_level())
      kernels.push_back(wrap_kernel(level).wrap);
  for (const WrapFunction kernel : kernels) {
    const std::unique_ptr<WrapGroup> group = group_of(places, cap);
    kernel(*group);
    check(*group);
  }
}

const std::vector<Vec2> flower{{0, 0},       {1, 0.1},    {0.6, 0.9}, {-0.5, 0.95}, {-1.1, 0},
                               {-0.4, -0.9}, {0.5, -1.0}, {2, 2},     {-2, 1.9},    {0.1, -2.5}};

TEST(Wrap, FindsARingWithItsDiscs) {
  with_each_kernel(flower, 2, [](const WrapGroup& group) {
    ASSERT_EQ(group.degree[0], 6);
    EXPECT_NE(group.proven[0], 0);
    EXPECT_NE(group.covered[0], 0);
    std::vector<int> ring;
    for (int k = 0; k < 6; ++k)
      ring.push_back(group.ring[k][0]);
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
    EXPECT_EQ(ring, (std::vector<int>{1, 2, 3, 4, 5, 6}));
    for (std::size_t k = 1; k <= 6; ++k) { // the discs hold the neighbours
      EXPECT_GE(flower[k].x, group.low_x[0]);
      EXPECT_LE(flower[k].x, group.high_x[0]);
      EXPECT_GE(flower[k].y, group.low_y[0]);
      EXPECT_LE(flower[k].y, group.high_y[0]);
    }
    EXPECT_GT(group.low_x[0], -1.6);
    EXPECT_LT(group.high_x[0], 1.6);
  });
}

/// Rings that are claimed are the same with every number of lanes, and nearly all are claimed by each.
TEST(Wrap, ClaimsTheSameRingsWithAnyNumberOfLanes) {
  const auto claims = [](const WrapGroup& group) { return group.degree[0] > 0 && group.proven[0]; };
  int claimed = 0, different = 0;
  for (std::uint64_t key = 0; key < 200; ++key) {
    std::vector<Vec2> places{{0, 0}};
    for (std::uint64_t k = 1; k < 20 + key % 40; ++k)
      places.push_back(7 * (testing::random_vec2(key, k) - Vec2{0.5, 0.5}));
    const std::unique_ptr<WrapGroup> usual = group_of(places, 3);
    wrap_portable(*usual);
    claimed += claims(*usual);
    with_each_kernel(places, 3, [&](const WrapGroup& group) {
      different += claims(group) != claims(*usual);
      if (!claims(group) || !claims(*usual))
        return;
      ASSERT_EQ(group.degree[0], usual->degree[0]) << key;
      EXPECT_EQ(group.covered[0] != 0, usual->covered[0] != 0) << key;
      for (int k = 0; k < group.degree[0]; ++k)
        EXPECT_EQ(group.ring[k][0], usual->ring[k][0]) << key;
    });
  }
  EXPECT_GT(claimed, 100);
  EXPECT_LT(different, 5);
}

TEST(Wrap, ClaimsNothingAtTiesGapsCapsAndTheRimOfTheBox) {
  for (int turn = 0; turn < 24;
       ++turn) { // a fourth site on the circle of each edge of the ring, the first and the last
    const double c = std::cos(turn * pi / 12), s = std::sin(turn * pi / 12);
    for (const double shift : {0.0, 1e-9, -1e-9}) {
      std::vector<Vec2> tied = flower;
      tied[1] = {1, 0};
      tied[2] = {0, 1};
      tied.push_back({1, 1 + shift});
      for (Vec2& p : tied)
        p = {c * p.x - s * p.y, s * p.x + c * p.y};
      with_each_kernel(tied, 4, [](const WrapGroup& group) { EXPECT_FALSE(group.degree[0] > 0 && group.proven[0]); });
    }
  }
  const auto claims = [](const WrapGroup& group) { return group.degree[0] > 0 && group.proven[0] && group.covered[0]; };
  with_each_kernel(flower, 0.6f, [&](const WrapGroup& group) { EXPECT_FALSE(claims(group)) << "cap"; });
  std::vector<Vec2> half;
  std::copy_if(flower.begin(), flower.end(), std::back_inserter(half), [](Vec2 p) { return p.y >= 0; });
  with_each_kernel(half, 4, [&](const WrapGroup& group) { EXPECT_FALSE(claims(group)) << "gap"; });
  std::vector<Vec2> off;
  for (const Vec2 p : flower)
    off.push_back(p + Vec2{2.6, 0});
  with_each_kernel(off, 4, [&](const WrapGroup& group) {
    EXPECT_EQ(group.covered[0] != 0, group.high_x[0] < 4 * 0.99999f);
    EXPECT_GT(group.high_x[0], 3.6f);
  });
  std::vector<Vec2> twins = flower;
  twins.push_back({1e-12, 0});
  with_each_kernel(twins, 4, [&](const WrapGroup& group) { EXPECT_FALSE(claims(group)) << "twins"; });
}

} // namespace
} // namespace trime::delaunay
