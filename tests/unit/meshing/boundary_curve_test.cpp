// SPDX-License-Identifier: BSD-3-Clause
// Places on the boundary by arc length, and sites that slide, come and go there.
#include "meshing/boundary_curve.hpp"

#include "meshing/boundary_sites.hpp"
#include "meshing/chord_curve.hpp"
#include "support/boundary_shapes.hpp"
#include "support/periodic_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;
using testing::unit_lattice;
using Kind = BoundaryEdit::Kind;

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

TEST(BoundaryCurve, FindsThePlaceOfAnArcAndBack) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  EXPECT_NEAR(curve.length(0), 3.2, 1e-12);
  EXPECT_NEAR(curve.length(1), 2 * pi * 0.2, 1e-12);
  for (const LocalIndex loop : {0, 1}) {
    const double length = curve.length(loop);
    for (int k = -40; k < 80; ++k) {
      const double arc = length * (k + 0.3) / 40;
      const BoundaryCurve::Place place = curve.place(loop, arc);
      BoundarySite site{};
      site.piece = place.piece;
      site.along = place.along;
      const double turns = std::floor(arc / length);
      EXPECT_NEAR(curve.arc(loop, site) + turns * length, arc, 1e-12);
      EXPECT_NEAR(geometry::length(place.tangent), 1, 1e-12);
      const Vec2 ahead = curve.place(loop, arc + 1e-7).point;
      expect_near((1e7) * (ahead - place.point), place.tangent, 1e-5);
      if (loop == 1) {
        EXPECT_NEAR(geometry::length(place.point - Vec2{0.5, 0.5}), 0.2, 1e-12);
      }
    }
  }
  expect_near(curve.place(0, 0).point, {0.1, 0.1});
  expect_near(curve.place(0, 0.8).point, {0.9, 0.1});
  expect_near(curve.place(0, 1.0).point, {0.9, 0.3});
  expect_near(curve.place(0, -0.2).point, {0.1, 0.3});
  expect_near(curve.place(0, curve.length(0)).point, {0.1, 0.1});
  expect_near(curve.place(0, curve.length(0) + 0.2).point, {0.3, 0.1});
  expect_near(curve.place(1, 0.5 * pi * 0.2).point, {0.5, 0.3}); // clockwise around the hole
}

/// Of lengths from 1e-7 to 0.8, many in one part of the loop: at junctions, just before and behind them.
TEST(BoundaryCurve, FindsThePlaceAmongPiecesOfVeryDifferentLengths) {
  std::vector<Vec2> corners{{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}};
  for (int k = 0; k < 40; ++k) // a zigzag that becomes finer and finer
    corners.push_back({0.8 * std::pow(0.7, k) + 0.1, k % 2 ? 0.9 : 0.9 - 0.1 * std::pow(0.7, k)});
  const Boundary boundary = boundary_of({polygon_loop(corners)});
  const BoundaryCurve curve(boundary);
  const std::vector<geometry::Piece>& pieces = boundary.loops[0].pieces;
  double start = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    EXPECT_EQ(curve.place(0, start).piece, static_cast<LocalIndex>(k));
    EXPECT_EQ(curve.place(0, start).along, 0);
    EXPECT_EQ(curve.place(0, std::nextafter(start, 10)).piece, static_cast<LocalIndex>(k));
    if (k > 0) {
      EXPECT_EQ(curve.place(0, std::nextafter(start, 0)).piece, static_cast<LocalIndex>(k) - 1);
    }
    EXPECT_EQ(curve.place(0, start + 0.5 * pieces[k].length()).piece, static_cast<LocalIndex>(k));
    start += pieces[k].length();
  }
  EXPECT_EQ(curve.place(0, std::nextafter(start, 0)).piece, static_cast<LocalIndex>(pieces.size()) - 1);
  EXPECT_EQ(curve.place(0, start).piece, 0) << "the end is the start";
}

TEST(BoundaryCurve, ALoopThatWindsGoesOnInTheNextImage) {
  const geometry::RegionShape shape = testing::band();
  const BoundaryCurve curve(shape.boundary());
  for (LocalIndex loop = 0; loop < 2; ++loop) {
    const Vec2 winding = shape.boundary().loops[static_cast<std::size_t>(loop)].winding;
    const double length = curve.length(loop);
    EXPECT_NEAR(length, 1, 1e-12);
    expect_near(curve.place(loop, length + 0.25).point, curve.place(loop, 0.25).point + winding);
    expect_near(curve.place(loop, -0.25).point, curve.place(loop, 0.75).point - winding);
  }
}

TEST(EditBoundary, NothingToDoLeavesAllAsItWas) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  BoundarySites sites = sites_of(boundary, 0.07);
  const BoundarySites before = sites;
  std::vector<BoundaryEdit> edits;
  std::vector<LocalIndex> inserted{7};
  const std::vector<LocalIndex> new_index = edit_boundary(sites, curve, edits, inserted);
  EXPECT_TRUE(inserted.empty());
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
TEST(EditBoundary, RefusesTwoChangesOfOneSiteOrChord) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.07);
  const double arc = arc_between(before, curve, 5);
  const Vec2 place = curve.place(0, arc).point;
  for (const BoundaryEdit::Kind kind : {BoundaryEdit::Kind::slide, BoundaryEdit::Kind::insert}) {
    BoundarySites sites = before;
    std::vector<BoundaryEdit> edits(2, {5, kind, arc, place});
    std::vector<LocalIndex> inserted;
    EXPECT_THROW(edit_boundary(sites, curve, edits, inserted), InternalError);
  }
}

/// As where a patch refines: they stand in the order of the curve, also around the start of the loop.
TEST(EditBoundary, OneChordCanGetSeveralSitesOfOnePatch) {
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
    std::vector<BoundaryEdit> of_two = edits;
    BoundarySites sites = before;
    std::vector<LocalIndex> inserted;
    edit_boundary(sites, curve, edits, inserted);
    expect_sound(sites, curve);
    EXPECT_EQ(sites.sites.size(), before.sites.size() + 3);
    EXPECT_EQ(inserted, (std::vector<LocalIndex>{k + 1, k + 2, k + 3}));
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_NEAR(std::fmod(edits[n].arc - from + length, length), 0.25 * static_cast<double>(n + 1) * way, 1e-9);
    of_two[1].patch = 8;
    sites = before;
    EXPECT_THROW(edit_boundary(sites, curve, of_two, inserted), InternalError);
  }
}

/// At each site of both loops, the first and the last ones included: slide, insertion and removal.
TEST(EditBoundary, EachSiteCanSlideGoAndGetANewNext) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.07);
  const auto count = static_cast<LocalIndex>(before.sites.size());
  for (LocalIndex k = 0; k < count; ++k)
    for (const Kind kind : {Kind::slide, Kind::remove, Kind::insert}) {
      const BoundarySite& old = before.sites[static_cast<std::size_t>(k)];
      if (old.corner && kind != Kind::insert)
        continue;
      const double arc = kind == Kind::slide ? arc_of(before, curve, k) + 0.01 : arc_between(before, curve, k);
      BoundarySites sites = before;
      std::vector<BoundaryEdit> edits{edit_at(before, curve, k, kind, arc)};
      std::vector<LocalIndex> inserted;
      const std::vector<LocalIndex> new_index = edit_boundary(sites, curve, edits, inserted);
      SCOPED_TRACE(fmt::format("site {}, kind {}", k, static_cast<int>(kind)));
      expect_sound(sites, curve);
      ASSERT_EQ(inserted.size(), 1u);
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
      EXPECT_EQ(inserted[0], kind == Kind::insert ? k + 1 : -1);
      if (kind == Kind::slide) {
        EXPECT_EQ(sites.sites[static_cast<std::size_t>(k)].position, edits[0].position);
      }
      if (kind == Kind::insert) {
        const BoundarySite& made = sites.sites[static_cast<std::size_t>(k) + 1];
        EXPECT_EQ(made.position, edits[0].position);
        EXPECT_FALSE(made.corner);
        EXPECT_EQ(sites.sites[static_cast<std::size_t>(k)].corner, old.corner);
      }
    }
}

TEST(EditBoundary, ManyEditsAtOnceInAnyOrder) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  const BoundarySites before = sites_of(boundary, 0.04);
  std::vector<BoundaryEdit> edits;
  LocalIndex removed = 0, added = 0;
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(before.sites.size()); ++k) {
    if (k % 3 == 1) {
      edits.push_back(edit_at(before, curve, k, Kind::insert, arc_between(before, curve, k)));
      ++added;
    }
    if (before.sites[static_cast<std::size_t>(k)].corner)
      continue;
    if (k % 4 == 0)
      edits.push_back(edit_at(before, curve, k, Kind::slide, arc_of(before, curve, k) + 0.005));
    if (k % 4 == 2) {
      edits.push_back({k, Kind::remove, 0, {}});
      ++removed;
    }
  }
  ASSERT_GT(removed, 10);
  std::vector<BoundaryEdit> backwards(edits.rbegin(), edits.rend());
  BoundarySites sites = before, others = before;
  std::vector<LocalIndex> inserted, also_inserted;
  const std::vector<LocalIndex> new_index = edit_boundary(sites, curve, edits, inserted);
  EXPECT_EQ(edit_boundary(others, curve, backwards, also_inserted), new_index);
  EXPECT_EQ(edits, backwards) << "sorted";
  EXPECT_EQ(inserted, also_inserted);
  expect_sound(sites, curve);
  EXPECT_EQ(sites.sites.size(), before.sites.size() + static_cast<std::size_t>(added - removed));
  EXPECT_EQ(std::count(new_index.begin(), new_index.end(), -1), removed);
  for (std::size_t e = 0; e < edits.size(); ++e) {
    const LocalIndex k =
        edits[e].kind == Kind::insert ? inserted[e] : new_index[static_cast<std::size_t>(edits[e].site)];
    ASSERT_EQ(k >= 0, edits[e].kind != Kind::remove);
    if (k >= 0) {
      EXPECT_EQ(sites.sites[static_cast<std::size_t>(k)].position, edits[e].position);
    }
  }
  for (std::size_t k = 0; k < sites.sites.size(); ++k) // each side of the square keeps its name
    EXPECT_EQ(sites.sites[k].part == 4, loop_of(sites, static_cast<LocalIndex>(k)) == 1);
}

/// A site past the start of its loop stays the last (or the first) one: only the order around counts.
TEST(EditBoundary, SitesSlidePastTheStartOfALoop) {
  const Boundary boundary = boundary_of({circle_loop({0.5, 0.5}, 0.3)});
  const BoundaryCurve curve(boundary);
  BoundarySites sites = sites_of(boundary, 0.1);
  const double h = curve.length(0) / static_cast<double>(sites.sites.size());
  const auto last = static_cast<LocalIndex>(sites.sites.size()) - 1;
  std::vector<BoundaryEdit> edits;
  for (LocalIndex k = 0; k <= last; ++k) {
    const double arc = arc_of(sites, curve, k) + 1.2 * h; // all of them, the last one over the start
    edits.push_back(edit_at(sites, curve, k, Kind::slide, arc >= curve.length(0) ? arc - curve.length(0) : arc));
  }
  std::vector<LocalIndex> inserted;
  edit_boundary(sites, curve, edits, inserted);
  expect_sound(sites, curve);
  EXPECT_LT(arc_of(sites, curve, last), arc_of(sites, curve, 0));
  edits = {edit_at(sites, curve, last, Kind::insert, arc_between(sites, curve, last)), {last, Kind::remove, 0, {}}};
  std::vector<LocalIndex> new_index = edit_boundary(sites, curve, edits, inserted);
  expect_sound(sites, curve);
  EXPECT_EQ(new_index.back(), -1);
  EXPECT_EQ(inserted, (std::vector<LocalIndex>{-1, last})) << "sorted: removal first";
}

TEST(EditBoundary, ChordsOfPeriodicBoundariesLeadToTheNearestImage) {
  for (const geometry::RegionShape& shape : testing::periodic_shapes()) {
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
      std::vector<LocalIndex> inserted;
      edit_boundary(sites, curve, edits, inserted);
      expect_sound(sites, curve);
      for (const BoundarySite& site : sites.sites)
        EXPECT_EQ(site.position, sites.periods.wrap(site.position));
    }
  }
}

} // namespace
} // namespace trime::meshing
