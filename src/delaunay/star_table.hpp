// SPDX-License-Identifier: BSD-3-Clause
// Stores the stars of the owned sites: for each site its Delaunay neighbours in counter-clockwise order (the ring).
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

/// An entry of this value in a ring stands for a gap, where triangles are missing or their circumradius exceeds the
/// cap.
constexpr LocalIndex gap = -1;

/// @brief Stores rings of local indices, each beginning with the lexicographically smallest neighbour. Each site has 8
/// fixed slots; longer rings are stored in an overflow list. A gap in the ring of a site at the rim is stored as one
/// entry `gap`. The ring is empty if the site has no triangles, or if its star was not computed. A ring with fewer than
/// 8 entries is repeated in the remaining slots, so that loops over pairs of neighbours need not test for its end.
class StarTable {
public:
  static constexpr int slots = 8;

  /// Makes room for n sites, with empty rings that are not certain.
  void reset(LocalIndex n);
  LocalIndex size() const { return static_cast<LocalIndex>(degree_.size()); }

  std::span<const LocalIndex> ring(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    const std::size_t n = degree_[at];
    return n <= slots ? std::span<const LocalIndex>(rings_[at].data(), n)
                      : std::span<const LocalIndex>(overflow_[static_cast<std::size_t>(rings_[at][0])]);
  }
  /// Return the slots of all sites, 8 per site, and the lengths of the rings. Rings longer than 8 are not in the slots.
  const LocalIndex* all_slots() const { return rings_.empty() ? nullptr : rings_[0].data(); }
  const std::uint8_t* degrees() const { return degree_.data(); }
  /// Returns the length of the ring of site i; slots + 1 stands for all rings longer than `slots`.
  std::size_t degree(LocalIndex i) const { return degree_[static_cast<std::size_t>(i)]; }
  /// Returns whether the ring of site i has a gap.
  bool has_gap(LocalIndex i) const { return (flags_[static_cast<std::size_t>(i)] & gapped) != 0; }
  /// Returns the ring of site i, even while other threads store rings. `room` holds the result if the ring comes from
  /// the overflow list.
  std::span<const LocalIndex> load(LocalIndex i, std::vector<LocalIndex>& room) const;
  /// Stores a ring. Threads may store the rings of different sites concurrently.
  void store(LocalIndex i, std::span<const LocalIndex> ring);
  /// @brief Returns the 8 slots of site i for a ring of `degree` neighbours, 1 to 8, without gaps. The caller writes
  /// the ring and repeats it; until then the slots keep their old content.
  LocalIndex* store_short(LocalIndex i, std::size_t degree) {
    clear(i);
    degree_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(degree);
    return rings_[static_cast<std::size_t>(i)].data();
  }
  /// Prefetches the memory of the ring of site i, which will be written soon.
  void expect_store(LocalIndex i) const { __builtin_prefetch(&rings_[static_cast<std::size_t>(i)], 1); }
  /// Empties the ring of site i. May be called concurrently for different sites.
  void clear(LocalIndex i) {
    if (degree_[static_cast<std::size_t>(i)] > slots)
      release_overflow(i);
    degree_[static_cast<std::size_t>(i)] = 0;
    set(i, gapped, false);
  }

  /// Returns true if the star is certain: its computation used all bins that the circumcircles of its triangles touch.
  bool certain(LocalIndex i) const { return (flags_[static_cast<std::size_t>(i)] & is_certain) != 0; }
  void set_certain(LocalIndex i, bool certain) { set(i, is_certain, certain); }

  /// @brief Moves the rings to a new numbering of the owned sites. A ring becomes empty if one of its neighbours has no
  /// new index (a ghost, a deleted or migrated site). All stars become uncertain. Meanwhile it needs memory for a
  /// second set of rings. Cost: O(n), by all threads.
  /// @param new_index the new index for each old index of an owned site, or -1
  void renumber(std::span<const LocalIndex> new_index, LocalIndex new_size);
  /// @brief Renumbers in place, for a few removed and inserted sites. Stars stay certain, except stars next to a
  /// removed site.
  /// @param ghosts the new index of each former ghost, or -1; if empty, all ghosts are removed
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
  std::vector<std::uint8_t> degree_; // length of each ring; slots + 1 if the ring is in the overflow list
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<LocalIndex>> overflow_;
  std::vector<LocalIndex> free_overflow_; // unused entries of overflow_
  std::unique_ptr<std::mutex> overflow_mutex_ = std::make_unique<std::mutex>();
};

} // namespace trime::delaunay
