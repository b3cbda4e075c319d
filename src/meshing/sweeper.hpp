// SPDX-License-Identifier: BSD-3-Clause
// The sweeps of a stage: stars certified and sites moved in one pass, in place.
#pragma once

#include "meshing/boundary_treatment.hpp"
#include "meshing/site_state.hpp"
#include "meshing/sweep_kernel.hpp"

#include <vector>

namespace trime::meshing {

/// @brief Moves the inner sites, sweep by sweep. `prepare` certifies every star at the present places and computes the
/// next ones, `commit` goes there.
///
/// Most stars are certified by the Delaunay lemma (sweep_kernel.hpp) while their sites are moved. It needs the stars of
/// all neighbours, so those beside ghosts are certified by emptiness instead; so are those that fail, and whatever
/// changes beside them, until all rings agree. Both certificates say the same: no result depends on which was used, nor
/// on ranks and threads.
///
/// Why that is enough: a star that was not looked at again is locally convex, and its triangles are those of its
/// neighbours (else one of them had changed, and this one been looked at). The region of all such stars is bounded by
/// edges of stars certified by emptiness, which are edges of the one Delaunay triangulation; inside, the lemma holds.
///
/// Boundary sites keep no stars, but where the diametral disc of a chord holds no site the chord is an edge of that
/// triangulation as well, and may be part of the border: the disc of a triangle on the chord reaches less far beyond it
/// than that of the chord. No boundary site is in such a disc (BoundarySites); inner sites are rarely in one, and then
/// the stars beside the boundary in the tiles around are certified by emptiness.
///
/// Where nothing moves, nothing is done: a tile sleeps while no site of it and of the tiles around it has moved in the
/// last sweep, and the rule stays as it is. Tiles are the same on any ranks, so nothing depends on who sleeps.
///
/// Sites are not sorted in every sweep: bins stay as they are, and searches go as much farther as sites have come
/// (BinnedPoints::for_each_near), until that is too much. h is evaluated anew every few sweeps. In a periodic container
/// sites are sorted each time, so that they are in it.
class Sweeper {
public:
  /// For which stars the lemma may do; the others are certified by emptiness.
  enum class Lemma { nowhere, inside, up_to_chords };

  /// @pre each star of an inner site was certain before the last moves, or its ring is empty; h is known at all sites;
  /// all arguments outlive this object
  /// @param lemma `nowhere` is slow, for tests; `up_to_chords`: no boundary site is in the disc of a chord
  Sweeper(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
          Lemma lemma = Lemma::up_to_chords);

  /// What one sweep did, over all ranks.
  struct Counts {
    std::int64_t rebuilt = 0; ///< stars that were not right any more, and those beside borders that were lost; depends
                              ///< on the ranks
    std::int64_t moving = 0, pushed = 0, deleted = 0;
    double max_move = 0; ///< over h
    FixedSum power;      ///< see SweepSums

    /// Counts of both; the rest is that of the later sweep.
    void follow_by(Counts later);
  };

  /// Certifies the stars and finds where the sites go by `rule`. Collective.
  void prepare(const UpdateRule& rule);
  bool is_prepared() const { return prepared_; }
  /// Forgets the moves; the stars stay.
  void discard();
  /// Moves the sites to where `prepare` found that they go. Collective. @pre is_prepared()
  Counts commit();
  /// Certifies the stars of all inner sites where they are, and frees the leads: no rule moves them after it.
  /// Collective.
  void certify();
  /// @brief Sorts the sites if they were moved since: then bins are right again, rings stay, and all stars count as
  /// uncertain. Without it the state has bins that are too old for others. Collective.
  void sort();

  /// Sums over the stars of the inner owned sites: the same as meshing::measure, in less time.
  SweepSums measure(double reference_size);

  /// Compares every star with one computed by emptiness. Collective. @throws InternalError on all ranks if any differs
  void verify() const;

private:
  SweepTask task();
  void classify();
  SiteClass class_of(LocalIndex i, LocalIndex tile) const;
  bool vouches_for(LocalIndex neighbour, LocalIndex i) const;
  bool may_be_bordered(LocalIndex i, LocalIndex tile) const;
  bool is_chord_within_reach(LocalIndex from, LocalIndex to, LocalIndex tile) const;
  void find_encroached_tiles();
  bool trusts_boundary(LocalIndex tile) const;
  /// Tiles whose neighbours all belong to this rank are done while the ghosts are on their way.
  enum class Tiles { inner, at_borders };
  void wake_tiles(const RuleParameters& rule, Tiles which);
  void run_kernel(const SweepTask& task, Tiles which);
  bool treat_guarded(std::span<const LocalIndex> sites);
  void finish_move();
  std::int64_t certify_suspects();
  void mark(std::vector<LocalIndex>& sites, std::vector<LocalIndex>& list);
  void move_one_by_one(const UpdateRule& rule, std::span<const LocalIndex> sites);
  void set_move(LocalIndex i, const Treated& treated);
  SweepTally tally_tile(LocalIndex tile) const;
  void measure_tile(const SweepTask& all, LocalIndex tile, double reference_size, std::vector<double>& excesses,
                    SweepSums& sums) const;
  SweepTally tally();
  LocalIndex tile_of_site(LocalIndex i) const;
  void note_pushes();
  void move_and_sort(std::vector<std::uint8_t> deleted);

  /// Sites are sorted again, too, when one may have come that far, in tiles.
  static constexpr double drift_allowed = 0.25;

  /// What a thread collects.
  struct Work {
    std::vector<LocalIndex> suspects, irregular, guarded;
  };
  /// What became of a site that was moved one by one.
  enum class Fate : std::uint8_t { moved, pushed, deleted };

  SiteState& state_;
  const delaunay::StarBuilder& builder_;
  MoveContext context_;
  Lemma lemma_;
  std::vector<SiteClass> classes_;
  std::vector<std::uint8_t> marked_;           // by site: its star has been looked at in this sweep
  std::vector<Fate> fates_;                    // by site; other than `moved` only in tiles of retally_
  std::vector<std::uint8_t> retally_;          // by owned tile: not all of its sites were moved by the kernel
  std::vector<SweepTally> tallies_;            // by owned tile
  std::vector<std::uint8_t> awake_;            // by owned tile
  std::vector<std::uint8_t> copied_;           // by owned tile: its sites have the same places now and next
  std::vector<std::uint8_t> wide_;             // by owned tile: triangles may reach beyond the tiles around it
  std::vector<SweepSums> measured_;            // by owned tile, if there is room for that
  std::vector<std::uint8_t> is_measured_;      // by owned tile: and nothing has changed since
  std::vector<Tiles> kinds_;                   // by owned tile
  std::vector<std::uint8_t> encroached_;       // by owned tile: some site of it may be in the disc of a chord
  std::vector<double> drifts_before_;          // by tile of the container: before the last move
  std::vector<std::uint8_t> active_;           // by tile of the container: sites were moved by the last sweep
  RuleParameters waking_rule_;                 // of the last sweep with all tiles awake
  bool all_awake_ = true;                      // in the next sweep
  std::vector<LocalIndex> suspects_, checked_; // to be certified by emptiness; all that were
  std::vector<LocalIndex> irregular_;
  std::vector<mesh::BinRef> missing_;
  std::int64_t rebuilt_ = 0; // of this rank in this sweep
  Counts counts_;
  double largest_distance_ = 0;             // of this sweep, over all ranks
  double drift_ = 0, drift_in_sizes_ = 0;   // since the last sorting, over all ranks
  int age_of_sizes_ = 0, age_of_order_ = 0; // in sweeps
  int moves_ = 0;
  bool sorted_ = true, prepared_ = false, under_way_ = false;
};

} // namespace trime::meshing
