// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock sections of a run, and what was sent in them. Sections do not nest: the table must add up to the whole.
// Times are reported, never used to steer anything.
#pragma once

#include "trime/core/traffic.hpp"

#include <string>
#include <vector>

namespace trime {

/// Seconds of a monotonic clock.
double wall_seconds();

/// @brief Another clock from now on, such as that of a simulator, in which real time means nothing; null: the
/// steady clock again. Not while others read it.
void set_wall_clock(double (*seconds)());

/// Accumulated seconds, calls and traffic per named section, in order of first use.
class TimerTable {
public:
  struct Section {
    std::string name;
    double seconds = 0;
    long calls = 0;
    Traffic traffic{};
  };

  /// Adds the time from construction to destruction to one section, and the traffic.
  class Scope {
  public:
    Scope(TimerTable& table, const std::string& name)
        : table_(table), name_(name), start_(wall_seconds()), before_(table.traffic()) {}
    ~Scope() { table_.add(name_, wall_seconds() - start_, table_.traffic() - before_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    TimerTable& table_;
    std::string name_;
    double start_;
    Traffic before_;
  };

  /// @param counted what is sent; null: nothing is. It must outlive the table.
  explicit TimerTable(const Traffic* counted = nullptr) : counted_(counted), start_(wall_seconds()) {}
  [[nodiscard]] Scope scope(const std::string& name) { return Scope(*this, name); }
  void add(const std::string& name, double seconds, const Traffic& traffic = {});
  const std::vector<Section>& sections() const { return sections_; }
  /// Seconds since construction.
  double total() const { return wall_seconds() - start_; }
  /// All of it so far.
  Traffic traffic() const { return counted_ ? *counted_ : Traffic{}; }

private:
  std::vector<Section> sections_;
  const Traffic* counted_;
  double start_;
};

} // namespace trime
