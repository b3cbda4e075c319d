// SPDX-License-Identifier: BSD-3-Clause
// All segments that have a site in their discs are found, in the plane and on a torus: by brute force.
#include "boundary/segment_watch.hpp"

#include "core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Vec2;

double random_at(std::uint64_t stream, std::uint64_t slot) {
  return random_unit(1, RandomPurpose::site_position, stream, slot);
}

void expect_all_found(const geometry::Periods& periods) {
  constexpr LocalIndex segments = 2000, sites = 300;
  struct Watched {
    Vec2 a, along;
  };
  std::vector<Watched> watched;
  SegmentWatch watch(periods);
  for (LocalIndex k = 0; k < segments; ++k) {
    const double length = std::ldexp(0.5, -static_cast<int>(12 * random_at(k, 0)));
    watched.push_back(
        {{random_at(k, 1), random_at(k, 2)}, {length * (random_at(k, 3) - 0.5), length * (random_at(k, 4) - 0.5)}});
    watch.add(watched.back().a, watched.back().along, k);
  }
  std::size_t found_in_all = 0;
  for (LocalIndex j = 0; j < sites; ++j) {
    const Vec2 p{random_at(segments + j, 0), random_at(segments + j, 1)};
    std::vector<LocalIndex> found;
    watch.find(p, found);
    found_in_all += found.size();
    for (LocalIndex k = 0; k < segments; ++k) {
      const Vec2 middle = watched[k].a + 0.5 * watched[k].along;
      bool inside = false;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y) {
          const Vec2 image = middle + Vec2{x * periods.x, y * periods.y};
          inside = inside || 4 * geometry::squared_length(p - image) <= geometry::squared_length(watched[k].along);
        }
      EXPECT_TRUE(!inside || std::find(found.begin(), found.end(), k) != found.end())
          << k << " at " << p.x << " " << p.y;
    }
  }
  EXPECT_LT(found_in_all, std::size_t{segments} * sites / 10); // and few others
}

TEST(SegmentWatch, FindsAllInThePlane) {
  expect_all_found({});
}

TEST(SegmentWatch, FindsAllOnATorus) {
  geometry::Periods torus;
  torus.x = torus.y = 1;
  expect_all_found(torus);
}

} // namespace
} // namespace trime::boundary
