// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock times of the sections of a run, with counters of their work: messages, stars, ghosts and so on. Sections
// do not nest, so that the table adds up to the whole. Counters are plain integers that modules add to once per call
// or tile, never inside their loops. The program reports times and counters; no decision depends on them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace trime {

/// The counters. A sum adds up over time. A peak is the largest value that was noted, such as a number of sites.
enum class Counter : std::uint8_t {
  messages,    ///< sum: messages to other ranks; a message of more than 1 GiB counts once for each GiB
  bytes,       ///< sum: bytes of these messages
  collectives, ///< sum: calls in which all ranks take part
  wait_ns, ///< sum: nanoseconds in MPI calls that end when another rank arrives; calls inside of HDF5 are not counted
  neighbours,         ///< peak: number of other ranks that got messages in one call of a section
  sites_started,      ///< sum: sites that a stage began with
  points,             ///< peak: owned sites
  densest_tile,       ///< peak: sites in the fullest tile of the rank
  ghosts,             ///< peak: sites of other ranks that the rank knows
  sites_migrated,     ///< sum: sites that came from another rank
  passes,             ///< sum: searches for the next places of all sites; a sweep takes one, or two if the rule changes
  sites_swept,        ///< sum: sites that were awake, counted in each pass: the rule computed where they go
  sites_slept,        ///< sum: all other sites, counted in each pass; they stayed
  sites_moved,        ///< sum: sites that a sweep has moved by more than 0.005 h
  stars_by_emptiness, ///< sum: stars computed from the sites around
  stars_rebuilt,      ///< sum: those of them that changed
  fetch_rounds,       ///< sum: how often the halo grew because a rank missed bins
  cleanup_rounds,     ///< sum: rounds of the clean-up
  patches,            ///< sum: patches that the clean-up has tried
  sites_extracted,    ///< sum: points of the mesh
  grid_bytes,         ///< peak: bytes of tables as long as the grid of tiles
  boundary_bytes,     ///< peak: bytes of tables as long as the boundary
  size_bytes,         ///< peak: bytes of tables of the whole size field
  rank_bytes,         ///< peak: bytes of a table as long as the number of ranks
};
inline constexpr std::size_t counter_count = static_cast<std::size_t>(Counter::rank_bytes) + 1;

/// The name of a counter in reports and files.
struct CounterName {
  const char* name; ///< such as "sites_swept"
  const char* unit; ///< what it counts, such as "sites"
};
CounterName name_of(Counter counter);
bool is_peak(Counter counter);
/// Returns whether `comm` counts this counter.
constexpr bool is_traffic(Counter counter) {
  return counter <= Counter::neighbours;
}

/// A value of each counter, 0 at first.
class CounterValues {
public:
  std::int64_t operator[](Counter counter) const { return values_[static_cast<std::size_t>(counter)]; }
  void set(Counter counter, std::int64_t value) { values_[static_cast<std::size_t>(counter)] = value; }
  /// Combines two periods of time: adds sums, and takes the larger of two peaks.
  CounterValues& operator+=(const CounterValues& other);

private:
  std::array<std::int64_t, counter_count> values_{};
};

/// The counters of a rank. Only one thread may use them at a time.
class Counters {
public:
  /// Adds to a sum.
  void add(Counter counter, std::int64_t value = 1) { values_.set(counter, values_[counter] + value); }
  /// Notes a value for a peak: the largest one counts.
  void note(Counter counter, std::int64_t value) {
    if (value > values_[counter])
      values_.set(counter, value);
  }
  /// Counts a message to another rank. O(1) if ranks come in ascending order, else O(neighbours).
  void add_message(int to, std::int64_t bytes);

  /// Returns all that was counted since the last call, and begins again with 0.
  CounterValues take();

private:
  CounterValues values_;
  std::vector<int> neighbours_; // ascending
};

/// Returns the seconds of a monotonic clock.
double wall_seconds();

/// @brief Sets another clock, such as the clock of a simulator; null: the steady clock again. Other threads must not
/// read the clock meanwhile.
void set_wall_clock(double (*seconds)());

/// Accumulated seconds, calls and counters per named section, in order of first use.
class TimerTable {
public:
  /// A named part of a run.
  struct Section {
    std::string name;
    double seconds = 0;
    long calls = 0;
    CounterValues counts{};
  };

  /// Adds the time from construction to destruction to one section, and what was counted.
  class Scope {
  public:
    Scope(TimerTable& table, const std::string& name) : table_(table), name_(name), start_(wall_seconds()) {
      table_.outside(); // the section begins with zero counts
      if (table_.begins_)
        table_.begins_(name_);
    }
    ~Scope() { table_.add(name_, wall_seconds() - start_, table_.take()); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    TimerTable& table_;
    std::string name_;
    double start_;
  };

  /// @param counters counters of this rank, which the table takes over at the end of each section; null: nothing is
  /// counted. They must outlive the table
  explicit TimerTable(Counters* counters = nullptr) : counters_(counters), start_(wall_seconds()) {}
  [[nodiscard]] Scope scope(const std::string& name) { return Scope(*this, name); }
  /// Sets the function that is called with the name of each section that begins; at most one.
  void on_section(std::function<void(const std::string&)> begins) { begins_ = std::move(begins); }
  void add(const std::string& name, double seconds, const CounterValues& counts = {});
  const std::vector<Section>& sections() const { return sections_; }
  /// Returns the seconds since construction.
  double total() const { return wall_seconds() - start_; }
  /// Returns what was counted between the sections so far. @pre no section is open
  const CounterValues& outside() { return outside_ += take(); }

private:
  CounterValues take() { return counters_ ? counters_->take() : CounterValues{}; }

  std::vector<Section> sections_;
  Counters* counters_;
  CounterValues outside_;
  double start_;
  std::function<void(const std::string&)> begins_;
};

} // namespace trime
