// SPDX-License-Identifier: BSD-3-Clause
// Stores the stars of the owned sites: the counter-clockwise ring of Delaunay neighbours of each.
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

/// The entry of a ring that stands for a gap, where triangles are missing or larger than the cap.
constexpr LocalIndex gap = -1;

/// @brief Rings of local indices that start at the lexicographically smallest neighbour. Each site has 8 fixed slots;
/// longer rings lie in an overflow list. A ring with a gap in it (a site at the rim) has the entry `gap` there, never
/// two in a row. An empty ring belongs to a site without triangles, or to one whose star was not computed. A shorter
/// ring is repeated in the rest of its 8 slots, so that loops over pairs of neighbours need not look for its end.
class StarTable {
public:
  static constexpr int slots = 8;

  /// Makes room for n sites, whose rings are empty and not certain.
  void reset(LocalIndex n);
  LocalIndex size() const { return static_cast<LocalIndex>(degree_.size()); }

  std::span<const LocalIndex> ring(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    const std::size_t n = degree_[at];
    return n <= slots ? std::span<const LocalIndex>(rings_[at].data(), n)
                      : std::span<const LocalIndex>(overflow_[static_cast<std::size_t>(rings_[at][0])]);
  }
  /// The slots of all sites, 8 each, and the lengths of the rings; rings longer than 8 are not in the slots.
  const LocalIndex* all_slots() const { return rings_.empty() ? nullptr : rings_[0].data(); }
  const std::uint8_t* degrees() const { return degree_.data(); }
  /// Returns the length of the ring of site i; slots + 1 stands for all rings longer than `slots`.
  std::size_t degree(LocalIndex i) const { return degree_[static_cast<std::size_t>(i)]; }
  /// Returns whether the ring of site i has a gap.
  bool has_gap(LocalIndex i) const { return (flags_[static_cast<std::size_t>(i)] & gapped) != 0; }
  /// Returns the ring of site i, also while other threads store rings. `room` holds a ring that comes from the overflow
  /// list.
  std::span<const LocalIndex> load(LocalIndex i, std::vector<LocalIndex>& room) const;
  /// Stores a ring; different sites may be stored concurrently.
  void store(LocalIndex i, std::span<const LocalIndex> ring);
  /// @brief Returns the 8 slots for a ring of 1 to 8 neighbours without gaps. The caller writes the ring and repeats
  /// it; until then the slots keep their content.
  LocalIndex* store_short(LocalIndex i, std::size_t degree) {
    clear(i);
    degree_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(degree);
    return rings_[static_cast<std::size_t>(i)].data();
  }
  /// Announces that the ring of site i will be written soon.
  void expect_store(LocalIndex i) const { __builtin_prefetch(&rings_[static_cast<std::size_t>(i)], 1); }
  /// Empties the ring of site i. May be called concurrently, as store may.
  void clear(LocalIndex i) {
    if (degree_[static_cast<std::size_t>(i)] > slots)
      release_overflow(i);
    degree_[static_cast<std::size_t>(i)] = 0;
    set(i, gapped, false);
  }

  /// Returns true if the star was computed with all bins that its discs meet.
  bool certain(LocalIndex i) const { return (flags_[static_cast<std::size_t>(i)] & is_certain) != 0; }
  void set_certain(LocalIndex i, bool certain) { set(i, is_certain, certain); }

  /// @brief Moves the rings to a new numbering of the owned sites. Rings with a neighbour that has no new index (a
  /// ghost, a deleted or migrated site) become empty. All stars become uncertain. Needs memory for a second set of
  /// rings meanwhile. O(n), by all threads.
  /// @param new_index for each old index of an owned site, its new index or -1
  void renumber(std::span<const LocalIndex> new_index, LocalIndex new_size);
  /// @brief As renumber, but in place, for a few removed and inserted sites. Stars stay certain, except those next to a
  /// removed site.
  /// @param ghosts for each former ghost, its new index or -1; if empty, no ghost has one
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
  std::vector<std::uint8_t> degree_; // length of the ring; slots + 1 if the ring is in the overflow list
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<LocalIndex>> overflow_;
  std::vector<LocalIndex> free_overflow_; // entries of overflow_ without a site
  std::unique_ptr<std::mutex> overflow_mutex_ = std::make_unique<std::mutex>();
};

} // namespace trime::delaunay
