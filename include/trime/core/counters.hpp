// SPDX-License-Identifier: BSD-3-Clause
// What a rank counts while it runs: messages, stars, ghosts and the like. Plain integers, which the modules add to once
// per call or tile, never inside their loops. They are reported and steer nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime {

/// Of a rank. A sum adds up over time. A peak is the largest value that was noted, such as a number of sites.
enum class Counter : std::uint8_t {
  messages,      ///< sum: sent to another rank; those of more than 1 GiB count once for each GiB
  bytes,         ///< sum: of these messages
  collectives,   ///< sum: calls in which all ranks take part
  wait_ns,       ///< sum: nanoseconds in calls of MPI that end when another rank has come; a collective of HDF5 is none
  neighbours,    ///< peak: other ranks that messages went to in one call of a section
  sites_started, ///< sum: sites that a stage began with
  points,        ///< peak: owned sites
  densest_tile,  ///< peak: sites of the owned tile with most
  ghosts,        ///< peak: sites of others that the rank knows
  sites_migrated,     ///< sum: sites that came from another rank
  passes,             ///< sum: searches for the next places of all sites; a sweep takes one, or two if the rule changes
  sites_swept,        ///< sum: sites that were awake, each in each pass: the rule was asked where they go
  sites_slept,        ///< sum: all other sites, each in each pass; they stayed
  sites_moved,        ///< sum: sites that a sweep has moved by more than a little
  stars_by_emptiness, ///< sum: stars computed from the sites around
  stars_rebuilt,      ///< sum: of these, those that came out other than they were
  fetch_rounds,       ///< sum: times that the halo has grown, since bins were missing on some rank
  cleanup_rounds,     ///< sum
  patches,            ///< sum: that the clean-up has tried
  sites_extracted,    ///< sum: points of the mesh
  grid_bytes,         ///< peak: of tables as long as the grid of tiles
  boundary_bytes,     ///< peak: of tables as long as the boundary
  size_bytes,         ///< peak: of tables of the whole size field
  rank_bytes,         ///< peak: of a table as long as the number of ranks
};
inline constexpr std::size_t counter_count = static_cast<std::size_t>(Counter::rank_bytes) + 1;

/// What a counter is called in reports and files.
struct CounterName {
  const char* name; ///< such as "sites_swept"
  const char* unit; ///< what it counts, such as "sites"
};
CounterName name_of(Counter counter);
bool is_peak(Counter counter);
/// Of what comm counts.
constexpr bool is_traffic(Counter counter) {
  return counter <= Counter::neighbours;
}

/// A value of each counter, 0 at first.
class CounterValues {
public:
  std::int64_t operator[](Counter counter) const { return values_[static_cast<std::size_t>(counter)]; }
  void set(Counter counter, std::int64_t value) { values_[static_cast<std::size_t>(counter)] = value; }
  /// One time and another: sums add up, of peaks the larger counts.
  CounterValues& operator+=(const CounterValues& other);

private:
  std::array<std::int64_t, counter_count> values_{};
};

/// The counters of a rank. Not for several threads at once.
class Counters {
public:
  /// Of a sum.
  void add(Counter counter, std::int64_t value = 1) { values_.set(counter, values_[counter] + value); }
  /// Of a peak.
  void note(Counter counter, std::int64_t value) {
    if (value > values_[counter])
      values_.set(counter, value);
  }
  /// A message goes to another rank. O(1) for ranks in ascending order, else O(neighbours).
  void add_message(int to, std::int64_t bytes);

  /// All that was counted since the last call.
  CounterValues take();

private:
  CounterValues values_;
  std::vector<int> neighbours_; // ascending
};

} // namespace trime
