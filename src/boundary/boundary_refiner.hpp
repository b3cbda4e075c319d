// SPDX-License-Identifier: BSD-3-Clause
// Divides boundary edges (chords) in rounds: each round divides all chords that violate a condition, until no chord
// does.
#pragma once

#include "boundary/boundary_layout.hpp"
#include "boundary/boundary_sizes.hpp"
#include "boundary/feature_rule.hpp"
#include "boundary/laid_curves.hpp"
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

/// The contiguous part of some work that this rank does; `first` and `last` convert an amount of work to the range of
/// this rank.
struct Share {
  int rank = 0, ranks = 1;
  std::int64_t first(std::int64_t all) const { return all / ranks * rank + all % ranks * rank / ranks; }
  std::int64_t last(std::int64_t all) const { return all / ranks * (rank + 1) + all % ranks * (rank + 1) / ranks; }
};

/// The input of a layout in addition to curves and sizes.
struct LayoutRequest {
  double corner_angle;                      ///< [degrees] a junction that turns by more is a corner
  std::span<const geometry::Vec2> inside{}; ///< points that must not lie in the circles of chords
  std::span<const geometry::Vec2> held{};   ///< points inside the shape, whose loops are not dropped
  FeatureRule rule{};                       ///< decides which corners and loops are left out
  std::size_t affordable = 0; ///< number of sites at which dividing ends, because then the caller needs to know only
                              ///< that there are too many
};

/// @brief Places sites on a boundary and on curves inside, loop by loop, and then divides chords (edges between
/// successive sites) in rounds. Ranks may share the first two steps; their results are joined in the order of the
/// ranks. See make_boundary_sites.
class BoundaryRefiner {
public:
  BoundaryRefiner(std::shared_ptr<const LaidCurves> curves, const BoundarySizes& sizes,
                  const geometry::Lattice& lattice, const LayoutRequest& request);

  /// A chord that must be divided, and the reason.
  struct Cut {
    LocalIndex chord;
    LocalIndex intruder; // another site in the diametral circle of the chord; -1 if the reason is the curve itself or a
                         // point inside the shape
    LocalIndex point =
        -1; // point inside the shape that lies in the diametral circle of the chord; -1 if there is no such point
  };

  /// Places the first sites.
  std::vector<LoopSite> lay_out(const Share& share) const;
  /// Takes the sites that all ranks have placed.
  /// @return the chords of this share that must be divided
  std::vector<Cut> begin(std::vector<LoopSite> laid, const Share& share);
  /// @brief Divides chords until all conditions hold. Then moves sites of simplified interfaces by a small share of h,
  /// so that the regions on both sides have the areas that they were given; no site comes into the circle of a chord. A
  /// change at one place may spread along the whole boundary, by one chord per round.
  /// @param cuts the chords to divide, from all shares
  void run(std::vector<Cut> cuts);
  polygon::BoundarySites result() const;

private:
  struct Site {
    double t;
    geometry::Vec2 position;   // position along the unrolled loop
    LocalIndex previous, next; // -1 beyond the ends of an open curve
    std::int32_t loop;
    SiteKind kind;
    LocalIndex vertex; // the first site at this place: several curves may meet there
  };
  void add_loop(std::span<const LoopSite> loop_sites);
  void add_open_curve(std::span<const LoopSite> loop_sites);
  void join_nodes();
  void cut_doubles(std::vector<Cut>& cuts) const;
  bool is_straight(LocalIndex chord) const;
  polygon::InnerChords inner_chords() const;
  const geometry::Piece* piece_around(const Site& site) const;
  std::int32_t track_of(const Site& site, const geometry::InnerArc& arc, std::int32_t loss,
                        polygon::InnerChords& inner) const;
  void look_at_fresh(LocalIndex chord, std::vector<Cut>& cuts) const;
  std::vector<Cut> find_cuts(const std::vector<LocalIndex>& fresh_sites, const std::vector<LocalIndex>& fresh_chords);
  std::vector<LocalIndex> candidates(const std::vector<LocalIndex>& fresh_sites,
                                     const std::vector<LocalIndex>& fresh_chords);
  LocalIndex find_intruder(const SiteTree& tree, LocalIndex chord, bool foreign = false) const;
  SiteTree tree_of(std::span<const geometry::Vec2> points) const;
  bool curve_offends(LocalIndex chord) const;
  struct Chain; // a simplified interface
  Chain chain_on(std::size_t loop) const;
  bool leaves_out_corners(const Chain& chain) const;
  std::vector<Chain> simplified_chains() const;
  void shift(const Chain& chain, const std::vector<char>& is_held);
  bool hold_offenders(std::vector<char>& is_held) const;
  void keep_areas();
  std::vector<geometry::RegionLoss> losses() const;
  LocalIndex divide(const Cut& cut);
  struct CutPlace {
    double t;
    LocalIndex junction = -1; // number of the piece that starts there; -1 inside a piece
  };
  CutPlace cut_place(const Site& a, const Site& b, double end) const;
  /// Properties of a chord of the final boundary.
  struct ChordRecord {
    double squared_length = 0;
    LocalIndex left_out = 0; ///< number of corners of the curve between the chord's ends that are not sites
    double deviation = 0;    ///< largest distance from the chord to one of these corners, divided by the local size
  };
  /// Returns the sites in the order of the result, loop by loop.
  /// @param loop_start receives the index at which each loop begins
  std::vector<LocalIndex> along_loops(std::vector<LocalIndex>& loop_start) const;
  /// Returns the properties of the chord that starts at site k.
  /// @param result receives the site without its neighbours
  ChordRecord chord_from(LocalIndex k, polygon::BoundarySite& result) const;
  [[noreturn]] void fail(const Cut& cut) const;

  /// Returns the number of different places of sites: a node is one place for all curves that meet there.
  std::size_t places() const { return sites_.size() - doubles_; }
  const Site& next(const Site& site) const { return sites_[site.next]; }
  /// Returns t of the end of the chord that starts at `site`; it is larger than t of the start, even beyond the end of
  /// the loop.
  double end_t(const Site& site) const {
    const double t = next(site).t;
    return t > site.t ? t : t + metrics_[site.loop].total();
  }
  /// Returns the end of the chord that starts at `site`, along the unrolled loop.
  geometry::Vec2 end_of(const Site& site) const {
    const Site& b = next(site);
    return b.t > site.t ? b.position : b.position + metrics_[site.loop].loop().winding;
  }
  /// Returns the largest allowed distance from the chord that starts at `site` to corners that it leaves out.
  double tolerance(const Site& site) const {
    return tolerance_of(static_cast<std::size_t>(site.loop)).at(metrics_[site.loop].sizes(site.t).asked);
  }
  const FeatureTolerance& tolerance_of(std::size_t loop) const {
    return loop < boundary_loops_ ? tolerance_ : inner_tolerance_;
  }
  PartSummary summarize(const Site& a) const {
    return metrics_[a.loop].summarize(a.t, end_t(a), a.position, end_of(a));
  }

  const std::shared_ptr<const LaidCurves> curves_;
  const geometry::Boundary& boundary_; // the boundary alone
  const geometry::Lattice& lattice_;
  const double corner_angle_;
  const FeatureTolerance tolerance_, inner_tolerance_; // for the boundary, and for curves inside
  const std::span<const geometry::Vec2> inside_;
  const SiteTree inside_tree_;
  const polygon::DroppedLoops dropped_;
  std::vector<LoopMetric> metrics_; // one LoopMetric for each remaining loop, then one for each inner curve
  std::size_t boundary_loops_ = 0;  // number of metrics that belong to the boundary
  std::vector<Site> sites_;
  std::vector<LocalIndex> loop_first_; // the first site of each loop
  std::vector<SiteTree>
      trees_; // search trees that together hold all sites; each is more than twice as large as the next
  std::optional<SegmentWatch> watch_; // index of all chords, made after a few rounds
  std::size_t most_sites_ = 0;        // bound above which dividing certainly produces too many sites
  const std::size_t affordable_;      // limit given by the caller
  std::size_t doubles_ = 0;           // sites at nodes at which another curve has a site already
  bool overfull_ = false;
  LocalIndex halvings_ = 0;
  int rounds_ = 0;
};

/// @brief Places the sites on a boundary for an absolute element size, by all ranks together. Collective. If one rank
/// throws, all ranks throw.
///
/// A junction of two pieces that turns by more than `corner_angle` degrees is a corner; `rule` decides which corners
/// and loops are left out. Between kept corners, or along a whole loop without corners, the sites divide the integral
/// of ds/h into equal shares. Where corners may be left out, a shortest path chooses the corners that stay, and places
/// between them (site_path.hpp). Where two sides of a corner meet at less than 60 degrees, both get sites at equal
/// distances from the corner until their gap reaches h (shells; Ruppert 1995). Then a chord is divided while another
/// site lies in its diametral circle, or the curve between its ends leaves that circle, or the curve turns by more than
/// 60 degrees and deviates from the chord by more than the tolerance. A chord is divided in the middle; next to a sharp
/// corner, at a distance from the corner that is a power of two (concentric shells), so that the process ends for any
/// angle. Points of `inside` must not lie in the circles either. Sites lie on the curve, except on simplified
/// interfaces (see BoundaryRefiner::run). Deterministic; O(B log^2 B) for B sites and pieces.
/// @throws GeometryError with the place if two parts of the boundary are too close to be separated by chords, or if the
/// size needs more than 2^27 sites
/// @param make_ready returns the refiner of this rank, which must be the same on all ranks; does not communicate
polygon::BoundarySites make_boundary_sites(const comm::Communicator& comm,
                                           const std::function<std::unique_ptr<BoundaryRefiner>()>& make_ready);

} // namespace trime::boundary
