// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/star_table.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>

namespace trime::delaunay {
namespace {

constexpr std::uint8_t overflowing = StarTable::slots + 1;
constexpr int chunk = 4096;

/// Writes a ring in new numbers. Returns false if one of its neighbours has no new number.
bool write_renumbered(std::span<const LocalIndex> ring, std::span<const LocalIndex> new_index, LocalIndex* to) {
  for (const LocalIndex neighbour : ring) {
    const auto k = static_cast<std::size_t>(neighbour);
    const LocalIndex number = neighbour == gap ? neighbour : k < new_index.size() ? new_index[k] : -1;
    if (number < 0 && neighbour != gap)
      return false;
    *to++ = number;
  }
  return true;
}

} // namespace

void StarTable::reset(LocalIndex n) {
  rings_.resize(static_cast<std::size_t>(n));
  thread_loop((n + chunk - 1) / chunk, 1, [&](std::ptrdiff_t part, int) { // slots always hold indices that exist
    const std::ptrdiff_t end = std::min<std::ptrdiff_t>(n, (part + 1) * chunk);
    std::fill(rings_.begin() + part * chunk, rings_.begin() + end, std::array<LocalIndex, slots>{});
  });
  degree_.assign(static_cast<std::size_t>(n), 0);
  flags_.assign(static_cast<std::size_t>(n), 0);
  overflow_.clear();
  free_overflow_.clear();
}

std::span<const LocalIndex> StarTable::load(LocalIndex i, std::vector<LocalIndex>& room) const {
  if (degree_[static_cast<std::size_t>(i)] != overflowing)
    return ring(i);
  const std::lock_guard lock(*overflow_mutex_); // the overflow list may be growing
  const std::span<const LocalIndex> r = ring(i);
  room.assign(r.begin(), r.end());
  return room;
}

void StarTable::store(LocalIndex i, std::span<const LocalIndex> ring) {
  const std::size_t at = static_cast<std::size_t>(i);
  const bool has_gap = std::find(ring.begin(), ring.end(), gap) != ring.end();
  if (ring.size() <= slots) {
    clear(i);
    set(i, gapped, has_gap);
    std::copy(ring.begin(), ring.end(), rings_[at].begin());
    repeat(rings_[at], ring.size());
    degree_[at] = static_cast<std::uint8_t>(ring.size());
    return;
  }
  // Rare (degree above 8): the order of the entries depends on the threads, the rings themselves do not.
  set(i, gapped, has_gap);
  const std::lock_guard lock(*overflow_mutex_);
  if (degree_[at] != overflowing) {
    if (free_overflow_.empty()) {
      free_overflow_.push_back(static_cast<LocalIndex>(overflow_.size()));
      overflow_.emplace_back();
    }
    rings_[at] = {free_overflow_.back()}; // no index of before, which may go without a word
    free_overflow_.pop_back();
  }
  overflow_[static_cast<std::size_t>(rings_[at][0])].assign(ring.begin(), ring.end());
  degree_[at] = overflowing;
}

/// Fills the slots behind a ring with the ring again.
void StarTable::repeat(std::array<LocalIndex, slots>& ring, std::size_t degree) {
  if (degree > 0)
    for (std::size_t k = degree; k < slots; ++k)
      ring[k] = ring[k - degree];
}

void StarTable::release_overflow(LocalIndex i) {
  const std::lock_guard lock(*overflow_mutex_);
  const LocalIndex entry = rings_[static_cast<std::size_t>(i)][0];
  overflow_[static_cast<std::size_t>(entry)].clear(); // nothing stale is renumbered
  free_overflow_.push_back(entry);
}

void StarTable::renumber(std::span<const LocalIndex> new_index, LocalIndex new_size) {
  const LocalIndex old_size = size();
  new_index = new_index.first(at(old_size));
  UnsetVector<std::array<LocalIndex, slots>> rings(at(new_size));
  std::vector<std::uint8_t> new_degree(at(new_size), 0), flags(at(new_size), 0);
  thread_loop((old_size + chunk - 1) / chunk, 1, [&](std::ptrdiff_t part, int) {
    const LocalIndex end = std::min(old_size, static_cast<LocalIndex>((part + 1) * chunk));
    for (LocalIndex i = static_cast<LocalIndex>(part * chunk); i < end; ++i) {
      const LocalIndex to = new_index[at(i)];
      const std::uint8_t n = degree_[at(i)];
      if (to >= 0 && n != overflowing && write_renumbered({rings_[at(i)].data(), n}, new_index, rings[at(to)].data())) {
        repeat(rings[at(to)], n);
        new_degree[at(to)] = n;
        flags[at(to)] = flags_[at(i)] & gapped;
      }
    }
  });
  thread_loop(new_size, 4 * chunk, [&](std::ptrdiff_t to, int) {
    if (new_degree[static_cast<std::size_t>(to)] == 0)
      rings[static_cast<std::size_t>(to)] = {};
  });
  std::vector<std::vector<LocalIndex>> overflow;
  const bool none_overflows = overflow_.size() == free_overflow_.size();
  for (LocalIndex i = 0; i < old_size && !none_overflows; ++i) {
    if (new_index[at(i)] < 0 || degree_[at(i)] != overflowing)
      continue;
    std::vector<LocalIndex> moved(overflow_[at(rings_[at(i)][0])]);
    if (const LocalIndex to = new_index[at(i)]; write_renumbered(moved, new_index, moved.data())) {
      rings[at(to)][0] = static_cast<LocalIndex>(overflow.size());
      new_degree[at(to)] = overflowing;
      flags[at(to)] = flags_[at(i)] & gapped;
      overflow.push_back(std::move(moved));
    }
  }
  rings_ = std::move(rings);
  degree_ = std::move(new_degree);
  flags_ = std::move(flags);
  overflow_ = std::move(overflow);
  free_overflow_.clear();
}

void StarTable::renumber(const mesh::IndexShift& shift, std::span<const LocalIndex> ghosts) {
  for (const LocalIndex i : shift.gone())
    clear(i);
  shift.move(rings_);
  shift.move(degree_);
  shift.move(flags_);
  for (const LocalIndex i : shift.come())
    degree_[static_cast<std::size_t>(i)] = flags_[static_cast<std::size_t>(i)] = 0;
  const std::vector<LocalIndex> new_index = shift.new_indices();
  const auto map_ring = [&](std::span<LocalIndex> ring) {
    for (LocalIndex& neighbour : ring) {
      if (neighbour == gap)
        continue;
      const auto k = static_cast<std::size_t>(neighbour);
      neighbour = k < new_index.size()                   ? new_index[k]
                  : k - new_index.size() < ghosts.size() ? ghosts[k - new_index.size()]
                                                         : LocalIndex{-1};
      if (neighbour < 0)
        return false;
    }
    return true;
  };
  thread_loop(size(), chunk, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<std::size_t>(item);
    std::array<LocalIndex, slots>& ring = rings_[i];
    const bool overflows = degree_[i] == overflowing;
    if (degree_[i] > 0 &&
        !map_ring(overflows ? std::span(overflow_[static_cast<std::size_t>(ring[0])]) : std::span<LocalIndex>(ring))) {
      clear(static_cast<LocalIndex>(item));
      flags_[i] = 0;
    }
    if (degree_[i] == 0)
      ring = {}; // slots always hold indices that exist
  });
}

} // namespace trime::delaunay
