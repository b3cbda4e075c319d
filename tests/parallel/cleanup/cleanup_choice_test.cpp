// SPDX-License-Identifier: BSD-3-Clause
// Which contenders are chosen: none within the separation of another one, and the same ones on any ranks.
#include "cleanup/cleanup_choice.hpp"

#include "support/distributed.hpp"
#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using sites::SiteState;

/// Of widths from 0.02 to 0.1; some share their x, some their separation.
std::vector<Contender> contenders() {
  std::vector<Contender> all;
  for (std::uint64_t k = 0; k < 600; ++k) {
    const Vec2 p = testing::random_vec2(70, k), q = testing::random_vec2(71, k);
    const double separation = k % 5 == 0 ? 0.05 : 0.02 + 0.08 * q.x;
    all.push_back({{k % 7 == 0 ? 0.5 : p.x, p.y}, separation, static_cast<std::uint64_t>(40 * q.y)}); // ties
  }
  return all;
}

std::set<std::pair<double, double>> chosen_on(const comm::Communicator& comm, const geometry::Periods& periods) {
  SiteState state(comm, {{0, 0}, {1, 1}}, {{}, {}, 0.03, periods});
  state.distribute(testing::dealt(comm, testing::random_sites(1200, 3)));
  const sizing::UniformSize size(0.03);
  const CleanupSites sites(comm, state, size);
  std::vector<Contender> own;
  for (const Contender& one : contenders())
    if (sites.owner(one.place) == comm.rank())
      own.push_back(one);
  const std::vector<std::size_t> chosen = choose_apart(comm, sites, periods, own);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  std::vector<Vec2> places;
  for (const std::size_t k : chosen)
    places.push_back(own[k].place);
  std::set<std::pair<double, double>> all;
  for (const Vec2 p : comm::from_bytes<Vec2>(comm.all_gather(std::as_bytes(std::span<const Vec2>(places)))))
    all.insert({p.x, p.y});
  return all;
}

void expect_apart(const geometry::Periods& periods) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const std::set<std::pair<double, double>> chosen = chosen_on(self, periods);
  EXPECT_EQ(chosen_on(world, periods), chosen);
  std::size_t count = 0, left = 0;
  const std::vector<Contender> all = contenders();
  const auto is_chosen = [&](const Contender& one) { return chosen.contains({one.place.x, one.place.y}); };
  for (const Contender& one : all) {
    bool has_rival = false; // among the chosen
    for (const Contender& other : all) {
      const double separation = std::max(one.separation, other.separation);
      const Vec2 way = periods.nearest_image(other.place, one.place) - one.place;
      has_rival |= &one != &other && is_chosen(other) && geometry::squared_length(way) < separation * separation;
    }
    EXPECT_FALSE(is_chosen(one) && has_rival) << one.place.x << " " << one.place.y;
    count += is_chosen(one);
    left += !is_chosen(one) && !has_rival;
  }
  EXPECT_GT(count, 80u);
  EXPECT_LT(left, 5u) << "with room for them: a few passes nearly find all";
}

TEST(ChooseApart, NoTwoAreNearEachOther) {
  expect_apart({});
}

TEST(ChooseApart, NorAcrossAPeriodicBorder) {
  expect_apart(testing::unit_torus().periods());
}

} // namespace
} // namespace trime::cleanup
