// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock times of the sections of a run, with their counters. Sections do not nest, so that the table adds up to
// the whole. Times are only reported; no decision depends on them.
#pragma once

#include "trime/core/counters.hpp"

#include <functional>
#include <string>
#include <vector>

namespace trime {

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
