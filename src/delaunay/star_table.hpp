// SPDX-License-Identifier: BSD-3-Clause
// The stars of the owned sites: for each the ring of its Delaunay neighbours, counter-clockwise.
#pragma once

#include "mesh/index_shift.hpp"
#include "trime/core/types.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace trime::delaunay {

/// Entry of a ring that stands for a gap: the triangles there are missing or larger than the cap.
constexpr LocalIndex gap = -1;

/// @brief Rings of local indices, starting at the lexicographically smallest neighbour, in 8 fixed slots a site; longer
/// rings lie in an overflow list. A ring with a gap in it (a site at the rim) has the entry `gap` there, never two
/// in a row. An empty ring belongs to a site without triangles, or to one whose star was not computed. What a ring
/// leaves of its 8 slots repeats it, so that loops over pairs of neighbours need not look for its end.
class StarTable {
public:
  static constexpr int slots = 8;

  /// Room for n sites, all rings empty and not certain.
  void reset(LocalIndex n);
  LocalIndex size() const { return static_cast<LocalIndex>(degree_.size()); }

  std::span<const LocalIndex> ring(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    const std::size_t n = degree_[at];
    return n <= slots ? std::span<const LocalIndex>(rings_[at].data(), n)
                      : std::span<const LocalIndex>(overflow_[static_cast<std::size_t>(rings_[at][0])]);
  }
  /// The slots of all sites, 8 each, and the lengths of the rings (more than 8: not in the slots).
  const LocalIndex* all_slots() const { return rings_.empty() ? nullptr : rings_[0].data(); }
  const std::uint8_t* degrees() const { return degree_.data(); }
  /// Length of the ring of site i; slots + 1 stands for any that is longer than `slots`.
  std::size_t degree(LocalIndex i) const { return degree_[static_cast<std::size_t>(i)]; }
  /// Does the ring of site i have a gap in it?
  bool has_gap(LocalIndex i) const { return (flags_[static_cast<std::size_t>(i)] & gapped) != 0; }
  /// The ring of site i while other sites are being stored; `room` holds it if it comes from the overflow list.
  std::span<const LocalIndex> load(LocalIndex i, std::vector<LocalIndex>& room) const;
  /// Stores a ring; different sites may be stored concurrently.
  void store(LocalIndex i, std::span<const LocalIndex> ring);
  /// @brief The 8 slots for a ring of 1 to 8 neighbours, to be written and repeated by the caller; until then they hold
  /// what they did. No gaps.
  LocalIndex* store_short(LocalIndex i, std::size_t degree) {
    clear(i);
    degree_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(degree);
    return rings_[static_cast<std::size_t>(i)].data();
  }
  /// Announces that the ring of site i will be written soon.
  void expect_store(LocalIndex i) const { __builtin_prefetch(&rings_[static_cast<std::size_t>(i)], 1); }
  /// Empties the ring of site i; concurrently as store.
  void clear(LocalIndex i) {
    if (degree_[static_cast<std::size_t>(i)] > slots)
      release_overflow(i);
    degree_[static_cast<std::size_t>(i)] = 0;
    set(i, gapped, false);
  }

  /// True once every bin that the discs of the star meet is known and the star was computed with them.
  bool certain(LocalIndex i) const { return (flags_[static_cast<std::size_t>(i)] & is_certain) != 0; }
  void set_certain(LocalIndex i, bool certain) { set(i, is_certain, certain); }

  /// @brief Moves the rings to a new numbering of the owned sites. Rings with a neighbour that has no new index (a
  /// ghost, a deleted or migrated site) become empty. All stars become uncertain. Holds two sets of rings for as long
  /// as it takes. O(n), by all threads.
  /// @param new_index by old index of an owned site: its new index or -1
  void renumber(std::span<const LocalIndex> new_index, LocalIndex new_size);
  /// @brief Does the same in place, where few sites go and come. Stars stay certain, except those next to a site that
  /// goes.
  /// @param ghosts by former ghost, of those behind the owned sites, its new index or -1; empty: none has one
  void renumber(const mesh::IndexShift& shift, std::span<const LocalIndex> ghosts);

private:
  static constexpr std::uint8_t is_certain = 1, gapped = 2;
  void set(LocalIndex i, std::uint8_t flag, bool value) {
    std::uint8_t& flags = flags_[static_cast<std::size_t>(i)];
    flags = static_cast<std::uint8_t>(value ? flags | flag : flags & ~flag);
  }
  void release_overflow(LocalIndex i);
  static void repeat(std::array<LocalIndex, slots>& ring, std::size_t degree);

  UnsetVector<std::array<LocalIndex, slots>> rings_;
  std::vector<std::uint8_t> degree_; // length of the ring; slots + 1 stands for an overflow entry
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<LocalIndex>> overflow_;
  std::vector<LocalIndex> free_overflow_; // entries of overflow_ without a site
  std::unique_ptr<std::mutex> overflow_mutex_ = std::make_unique<std::mutex>();
};

} // namespace trime::delaunay
