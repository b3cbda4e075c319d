// SPDX-License-Identifier: BSD-3-Clause
// Divides chords in rounds: each round divides all chords that violate a condition, until no chord does.
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

/// The contiguous part of some work that this rank does.
struct Share {
  int rank = 0, ranks = 1;
  std::int64_t first(std::int64_t all) const { return all / ranks * rank + all % ranks * rank / ranks; }
  std::int64_t last(std::int64_t all) const { return all / ranks * (rank + 1) + all % ranks * (rank + 1) / ranks; }
};

/// @brief Lays out the sites of a boundary loop by loop, and then divides chords in rounds. Two steps may be shared
/// among ranks; their results are joined in the order of the ranks. See make_boundary_sites.
class BoundaryRefiner {
public:
  /// @param affordable dividing ends at this number of sites, because then the caller only needs to know that there are
  /// too many
  BoundaryRefiner(const geometry::Boundary& boundary, const BoundarySizes& sizes, const geometry::Lattice& lattice,
                  double corner_angle, std::span<const geometry::Vec2> inside, const FeatureRule& rule,
                  std::size_t affordable);

  /// A chord to divide, and the reason.
  struct Cut {
    LocalIndex chord;
    LocalIndex intruder;   // site in its disc; -1 if the reason is the curve itself or a point inside
    LocalIndex point = -1; // point inside the shape that lies in its disc, or -1
  };

  /// Makes the first layout.
  std::vector<LoopSite> lay_out(const Share& share) const;
  /// Takes the sites of all shares. @return the chords of this share that must be divided
  std::vector<Cut> begin(std::vector<LoopSite> laid, const Share& share);
  /// @brief Divides chords until all conditions hold. A change at one place may spread along the whole boundary, one
  /// chord per round.
  /// @param cuts the chords to divide, of all shares
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
    LocalIndex junction = -1; // piece that starts there; -1 within a piece
  };
  CutPlace cut_place(const Site& a, const Site& b, double end) const;
  /// The result of checking a chord.
  struct ChordRecord {
    double squared_length = 0;
    LocalIndex left_out = 0; ///< corners between the site and its next
    double deviation = 0;    ///< largest deviation of these corners, over the local size
  };
  /// Returns the sites in the order of the result, loop by loop. @param loop_start receives where each loop begins
  std::vector<LocalIndex> along_loops(std::vector<LocalIndex>& loop_start) const;
  /// @param result receives the site where the chord starts, without its neighbours
  ChordRecord chord_from(LocalIndex k, polygon::BoundarySite& result) const;
  [[noreturn]] void fail(const Cut& cut) const;

  const Site& next(const Site& site) const { return sites_[site.next]; }
  /// Returns t of the end of the chord that starts at `site`, unwrapped.
  double end_t(const Site& site) const {
    const double t = next(site).t;
    return t > site.t ? t : t + metrics_[site.loop].total();
  }
  /// Returns the end of the chord that starts at `site`, on the unrolled loop.
  geometry::Vec2 end_of(const Site& site) const {
    const Site& b = next(site);
    return b.t > site.t ? b.position : b.position + metrics_[site.loop].loop().winding;
  }
  /// Returns how far the chord that starts at `site` may pass from corners.
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
  std::vector<LoopMetric> metrics_; // metrics of the remaining loops
  std::vector<Site> sites_;
  std::vector<LocalIndex> loop_first_; // some site of each loop, which remains its first
  std::vector<SiteTree> trees_;        // trees of all sites; each is more than twice as large as the next
  std::optional<SegmentWatch> watch_;  // watch of all chords, after a few rounds
  std::size_t most_sites_ = 0;         // a larger number is certainly not wanted
  const std::size_t affordable_;       // limit of the caller
  bool overfull_ = false;
  LocalIndex halvings_ = 0;
  int rounds_ = 0;
};

/// @brief Lays out the sites of a boundary for an absolute element size, by all ranks together. Collective. If one rank
/// throws, all ranks throw.
///
/// A junction of two pieces that turns by more than `corner_angle` degrees is a corner; `rule` says which corners and
/// loops are left out. Between corners that are certainly kept, or along a whole loop without corners, the sites lie at
/// equal quantiles of the integral of ds/h. Where corners in between may be left out, a shortest path chooses the
/// corners that stay, and places between them (site_path.hpp). Where two arms meet at less than 60 degrees, both get
/// sites at equal distances from the corner until their gap reaches h (shells; Ruppert 1995). Then a chord is divided
/// while another site lies in its diametral disc, or the curve between its ends leaves that disc, or the curve turns by
/// more than 60 degrees and deviates from the chord by more than the tolerance. It is divided in the middle, or, next
/// to a sharp corner, on a power-of-two radius (concentric shells), so that the process ends for any angle. Points of
/// `inside` must not lie in the discs either. Sites always lie on the curve. Deterministic; O(B log^2 B) for B sites
/// and pieces.
/// @throws GeometryError with the place if two parts of the boundary are too close to separate, or if the size needs
/// more than 2^27 sites
/// @param make_ready returns the refiner of this rank, which is the same on all ranks; does not communicate
polygon::BoundarySites make_boundary_sites(const comm::Communicator& comm,
                                           const std::function<std::unique_ptr<BoundaryRefiner>()>& make_ready);

} // namespace trime::boundary
