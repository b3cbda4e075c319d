// SPDX-License-Identifier: BSD-3-Clause
// Wall-clock sections of a run. Sections do not nest: the table must add up to the whole.
// Times are reported, never used to steer anything.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace trime {

/// Seconds of a monotonic clock.
inline double wall_seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Accumulated seconds and calls per named section, in order of first use.
class TimerTable {
public:
  struct Section {
    std::string name;
    double seconds = 0;
    long calls = 0;
  };

  /// Adds the time from construction to destruction to one section.
  class Scope {
  public:
    Scope(TimerTable& table, const std::string& name) : table_(table), name_(name), start_(wall_seconds()) {}
    ~Scope() { table_.add(name_, wall_seconds() - start_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

  private:
    TimerTable& table_;
    std::string name_;
    double start_;
  };

  TimerTable() : start_(wall_seconds()) {}
  [[nodiscard]] Scope scope(const std::string& name) { return Scope(*this, name); }
  void add(const std::string& name, double seconds);
  const std::vector<Section>& sections() const { return sections_; }
  /// Seconds since construction.
  double total() const { return wall_seconds() - start_; }

private:
  std::vector<Section> sections_;
  double start_;
};

} // namespace trime
