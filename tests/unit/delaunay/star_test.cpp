// SPDX-License-Identifier: BSD-3-Clause
// Certified stars against CGAL's Delaunay triangulation, and against the exact predicates where ties leave a choice.
#include "support/star_checks.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <string>

namespace trime::delaunay {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using testing::OnThreads;
using testing::TriangleSet;
using testing::unit_lattice;

/// Sites in the bins of one rank that owns all tiles, and their stars.
struct Cloud {
  explicit Cloud(const SiteList& sites, double cap, double spacing = 0.05)
      : grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, spacing}), points(grid), builder(unit_lattice(), cap) {
    points.assign_owned(sites, 0, grid.tile_count());
    stars.reset(points.owned());
    pass = builder.update(points, stars, {}, {}, missing);
  }
  Cloud(const Cloud&) = delete;

  mesh::TileGrid grid;
  mesh::BinnedPoints points;
  StarBuilder builder;
  StarTable stars;
  std::vector<mesh::BinRef> missing;
  StarPass pass;
};

/// CGAL's triangles below the cap: all, and those without a fourth point on the circle.
struct Oracle {
  Oracle(const mesh::BinnedPoints& points, const StarBuilder& builder) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    CGAL::Delaunay_triangulation_2<Kernel> triangulation;
    for (const Vec2 p : points.positions())
      triangulation.insert({p.x, p.y});
    const auto vec = [](const Kernel::Point_2& p) { return Vec2{p.x(), p.y()}; };
    for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
      const Vec2 a = vec(face->vertex(0)->point()), b = vec(face->vertex(1)->point()),
                 c = vec(face->vertex(2)->point());
      if (!StarBuilder::counts(a, b, c, builder.cap()))
        continue;
      ++count;
      bool tie = false;
      for (int k = 0; k < 3; ++k) {
        const auto opposite = triangulation.mirror_vertex(face, k);
        tie |= !triangulation.is_infinite(opposite) &&
               triangulation.side_of_oriented_circle(face, opposite->point()) == CGAL::ON_ORIENTED_BOUNDARY;
      }
      if (!tie)
        unique.insert(testing::canonical(a, b, c));
    }
  }
  std::size_t count = 0;
  TriangleSet unique;
};

void expect_delaunay(const Cloud& cloud) {
  EXPECT_EQ(cloud.pass.uncertain, 0);
  EXPECT_TRUE(cloud.missing.empty());
  testing::expect_well_formed(cloud.points, cloud.stars);
  testing::expect_consistent(cloud.points, cloud.stars);
  const Oracle oracle(cloud.points, cloud.builder);
  const TriangleSet found = testing::triangles_of(cloud.points, cloud.stars);
  EXPECT_EQ(found.size(), oracle.count);
  for (const testing::Triangle& t : oracle.unique)
    EXPECT_TRUE(found.count(t)) << t[0].x << ' ' << t[0].y << "  " << t[1].x << ' ' << t[1].y << "  " << t[2].x << ' '
                                << t[2].y;
  if (cloud.points.size() <= 400)
    testing::expect_empty_discs(cloud.points, cloud.stars, unit_lattice());
}

struct Case {
  std::string name;
  SiteList sites;
  double cap;
};

std::vector<Case> cases() {
  SiteList diagonal_pair = testing::wheel(40, {0.3, 0.3}, 0.1);
  return {{"random", testing::random_sites(1500, 1), 0.0777},
          {"random, container-wide cap", testing::random_sites(300, 2), 1},
          {"random, cap below most radii", testing::random_sites(1500, 3), 0.0123},
          {"square lattice", testing::square_lattice(16, 0.04), 0.0913},
          {"square lattice, wide cap", testing::square_lattice(12, 0.04), 1},
          {"hexagonal lattice", testing::hexagonal_lattice(18, 0.04), 0.0913},
          {"cocircular rings", testing::cocircular_rings(), 1},
          {"clusters", testing::clusters(400, 4), 0.9},
          {"near duplicates", testing::near_duplicates(200, 5), 0.3},
          {"near duplicates, wide cap", testing::near_duplicates(60, 6), 1},
          {"collinear", testing::collinear(40), 1},
          {"wheel", diagonal_pair, 0.5},
          {"one site", testing::random_sites(1, 7), 1},
          {"two sites", testing::random_sites(2, 7), 1},
          {"three sites", {{{0.25, 0.25}}, {{0.75, 0.25}}, {{0.5, 0.5}}}, 1},
          {"four cocircular sites", {{{0.25, 0.25}}, {{0.75, 0.25}}, {{0.75, 0.75}}, {{0.25, 0.75}}}, 1},
          {"no sites", {}, 1}};
}

TEST(Stars, AgreeWithCgal) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    expect_delaunay(Cloud(c.sites, c.cap));
  }
}

TEST(Stars, DoNotDependOnTheSizeOfTheBins) {
  const SiteList sites = testing::near_duplicates(150, 8);
  const Cloud reference(sites, 0.4);
  const TriangleSet expected = testing::triangles_of(reference.points, reference.stars);
  for (const double spacing : {3.0, 0.3, 0.01}) {
    const Cloud cloud(sites, 0.4, spacing);
    EXPECT_TRUE(testing::triangles_of(cloud.points, cloud.stars) == expected) << spacing;
  }
}

TEST(Stars, DoNotDependOnThreadsNorOnTheOrderOfTheSites) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const OnThreads one(1);
    const Cloud reference(c.sites, c.cap);
    SiteList reversed(c.sites.rbegin(), c.sites.rend());
    for (const int threads : {1, 2, 4}) {
      const OnThreads on(threads);
      const Cloud cloud(threads == 2 ? c.sites : reversed, c.cap);
      testing::expect_same_rings(cloud.stars, reference.stars);
    }
  }
}

TEST(Stars, NoTriangleIsLargerThanTheCap) {
  const Cloud cloud(testing::random_sites(1000, 9), 0.02);
  std::size_t gaps = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    for (const LocalIndex a : cloud.stars.ring(i))
      gaps += a == gap;
    testing::for_each_triangle(cloud.stars, i, [&](LocalIndex a, LocalIndex b) {
      EXPECT_TRUE(StarBuilder::counts(cloud.points.position(i), cloud.points.position(a), cloud.points.position(b),
                                      cloud.builder.cap()));
    });
  }
  EXPECT_GT(gaps, 100u);
}

/// Moves all sites by up to `step`, with the stars following; then the stars must be those from scratch.
void shake_and_compare(const SiteList& start, double cap, double step, int rounds) {
  Cloud cloud(start, cap);
  for (int round = 0; round < rounds; ++round) {
    SiteList sites;
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
      const Vec2 move = testing::random_vec2(100 + static_cast<std::uint64_t>(round), static_cast<std::uint64_t>(i));
      sites.push_back({unit_lattice().snap(cloud.points.position(i) + step * (move - Vec2{0.5, 0.5}))});
    }
    std::vector<LocalIndex> new_index;
    cloud.points.assign_owned(sites, 0, cloud.grid.tile_count(), &new_index);
    cloud.stars.renumber(new_index, cloud.points.owned());
    cloud.builder.update(cloud.points, cloud.stars, {}, {}, cloud.missing);
    StarTable fresh;
    fresh.reset(cloud.points.owned());
    cloud.builder.update(cloud.points, fresh, {}, {}, cloud.missing);
    testing::expect_same_rings(cloud.stars, fresh);
  }
}

TEST(Stars, EachFollowsTheCapOfItsOwnSite) {
  Cloud cloud(testing::random_sites(600, 8), 1.0);
  mesh::LocalSizes sizes;
  for (const Vec2 p : cloud.points.positions())
    sizes.values().push_back(0.002 + 0.03 * p.x);
  const StarBuilder builder(unit_lattice(), 2.5, 0.06);
  EXPECT_EQ(builder.cap(0.002), 0.005);
  EXPECT_EQ(builder.cap(0.5), 0.06);
  StarTable graded;
  graded.reset(cloud.points.owned());
  for (int round = 0; round < 2; ++round) { // from scratch and warm
    builder.update(cloud.points, graded, sizes, {}, cloud.missing);
    testing::expect_well_formed(cloud.points, graded);
    std::size_t counted = 0, dropped = 0;
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
      std::set<std::pair<LocalIndex, LocalIndex>> expected, found;
      testing::for_each_triangle(graded, i, [&](LocalIndex a, LocalIndex b) { found.emplace(a, b); });
      testing::for_each_triangle(cloud.stars, i, [&](LocalIndex a, LocalIndex b) {
        const bool counts = StarBuilder::counts(cloud.points.position(i), cloud.points.position(a),
                                                cloud.points.position(b), builder.cap(sizes[i]));
        (counts ? counted : dropped) += 1;
        if (counts)
          expected.emplace(a, b);
      });
      EXPECT_EQ(found, expected) << "site " << i;
      graded.set_certain(i, false);
    }
    EXPECT_GT(counted, 1000u);
    EXPECT_GT(dropped, 300u);
  }
}

TEST(Stars, AWarmUpdateEqualsOneFromScratch) {
  for (const Case& c : cases())
    for (const double step : {1e-13, 1e-6, 0.004, 0.04}) {
      SCOPED_TRACE(c.name + ", step " + std::to_string(step));
      shake_and_compare(c.sites, c.cap, step, c.sites.size() > 500 ? 1 : 2);
    }
}

TEST(Stars, WarmUpdateIsCheapWhereNothingMoved) {
  Cloud cloud(testing::random_sites(1000, 10), 1);
  std::vector<LocalIndex> same(static_cast<std::size_t>(cloud.points.owned()));
  for (std::size_t i = 0; i < same.size(); ++i)
    same[i] = static_cast<LocalIndex>(i);
  cloud.stars.renumber(same, cloud.points.owned());
  const StarPass pass = cloud.builder.update(cloud.points, cloud.stars, {}, {}, cloud.missing);
  EXPECT_LT(pass.rebuilt, 100) << "only stars at the rim, which have gaps, start anew";
}

TEST(Stars, LongRingsOverflowUnderThreads) {
  SiteList sites;
  std::set<std::pair<double, double>> hubs;
  for (int k = 0; k < 64; ++k) {
    const Vec2 center{0.0625 + 0.125 * (k % 8), 0.0625 + 0.125 * (k / 8)};
    hubs.emplace(center.x, center.y);
    for (const Site& site : testing::wheel(40, center, 0.04))
      sites.push_back(site);
  }
  const OnThreads on(4);
  Cloud cloud(sites, 0.3, 0.02);
  expect_delaunay(cloud);
  int found = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    if (hubs.count({cloud.points.position(i).x, cloud.points.position(i).y})) {
      EXPECT_EQ(cloud.stars.ring(i).size(), 40u);
      ++found;
    }
  EXPECT_EQ(found, 64);
  shake_and_compare(sites, 0.3, 1e-5, 2);
}

TEST(Stars, OnlyWantedStarsAreComputedAndOthersAreEmptied) {
  Cloud cloud(testing::random_sites(300, 11), 0.5);
  const TriangleSet all = testing::triangles_of(cloud.points, cloud.stars);
  std::vector<StarWish> wanted(static_cast<std::size_t>(cloud.points.owned()));
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i] = i % 3 == 0 ? StarWish::compute : StarWish::none;
  cloud.builder.update(cloud.points, cloud.stars, {}, wanted, cloud.missing);
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    EXPECT_EQ(cloud.stars.ring(i).empty(), i % 3 != 0);
  cloud.builder.update(cloud.points, cloud.stars, {}, {}, cloud.missing);
  EXPECT_TRUE(testing::triangles_of(cloud.points, cloud.stars) == all) << "emptied stars come back when wanted";
}

TEST(Stars, ARingThatIsLeftStaysAsItWasAndIsComputedOnceItIsWanted) {
  Cloud cloud(testing::random_sites(300, 13), 0.5);
  const TriangleSet all = testing::triangles_of(cloud.points, cloud.stars);
  const std::vector<StarWish> leave(static_cast<std::size_t>(cloud.points.owned()), StarWish::leave);
  EXPECT_EQ(cloud.builder.update(cloud.points, cloud.stars, {}, leave, cloud.missing).rebuilt, 0);
  EXPECT_TRUE(testing::triangles_of(cloud.points, cloud.stars) == all);
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    EXPECT_FALSE(cloud.stars.certain(i)) << "nobody has looked";
  const std::vector<LocalIndex> wrong{1, 2, 3};
  cloud.stars.store(0, wrong);
  cloud.builder.update(cloud.points, cloud.stars, {}, leave, cloud.missing);
  EXPECT_EQ(std::vector<LocalIndex>(cloud.stars.ring(0).begin(), cloud.stars.ring(0).end()), wrong);
  cloud.builder.update(cloud.points, cloud.stars, {}, {}, cloud.missing);
  EXPECT_TRUE(testing::triangles_of(cloud.points, cloud.stars) == all);
}

/// Half of the tiles belong to this rank; the bins of the others become known as they are asked for.
TEST(Stars, UncertainStarsNameTheMissingBinsAndAreRightOnceTheyAreKnown) {
  const Cloud whole(testing::random_sites(1200, 12), 0.1, 0.03);
  const LocalIndex half = whole.grid.tile_count() / 2;
  SiteList mine;
  for (LocalIndex i = 0; i < whole.points.owned(); ++i)
    if (whole.grid.place(whole.points.position(i)).tile < half)
      mine.push_back(whole.points.site(i));
  mesh::BinnedPoints points(whole.grid);
  points.assign_owned(mine, 0, half); // same order as in the whole: owned indices are equal
  StarTable stars;
  stars.reset(points.owned());
  std::set<mesh::BinRef> known;
  for (int round = 0;; ++round) {
    ASSERT_LT(round, 5) << "the stars ask for ever more bins";
    std::vector<mesh::BinRef> missing;
    const StarPass pass = whole.builder.update(points, stars, {}, {}, missing);
    for (LocalIndex i = 0; i < points.owned(); ++i)
      EXPECT_TRUE(stars.certain(i) || stars.ring(i).empty());
    EXPECT_EQ(missing.empty(), pass.uncertain == 0);
    EXPECT_TRUE(round > 0 || pass.uncertain > 0);
    if (missing.empty())
      break;
    for (const mesh::BinRef& bin : missing) {
      EXPECT_GE(bin.tile, half) << "bins of its own";
      EXPECT_TRUE(known.insert(bin).second) << "a known bin";
    }
    std::vector<std::int32_t> counts;
    std::vector<mesh::Ghost> ghosts;
    for (const mesh::BinRef& bin : known) {
      const auto [begin, end] = whole.points.bin_range(bin);
      counts.push_back(end - begin);
      for (LocalIndex i = begin; i < end; ++i)
        ghosts.push_back(mesh::Ghost{whole.points.position(i), whole.points.boundary(i)});
    }
    points.assign_ghosts(std::vector<mesh::BinRef>(known.begin(), known.end()), counts, ghosts);
    stars.reset(points.owned()); // the ghosts have new indices
  }
  EXPECT_LT(static_cast<LocalIndex>(known.size()), (whole.grid.tile_count() - half) * whole.grid.bins_per_tile(0))
      << "far bins are not needed";
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    const std::span<const LocalIndex> ring = stars.ring(i), expected = whole.stars.ring(i);
    ASSERT_EQ(ring.size(), expected.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      ASSERT_EQ(ring[k] == gap, expected[k] == gap);
      EXPECT_TRUE(ring[k] == gap || points.position(ring[k]) == whole.points.position(expected[k]));
    }
  }
}

TEST(Stars, WhetherARingHasAGapIsKnownThroughChangesAndRenumbering) {
  const std::vector<std::vector<LocalIndex>> rings{
      {1, 2, 3}, {0, gap, 2, 3}, {0, 1, 3, 4, 5, 6, 7, 8, 9, 10}, {0, 1, gap, 2, 4, 5, 6, 7, 8, 9, 10}, {}};
  StarTable stars;
  stars.reset(11);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    stars.store(static_cast<LocalIndex>(i), rings[i]);
    stars.set_certain(static_cast<LocalIndex>(i), true);
  }
  const auto gaps = [&] {
    std::vector<LocalIndex> sites;
    for (LocalIndex i = 0; i < stars.size(); ++i)
      if (stars.has_gap(i))
        sites.push_back(i);
    return sites;
  };
  EXPECT_EQ(gaps(), (std::vector<LocalIndex>{1, 3}));
  EXPECT_TRUE(stars.certain(1) && stars.certain(2) && !stars.certain(5));
  stars.renumber(std::vector<LocalIndex>{10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0}, 11);
  EXPECT_EQ(gaps(), (std::vector<LocalIndex>{7, 9}));
  EXPECT_FALSE(stars.certain(9));
  stars.store(9, rings[0]);
  stars.clear(7);
  stars.store(4, rings[1]);
  EXPECT_EQ(gaps(), (std::vector<LocalIndex>{4}));
}

/// Once a warm ring with a neighbour beyond the window of the search (radius above the cap) was taken for right
/// although a site had come into one of its discs: the far member balanced the intruder in the count.
TEST(Stars, WarmRingWithAFarMemberIsNotTrusted) {
  const geometry::Box box{{0, 0}, {16, 16}};
  const geometry::Lattice lattice(box);
  const mesh::TileGrid grid(box, {16, 16, 1.0});
  const std::vector<Vec2> places{
      {8.1, 8.1}, {13.6, 8.1}, {7.6, 8.7}, {7.6, 7.5}, {8.5, 8.2}}; // p, A far, B, C, intruder
  SiteList sites;
  for (const Vec2 p : places)
    sites.push_back({lattice.snap(p)});
  mesh::BinnedPoints points(grid);
  std::vector<LocalIndex> index;
  points.assign_owned(sites, 0, grid.tile_count(), &index);
  const StarBuilder builder(lattice, 1.0);
  std::vector<StarWish> wanted(sites.size(), StarWish::none);
  wanted[static_cast<std::size_t>(index[0])] = StarWish::compute;
  const auto ring_from = [&](const std::vector<LocalIndex>& last) {
    StarTable stars;
    stars.reset(points.owned());
    stars.store(index[0], last);
    std::vector<mesh::BinRef> missing;
    builder.update(points, stars, {}, wanted, missing);
    const auto ring = stars.ring(index[0]);
    return std::vector<LocalIndex>(ring.begin(), ring.end());
  };
  EXPECT_EQ(ring_from({index[1], index[2], index[3]}), ring_from({}));
}

} // namespace
} // namespace trime::delaunay
