// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary as a list in which the rounds of the clean-up change some.
#include "meshing/boundary_chain.hpp"
#include "meshing/boundary_sites.hpp"

#include "support/boundary_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

namespace trime::meshing {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using testing::unit_lattice;
using Kind = BoundaryEdit::Kind;

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
  chain.apply({square.edit(Kind::slide, 3, 0.2, 1), square.edit(Kind::remove, 6, 0, 2)});
  chain.apply({square.edit(Kind::insert, 8, 0.5, 1)});
  EXPECT_EQ(chain.sites().sites[8].next, made);
  EXPECT_EQ(chain.sites().sites[static_cast<std::size_t>(made)].next, 9);
  BoundarySites by_rounds = square.sites, at_once = square.sites;
  const std::vector<LocalIndex> new_index = chain.finish(by_rounds);
  std::vector<BoundaryEdit> edits{square.edit(Kind::slide, 3, 0.2, 0), square.edit(Kind::remove, 6, 0, 0),
                                  square.edit(Kind::insert, 8, 0.5, 0)};
  std::vector<LocalIndex> inserted;
  edit_boundary(at_once, square.curve, edits, inserted);
  ASSERT_EQ(by_rounds.sites.size(), at_once.sites.size());
  for (std::size_t k = 0; k < at_once.sites.size(); ++k)
    EXPECT_EQ(by_rounds.sites[k].position, at_once.sites[k].position);
  EXPECT_EQ(new_index[6], -1);
  EXPECT_EQ(new_index[9], 9); // one went before it, one came
  EXPECT_EQ(new_index[static_cast<std::size_t>(made)], 8);
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
  for (const Kind kind : {Kind::slide, Kind::remove}) {
    BoundaryChain chain(square.sites, square.curve);
    EXPECT_THROW(chain.apply({square.edit(Kind::slide, 4, 0.1, 1), square.edit(kind, 4, 0.2, 2)}), InternalError);
    chain.apply({square.edit(Kind::slide, 4, 0.1, 1)});
    chain.apply({square.edit(kind, 4, 0.2, 2)}); // another round
  }
}

} // namespace
} // namespace trime::meshing
