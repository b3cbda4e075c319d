// SPDX-License-Identifier: BSD-3-Clause
// Boundary sites that move, come and go: in rounds, and numbered along the loops again.
#include "polygon/boundary_chain.hpp"
#include "support/laid_sites.hpp"

#include "polygon/chord_curve.hpp"
#include "support/boundary_edits.hpp"
#include "support/boundary_shapes.hpp"
#include "support/periodic_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::polygon {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::edited;
using testing::loop_of;
using testing::make_boundary_sites;
using testing::polygon_loop;
using testing::unit_lattice;
using Kind = EditKind;

Boundary square_and_hole() {
  Boundary boundary = boundary_of(
      {polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}), circle_loop({0.5, 0.5}, 0.2, true, 4, 2)});
  boundary.part_names = {"below", "right", "above", "left", "hole"};
  for (int k = 0; k < 4; ++k) {
    boundary.loops[0].pieces[static_cast<std::size_t>(k)].part = k;
    boundary.loops[1].pieces[static_cast<std::size_t>(k)].part = 4;
  }
  return boundary;
}

BoundarySites sites_of(const Boundary& boundary, double h) {
  return make_boundary_sites(boundary, UniformSize(h), unit_lattice(), 30);
}

void expect_near(Vec2 a, Vec2 b, double tolerance = 1e-12) {
  EXPECT_LT(geometry::length(a - b), tolerance) << a.x << " " << a.y << " and " << b.x << " " << b.y;
}

/// The new place of an edit, as the clean-up finds it.
BoundaryEdit edit_at(const BoundarySites& sites, const BoundaryCurve& curve, LocalIndex site, Kind kind, double arc) {
  const Vec2 point = curve.place(loop_of(sites, site), arc).point;
  return {site, kind, arc, sites.periods.wrap(unit_lattice().snap(point))};
}

double arc_of(const BoundarySites& sites, const BoundaryCurve& curve, LocalIndex k) {
  return curve.arc(loop_of(sites, k), sites.sites[static_cast<std::size_t>(k)]);
}

/// Half of the way from site k to its next, which may be the first of the loop.
double arc_between(const BoundarySites& sites, const BoundaryCurve& curve, LocalIndex k) {
  const double from = arc_of(sites, curve, k);
  double to = arc_of(sites, curve, sites.sites[static_cast<std::size_t>(k)].next);
  to += to <= from ? curve.length(loop_of(sites, k)) : 0;
  const double middle = 0.5 * (from + to), length = curve.length(loop_of(sites, k));
  return middle >= length ? middle - length : middle;
}

/// Order, links, places, chords and names.
void expect_sound(const BoundarySites& sites, const BoundaryCurve& curve) {
  ASSERT_EQ(sites.loop_start.size(), curve.boundary().loops.size() + 1);
  EXPECT_EQ(sites.loop_start.front(), 0);
  EXPECT_EQ(sites.loop_start.back(), static_cast<LocalIndex>(sites.sites.size()));
  double shortest = INFINITY;
  for (std::size_t loop = 0; loop + 1 < sites.loop_start.size(); ++loop) {
    const LocalIndex first = sites.loop_start[loop], last = sites.loop_start[loop + 1] - 1;
    const double length = curve.length(static_cast<LocalIndex>(loop));
    Vec2 way{};
    double along = 0;
    for (LocalIndex k = first; k <= last; ++k) {
      const BoundarySite& site = sites.sites[static_cast<std::size_t>(k)];
      EXPECT_EQ(site.next, k == last ? first : k + 1);
      EXPECT_EQ(site.previous, k == first ? last : k - 1);
      EXPECT_EQ(site.tag, curve.boundary().loops[loop].tag);
      EXPECT_EQ(loop_of(sites, k), static_cast<LocalIndex>(loop));
      const Vec2 place = curve.place(static_cast<LocalIndex>(loop), arc_of(sites, curve, k)).point;
      expect_near(sites.periods.nearest_image(site.position, place), place);
      const geometry::Segment chord = sites.chord(k);
      EXPECT_LT(geometry::length(chord.b - chord.a), 0.5) << "goes the short way";
      way = way + (chord.b - chord.a);
      shortest = std::fmin(shortest, geometry::length(chord.b - chord.a));
      const double step = arc_of(sites, curve, site.next) - arc_of(sites, curve, k);
      along += step <= 0 ? step + length : step;
    }
    EXPECT_EQ(way, curve.boundary().loops[loop].winding);
    EXPECT_NEAR(along, length, 1e-12) << "once around, in order";
  }
  EXPECT_EQ(sites.shortest, shortest);
  BoundarySites renamed = sites;
  name_parts(curve.boundary(), renamed);
  for (std::size_t k = 0; k < sites.sites.size(); ++k)
    EXPECT_EQ(sites.sites[k].part, renamed.sites[k].part);
}

/// A square with sites 0.05 apart, and edits of them by their places.
struct Square {
  Boundary boundary =
      testing::boundary_of({testing::polygon_loop({{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}})});
  BoundaryCurve curve{boundary};
  BoundarySites sites = make_boundary_sites(boundary, sizing::UniformSize(0.05), unit_lattice(), 30);

  /// @param share of the chord from `site` to the next
  BoundaryEdit edit(Kind kind, LocalIndex site, double share, std::uint64_t patch) const {
    const BoundarySite& its = sites.sites[static_cast<std::size_t>(site)];
    const geometry::Segment chord = sites.chord(site);
    const double arc = curve.arc(0, its) + share * geometry::length(chord.b - chord.a);
    return {site, kind, arc, unit_lattice().snap(curve.place(0, arc).point), patch};
  }
};

TEST(BoundaryChain, RoundsGiveWhatOneEditOfAllGives) {
  const Square square;
  BoundaryChain chain(square.sites, square.curve);
  const LocalIndex made = static_cast<LocalIndex>(square.sites.sites.size());
  const BoundaryEdit slide = square.edit(Kind::move, 3, 0.2, 1), removal = square.edit(Kind::remove, 6, 0, 2),
                     insertion = square.edit(Kind::insert, 8, 0.5, 1);
  chain.apply({slide, removal});
  chain.apply({insertion});
  EXPECT_EQ(chain.sites().sites[8].next, made);
  EXPECT_EQ(chain.sites().sites[static_cast<std::size_t>(made)].next, 9);
  const std::vector<LocalIndex> new_index = chain.renumber();
  const BoundarySites by_rounds = chain.sites(),
                      at_once = edited(square.sites, square.curve, {slide, removal, insertion}).sites;
  ASSERT_EQ(by_rounds.sites.size(), at_once.sites.size());
  for (std::size_t k = 0; k < at_once.sites.size(); ++k)
    EXPECT_EQ(by_rounds.sites[k].position, at_once.sites[k].position);
  EXPECT_EQ(new_index[6], -1);
  EXPECT_EQ(new_index[9], 9); // one went before it, one came
  EXPECT_EQ(new_index[static_cast<std::size_t>(made)], 8);
  expect_sound(by_rounds, square.curve);
}

/// All sites of a circle give way to others, the first ones of its numbers too.
TEST(BoundaryChain, ALoopMayLoseAllItsOldSites) {
  const Boundary boundary = boundary_of({circle_loop({0.3, 0.5}, 0.1), circle_loop({0.7, 0.5}, 0.1)});
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.04);
  BoundaryChain chain(before, curve);
  std::vector<BoundaryEdit> insertions, removals;
  for (LocalIndex k = 0; k < before.loop_start[1]; ++k) {
    insertions.push_back(edit_at(before, curve, k, Kind::insert, arc_between(before, curve, k)));
    removals.push_back({k, Kind::remove, 0, {}});
  }
  chain.apply(insertions);
  chain.apply(removals);
  const std::vector<LocalIndex> new_index = chain.renumber();
  expect_sound(chain.sites(), curve);
  EXPECT_EQ(chain.sites().loop_start, before.loop_start);
  EXPECT_EQ(new_index[0], -1);
  EXPECT_EQ(new_index[static_cast<std::size_t>(before.loop_start[1])], before.loop_start[1]);
}

TEST(BoundaryChain, WhatIsGoneCannotChange) {
  const Square square;
  BoundaryChain chain(square.sites, square.curve);
  chain.apply({square.edit(Kind::remove, 4, 0, 1)});
  for (const Kind kind : {Kind::move, Kind::remove, Kind::insert})
    EXPECT_THROW(chain.apply({square.edit(kind, 4, 0.1, 1)}), InternalError);
}

TEST(BoundaryChain, OnePatchMayDivideAChordTwiceTwoMayNot) {
  const Square square;
  for (const std::uint64_t other : {7, 8}) {
    BoundaryChain chain(square.sites, square.curve);
    const std::vector<BoundaryEdit> edits{square.edit(Kind::insert, 5, 0.7, 7),
                                          square.edit(Kind::insert, 5, 0.3, other)};
    if (other != 7) {
      EXPECT_THROW(chain.apply(edits), InternalError);
      continue;
    }
    chain.apply(edits);
    const auto second = static_cast<std::size_t>(chain.sites().sites[5].next);
    EXPECT_EQ(chain.sites().sites[second].position, edits[1].position);
    EXPECT_EQ(chain.sites().sites[static_cast<std::size_t>(chain.sites().sites[second].next)].position,
              edits[0].position);
  }
}

TEST(BoundaryChain, ASiteChangesOnceInARound) {
  const Square square;
  for (const Kind kind : {Kind::move, Kind::remove}) {
    BoundaryChain chain(square.sites, square.curve);
    EXPECT_THROW(chain.apply({square.edit(Kind::move, 4, 0.1, 1), square.edit(kind, 4, 0.2, 2)}), InternalError);
    chain.apply({square.edit(Kind::move, 4, 0.1, 1)});
    chain.apply({square.edit(kind, 4, 0.2, 2)}); // another round
  }
}

TEST(BoundaryChain, NothingToDoLeavesAllAsItWas) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.07);
  const auto [sites, new_index] = edited(before, curve, {});
  ASSERT_EQ(new_index.size(), before.sites.size());
  for (std::size_t k = 0; k < new_index.size(); ++k) {
    EXPECT_EQ(new_index[k], static_cast<LocalIndex>(k));
    EXPECT_EQ(sites.sites[k].position, before.sites[k].position);
    EXPECT_EQ(sites.sites[k].next_shift, before.sites[k].next_shift);
  }
  EXPECT_EQ(sites.corners, before.corners);
  expect_sound(sites, curve);
}

/// Patches that overlap would do that.
TEST(BoundaryChain, RefusesTwoChangesOfOneSiteOrChord) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.07);
  const double arc = arc_between(before, curve, 5);
  const Vec2 place = curve.place(0, arc).point;
  for (const Kind kind : {Kind::move, Kind::insert})
    EXPECT_THROW(edited(before, curve, {2, {5, kind, arc, place}}), InternalError);
}

/// As where a patch refines: they stand in the order of the curve, also around the start of the loop.
TEST(BoundaryChain, OneChordCanGetSeveralSitesOfOnePatch) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.07);
  for (const LocalIndex k : {0, 5, before.loop_start[1] - 1, before.loop_start[2] - 1}) {
    const double from = arc_of(before, curve, k), length = curve.length(loop_of(before, k));
    const double way = 2 * (arc_between(before, curve, k) - from);
    std::vector<BoundaryEdit> edits;
    for (const double share : {0.75, 0.25, 0.5}) {
      const double arc = std::fmod(from + share * way, length);
      edits.push_back(edit_at(before, curve, k, Kind::insert, arc));
      edits.back().patch = 7;
    }
    const auto [sites, new_index] = edited(before, curve, edits);
    expect_sound(sites, curve);
    ASSERT_EQ(sites.sites.size(), before.sites.size() + 3);
    for (const auto& [edit, behind] : {std::pair{edits[0], 3}, {edits[1], 1}, {edits[2], 2}})
      EXPECT_EQ(sites.sites[static_cast<std::size_t>(k + behind)].position, edit.position);
    edits[1].patch = 8;
    EXPECT_THROW(edited(before, curve, edits), InternalError);
  }
}

/// At each site of both loops, the first and the last ones included: slide, insertion and removal.
TEST(BoundaryChain, EachSiteCanSlideGoAndGetANewNext) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.07);
  const auto count = static_cast<LocalIndex>(before.sites.size());
  for (LocalIndex k = 0; k < count; ++k)
    for (const Kind kind : {Kind::move, Kind::remove, Kind::insert}) {
      const BoundarySite& old = before.sites[static_cast<std::size_t>(k)];
      if (old.corner && kind != Kind::insert)
        continue;
      const double arc = kind == Kind::move ? arc_of(before, curve, k) + 0.01 : arc_between(before, curve, k);
      const BoundaryEdit edit = edit_at(before, curve, k, kind, arc);
      const auto [sites, new_index] = edited(before, curve, {edit});
      SCOPED_TRACE(fmt::format("site {}, kind {}", k, static_cast<int>(kind)));
      expect_sound(sites, curve);
      const int change = kind == Kind::insert ? 1 : kind == Kind::remove ? -1 : 0;
      EXPECT_EQ(static_cast<LocalIndex>(sites.sites.size()), count + change);
      for (LocalIndex j = 0; j < count; ++j) {
        const LocalIndex expected = j < k ? j : j > k ? j + change : kind == Kind::remove ? -1 : j;
        ASSERT_EQ(new_index[static_cast<std::size_t>(j)], expected);
        if (j != k) {
          ASSERT_EQ(sites.sites[static_cast<std::size_t>(expected)].position,
                    before.sites[static_cast<std::size_t>(j)].position);
        }
      }
      ASSERT_EQ(new_index.size(), before.sites.size() + (kind == Kind::insert));
      if (kind == Kind::move) {
        EXPECT_EQ(sites.sites[static_cast<std::size_t>(k)].position, edit.position);
      }
      if (kind == Kind::insert) {
        EXPECT_EQ(new_index.back(), k + 1);
        const BoundarySite& made = sites.sites[static_cast<std::size_t>(k) + 1];
        EXPECT_EQ(made.position, edit.position);
        EXPECT_FALSE(made.corner);
        EXPECT_EQ(sites.sites[static_cast<std::size_t>(k)].corner, old.corner);
      }
    }
}

TEST(BoundaryChain, ManyEditsAtOnceInAnyOrder) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.04);
  std::vector<BoundaryEdit> edits;
  LocalIndex removed = 0, added = 0;
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(before.sites.size()); ++k) {
    const bool stays = before.sites[static_cast<std::size_t>(k)].corner || k % 4 != 2;
    if (k % 3 == 1 && stays) {
      edits.push_back(edit_at(before, curve, k, Kind::insert, arc_between(before, curve, k)));
      ++added;
    }
    if (!stays) {
      edits.push_back({k, Kind::remove, 0, {}});
      ++removed;
    } else if (k % 4 == 0 && !before.sites[static_cast<std::size_t>(k)].corner)
      edits.push_back(edit_at(before, curve, k, Kind::move, arc_of(before, curve, k) + 0.005));
  }
  ASSERT_GT(removed, 10);
  ASSERT_GT(added, 10);
  const auto [sites, new_index] = edited(before, curve, edits);
  EXPECT_EQ(edited(before, curve, {edits.rbegin(), edits.rend()}).new_index, new_index);
  expect_sound(sites, curve);
  EXPECT_EQ(sites.sites.size(), before.sites.size() + static_cast<std::size_t>(added - removed));
  EXPECT_EQ(std::count(new_index.begin(), new_index.end(), -1), removed);
  for (const BoundaryEdit& edit : edits) {
    const LocalIndex k = new_index[static_cast<std::size_t>(edit.site)];
    ASSERT_EQ(k >= 0, edit.kind != Kind::remove);
    if (k >= 0) {
      EXPECT_EQ(sites.sites[static_cast<std::size_t>(edit.kind == Kind::insert ? k + 1 : k)].position, edit.position);
    }
  }
  for (std::size_t k = 0; k < sites.sites.size(); ++k) // each side of the square keeps its name
    EXPECT_EQ(sites.sites[k].part == 4, loop_of(sites, static_cast<LocalIndex>(k)) == 1);
}

/// A site past the start of its loop stays the last (or the first) one: only the order around counts.
TEST(BoundaryChain, SitesSlidePastTheStartOfALoop) {
  const Boundary boundary = boundary_of({circle_loop({0.5, 0.5}, 0.3)});
  const BoundaryCurve curve(boundary);
  BoundarySites sites = sites_of(boundary, 0.1);
  const double h = curve.length(0) / static_cast<double>(sites.sites.size());
  const auto last = static_cast<LocalIndex>(sites.sites.size()) - 1;
  std::vector<BoundaryEdit> edits;
  for (LocalIndex k = 0; k <= last; ++k) {
    const double arc = arc_of(sites, curve, k) + 1.2 * h; // all of them, the last one over the start
    edits.push_back(edit_at(sites, curve, k, Kind::move, arc >= curve.length(0) ? arc - curve.length(0) : arc));
  }
  sites = edited(sites, curve, edits).sites;
  expect_sound(sites, curve);
  EXPECT_LT(arc_of(sites, curve, last), arc_of(sites, curve, 0));
  const std::vector<LocalIndex> new_index =
      edited(sites, curve,
             {edit_at(sites, curve, last - 1, Kind::insert, arc_between(sites, curve, last - 1)),
              {last, Kind::remove, 0, {}}})
          .new_index;
  EXPECT_EQ(new_index[static_cast<std::size_t>(last)], -1);
  EXPECT_EQ(new_index.back(), last);
}

TEST(BoundaryChain, ChordsOfPeriodicBoundariesLeadToTheNearestImage) {
  for (const shape::RegionShape& shape : testing::periodic_shapes()) {
    if (shape.boundary().loops.empty())
      continue;
    SCOPED_TRACE(shape.region().text());
    const BoundaryCurve curve(shape.boundary());
    BoundarySites sites = sites_of(shape.boundary(), 0.05);
    expect_sound(sites, curve);
    for (int round = 0; round < 3; ++round) {
      std::vector<BoundaryEdit> edits;
      for (LocalIndex k = round % 2; k < static_cast<LocalIndex>(sites.sites.size()); k += 2) {
        if (round == 1 && !sites.sites[static_cast<std::size_t>(k)].corner) {
          edits.push_back({k, Kind::remove, 0, {}});
          continue;
        }
        edits.push_back(edit_at(sites, curve, k, Kind::insert, arc_between(sites, curve, k)));
      }
      sites = edited(sites, curve, edits).sites;
      expect_sound(sites, curve);
      for (const BoundarySite& site : sites.sites)
        EXPECT_EQ(site.position, sites.periods.wrap(site.position));
    }
  }
}

} // namespace
} // namespace trime::polygon
