// SPDX-License-Identifier: BSD-3-Clause
// Rounds of halving: all chords that offend are divided at once, until none does.
#pragma once

#include "boundary/boundary_layout.hpp"
#include "boundary/boundary_sizes.hpp"
#include "boundary/feature_rule.hpp"
#include "boundary/loop_metric.hpp"
#include "boundary/segment_watch.hpp"
#include "boundary/site_tree.hpp"
#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace trime::boundary {

/// The part of some work that this rank does: a contiguous one.
struct Share {
  int rank = 0, ranks = 1;
  std::int64_t first(std::int64_t all) const { return all / ranks * rank + all % ranks * rank / ranks; }
  std::int64_t last(std::int64_t all) const { return all / ranks * (rank + 1) + all % ranks * (rank + 1) / ranks; }
};

/// @brief The sites of a boundary laid out loop by loop, then divided in rounds: all chords that offend at once,
/// until none does. Two steps may be shared among ranks; what they make is joined in the order of the ranks. See
/// make_boundary_sites.
class BoundaryRefiner {
public:
  /// @param affordable halving ends at this number of sites: the caller only wants to know that there are too many
  BoundaryRefiner(const geometry::Boundary& boundary, const BoundarySizes& sizes, const geometry::Lattice& lattice,
                  double corner_angle, std::span<const geometry::Vec2> inside, const FeatureRule& rule,
                  std::size_t affordable);

  /// A chord to divide and why.
  struct Cut {
    LocalIndex chord;
    LocalIndex intruder;   // site in its disc, -1: because of the curve itself or of a point inside
    LocalIndex point = -1; // point inside the shape that lies in its disc
  };

  /// The first layout.
  std::vector<LoopSite> lay_out(const Share& share) const;
  /// Takes the sites of all shares. @return the chords among a share of them that offend
  std::vector<Cut> begin(std::vector<LoopSite> laid, const Share& share);
  /// @brief Ends, since each round adds a site: a change in one place may run through the whole boundary, a chord a
  /// round.
  /// @param cuts of all shares
  void run(std::vector<Cut> cuts);
  polygon::BoundarySites result() const;

private:
  struct Site {
    double t;
    geometry::Vec2 position; // on the unrolled loop
    LocalIndex previous, next;
    std::int32_t loop;
    SiteKind kind;
  };
  void add_loop(std::span<const LoopSite> loop_sites);
  void look_at_fresh(LocalIndex chord, std::vector<Cut>& cuts) const;
  std::vector<Cut> find_cuts(const std::vector<LocalIndex>& fresh_sites, const std::vector<LocalIndex>& fresh_chords);
  std::vector<LocalIndex> candidates(const std::vector<LocalIndex>& fresh_sites,
                                     const std::vector<LocalIndex>& fresh_chords);
  LocalIndex find_intruder(const SiteTree& tree, LocalIndex chord, bool foreign = false) const;
  SiteTree tree_of(std::span<const geometry::Vec2> points) const;
  bool curve_offends(LocalIndex chord) const;
  LocalIndex divide(const Cut& cut);
  struct CutPlace {
    double t;
    LocalIndex junction = -1; // the piece that starts there
  };
  CutPlace cut_place(const Site& a, const Site& b, double end) const;
  /// The result of checking a chord.
  struct ChordRecord {
    double squared_length = 0;
    LocalIndex left_out = 0; ///< corners between the site and its next
    double deviation = 0;    ///< of them, over the local size
  };
  /// @param result the site where it starts, without its neighbours
  ChordRecord chord_from(LocalIndex k, polygon::BoundarySite& result) const;
  [[noreturn]] void fail(const Cut& cut) const;

  const Site& next(const Site& site) const { return sites_[site.next]; }
  /// t of the end of the chord that starts at `site`, unwrapped.
  double end_t(const Site& site) const {
    const double t = next(site).t;
    return t > site.t ? t : t + metrics_[site.loop].total();
  }
  /// End of the chord that starts at `site`, on the unrolled loop.
  geometry::Vec2 end_of(const Site& site) const {
    const Site& b = next(site);
    return b.t > site.t ? b.position : b.position + metrics_[site.loop].loop().winding;
  }
  /// How far the chord that starts at `site` may pass from corners.
  double tolerance(const Site& site) const { return tolerance_.at(metrics_[site.loop].sizes(site.t).asked); }
  PartSummary summarize(const Site& a) const {
    return metrics_[a.loop].summarize(a.t, end_t(a), a.position, end_of(a));
  }

  const geometry::Boundary& boundary_;
  const geometry::Lattice& lattice_;
  const double corner_angle_;
  const FeatureTolerance tolerance_;
  const std::span<const geometry::Vec2> inside_;
  const SiteTree inside_tree_;
  const polygon::DroppedLoops dropped_;
  std::vector<LoopMetric> metrics_; // of the loops that stay
  std::vector<Site> sites_;
  std::vector<LocalIndex> loop_first_; // some site of each loop that stays its first
  std::vector<SiteTree> trees_;        // of all sites, each tree more than twice as large as the next
  std::optional<SegmentWatch> watch_;  // of all chords, after some rounds
  std::size_t most_sites_ = 0;         // more than that is not what anybody wants
  const std::size_t affordable_;       // the caller's limit
  bool overfull_ = false;
  LocalIndex halvings_ = 0;
  int rounds_ = 0;
};

/// @brief Lays out the sites of a boundary for an absolute element size, by all ranks together. Collective. If one rank
/// throws, all do.
///
/// A junction of two pieces that turns by more than `corner_angle` degrees is a corner; `rule` says which corners and
/// loops are left out. Between corners that are surely kept, or along a whole loop without corners, the sites lie at
/// equal quantiles of the integral of ds/h. Where corners between them may be left out, a shortest path chooses the
/// corners that stay, and places between them (site_path.hpp). Where two arms meet at less than 60 degrees, both get
/// sites at equal distances from the corner until their gap reaches h (shells; Ruppert 1995). Then a chord is divided
/// while another site lies in its diametral disc, or the curve between its ends leaves that disc, or the curve turns by
/// more than 60 degrees and strays from the chord by more than the tolerance. It is divided in the middle, or, next to
/// a sharp corner, on a power-of-two radius (concentric shells), so that the process ends for any angle. The discs are
/// kept free of the points of `inside`, too. Sites always lie on the curve. Deterministic; O(B log^2 B) for B sites and
/// pieces.
/// @throws GeometryError with the place, if two parts of the boundary are too close to separate, or if the size asks
/// for more than 2^27 sites
/// @param make_ready returns the refiner of this rank: the same on all ranks; does not communicate
polygon::BoundarySites make_boundary_sites(const comm::Communicator& comm,
                                           const std::function<std::unique_ptr<BoundaryRefiner>()>& make_ready);

} // namespace trime::boundary
