// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock sections of a run, and what was counted in them. Sections do not nest: the table must add up to the whole.
// Times are reported, never used to steer anything.
#pragma once

#include "trime/core/counters.hpp"

#include <functional>
#include <string>
#include <vector>

namespace trime {

/// Seconds of a monotonic clock.
double wall_seconds();

/// @brief Another clock from now on, such as that of a simulator, in which real time means nothing; null: the
/// steady clock again. Not while others read it.
void set_wall_clock(double (*seconds)());

/// Accumulated seconds, calls and counters per named section, in order of first use.
class TimerTable {
public:
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
      table_.outside(); // the section begins with nothing
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

  /// @param counters of this rank, which the table takes; null: nothing is counted. They must outlive the table.
  explicit TimerTable(Counters* counters = nullptr) : counters_(counters), start_(wall_seconds()) {}
  [[nodiscard]] Scope scope(const std::string& name) { return Scope(*this, name); }
  /// Sets what is called with the name of each section that begins; at most one.
  void on_section(std::function<void(const std::string&)> begins) { begins_ = std::move(begins); }
  void add(const std::string& name, double seconds, const CounterValues& counts = {});
  const std::vector<Section>& sections() const { return sections_; }
  /// Seconds since construction.
  double total() const { return wall_seconds() - start_; }
  /// What was counted between the sections so far. @pre outside of any
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
