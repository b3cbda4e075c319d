// SPDX-License-Identifier: BSD-3-Clause
// Measures the wall-clock time of each section of a run, with counters of the work done in it: messages, stars, ghosts
// and so on. Sections do not nest, so their times add up to the time of the run. Counters are plain integers; modules
// add to them once per call or tile, never inside their loops. The program reports times and counters; no decision
// depends on them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace trime {

/// The counters. A sum adds up the values of all calls. A peak keeps the largest value, such as the largest number of
/// sites.
enum class Counter : std::uint8_t {
  messages,       ///< sum: messages to other ranks; a message of more than 1 GiB counts once for each begun GiB
  bytes,          ///< sum: bytes in messages to other ranks
  collectives,    ///< sum: calls in which all ranks take part
  wait_ns,        ///< sum: nanoseconds in MPI calls that wait for other ranks; calls inside of HDF5 are not counted
  neighbours,     ///< peak: number of other ranks that got messages in one section
  sites_started,  ///< sum: number of sites at the beginning of each stage
  points,         ///< peak: number of owned sites
  densest_tile,   ///< peak: sites in the fullest tile of the rank
  ghosts,         ///< peak: sites of other ranks that the rank knows
  sites_migrated, ///< sum: sites that came from another rank
  passes,      ///< sum: passes that compute the next places of all sites; a sweep makes one, or two if the update rule
               ///< changes
  sites_swept, ///< sum: sites that were awake in a pass, so that the update rule computed their next place
  sites_slept, ///< sum: sites that were asleep in a pass, so that they stayed in place
  sites_moved, ///< sum: sites that moved by more than 0.005 h in a sweep
  stars_by_emptiness, ///< sum: stars that were computed from the surrounding sites by the empty-circumcircle test
  stars_rebuilt,      ///< sum: stars among stars_by_emptiness that changed
  fetch_rounds,       ///< sum: how often a rank fetched more ghosts because it needed sites of unknown bins
  cleanup_rounds,     ///< sum: rounds of the clean-up of bad triangles
  patches,            ///< sum: patches on which the clean-up tried changes
  sites_extracted,    ///< sum: points of the mesh
  grid_bytes,         ///< peak: bytes of tables that are as long as the grid of tiles
  boundary_bytes,     ///< peak: bytes of tables that are as long as the boundary
  size_bytes,         ///< peak: bytes of tables that describe the whole size field
  rank_bytes,         ///< peak: bytes of the largest table that is as long as the number of ranks
};
inline constexpr std::size_t counter_count = static_cast<std::size_t>(Counter::rank_bytes) + 1;

/// The name and the unit of a counter in reports and files.
struct CounterName {
  const char* name; ///< such as "sites_swept"
  const char* unit; ///< unit of the counter, such as "sites"
};
CounterName name_of(Counter counter);
bool is_peak(Counter counter);
/// Returns whether the module `comm` counts this counter.
constexpr bool is_traffic(Counter counter) {
  return counter <= Counter::neighbours;
}

/// One value for each counter; all are 0 at first.
class CounterValues {
public:
  std::int64_t operator[](Counter counter) const { return values_[static_cast<std::size_t>(counter)]; }
  void set(Counter counter, std::int64_t value) { values_[static_cast<std::size_t>(counter)] = value; }
  /// Combines two periods of time: adds the sums, and keeps the larger of the two values of each peak.
  CounterValues& operator+=(const CounterValues& other);

private:
  std::array<std::int64_t, counter_count> values_{};
};

/// The counters of a rank. Only one thread may use them at a time.
class Counters {
public:
  /// Adds a value to a counter that is a sum.
  void add(Counter counter, std::int64_t value = 1) { values_.set(counter, values_[counter] + value); }
  /// Notes a value for a counter that is a peak, which keeps its largest value.
  void note(Counter counter, std::int64_t value) {
    if (value > values_[counter])
      values_.set(counter, value);
  }
  /// Counts a message to another rank. Cost: O(1) if messages are counted in ascending order of ranks, otherwise
  /// O(neighbours).
  void add_message(int to, std::int64_t bytes);

  /// Returns all counters since the last call, and sets them to 0.
  CounterValues take();

private:
  CounterValues values_;
  std::vector<int> neighbours_; // ascending
};

/// Returns the seconds of a monotonic clock.
double wall_seconds();

/// @brief Replaces the clock of wall_seconds(), for example by the clock of a simulator; null: the steady clock again.
/// No other thread may read the clock meanwhile.
void set_wall_clock(double (*seconds)());

/// Seconds, calls and counters of each named section of a run, in the order of first use.
class TimerTable {
public:
  /// A named part of a run.
  struct Section {
    std::string name;
    double seconds = 0;
    long calls = 0;
    CounterValues counts{};
  };

  /// Adds the time between construction and destruction, and the counters of that time, to one section.
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

  /// @param counters counters of this rank, which are moved to a section when it ends; null: nothing is counted. The
  /// counters must outlive the table
  explicit TimerTable(Counters* counters = nullptr) : counters_(counters), start_(wall_seconds()) {}
  [[nodiscard]] Scope scope(const std::string& name) { return Scope(*this, name); }
  /// Sets the function that is called at the beginning of each section, with its name. There is at most one such
  /// function.
  void on_section(std::function<void(const std::string&)> begins) { begins_ = std::move(begins); }
  void add(const std::string& name, double seconds, const CounterValues& counts = {});
  const std::vector<Section>& sections() const { return sections_; }
  /// Returns the seconds since construction.
  double total() const { return wall_seconds() - start_; }
  /// Returns the counters of all time outside of the sections so far.
  /// @pre no section is open
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
